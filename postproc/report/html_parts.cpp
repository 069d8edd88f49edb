#include "postproc/report/html_parts.h"

#include <fmt/format.h>

#include "postproc/export/scratch_directory.h"
#include "postproc/text/page.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

std::string htmlCell(const HtmlColumn& column, const char* tag, const std::string& html) {
  return fmt::format("<{0}{1}>{2}</{0}>", tag, column.number ? " class=\"number\"" : "", html);
}

/// The drawing without the declarations of a file of its own, of the width that the page gives it.
std::string inlineDrawing(const std::string& svg, const CaptionedChart& chart) {
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{}", chart.chart.size[0],
                     chart.chart.size[1], escaped(chart.caption), svg.substr(svg.find("<g")));
}

}  // namespace

std::string htmlTable(const std::vector<HtmlColumn>& columns) {
  std::string text = "<div class=\"wide\"><table><thead><tr>";
  for (const HtmlColumn& column : columns) text += htmlCell(column, "th", escaped(column.title));
  text += "</tr></thead><tbody>\n";
  for (std::size_t row = 0; row < columns.front().cells.size(); ++row) {
    text += "<tr>";
    for (const HtmlColumn& column : columns) text += htmlCell(column, "td", column.cells[row]);
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string htmlFacts(const Facts& facts) {
  std::string text = "<table class=\"facts\"><tbody>\n";
  for (const auto& [name, value] : facts)
    text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped(name), escaped(value));
  return text + "</tbody></table>\n";
}

std::string htmlCard(const std::string& id, const std::string& title, const std::string& html,
                     const std::string& style) {
  return fmt::format("<article id=\"{}\" class=\"{}\">\n<h2>{}</h2>\n{}</article>\n", escaped(id), style,
                     escaped(title), html);
}

std::string htmlWarnings(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return "<p>None.</p>\n";
  std::string text = "<ul class=\"warnings\">\n";
  for (const std::string& warning : warnings) text += fmt::format("<li>{}</li>\n", escaped(warning));
  return text + "</ul>\n";
}

std::string htmlCharts(const std::vector<CaptionedChart>& charts) {
  const ScratchDirectory scratch;
  std::string text = "<div class=\"charts\">\n";
  for (const CaptionedChart& chart : charts) {
    const auto file = scratch.path() / "chart.svg";
    drawChart(chart.chart, file);
    text += fmt::format("<figure><figcaption>{}</figcaption>{}</figure>\n", escaped(chart.caption),
                        inlineDrawing(readText(file), chart));
  }
  return text + "</div>\n";
}

std::string htmlPicture(const std::string& png, const std::string& description,
                        const std::string& attributes) {
  return fmt::format("<img alt=\"{}\" src=\"{}\"{}>\n", escaped(description), pngUri(png), attributes);
}

std::string htmlContents(const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string text = "<nav>";
  for (const auto& [id, title] : parts)
    text += fmt::format("<a href=\"#{}\">{}</a> ", escaped(id), escaped(title));
  return text + "</nav>\n";
}

}  // namespace burnish

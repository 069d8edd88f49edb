#pragma once
#include <string>
#include <utility>
#include <vector>

#include "postproc/report/run_charts.h"

/// Parts of the pages, as HTML. Names and texts that are passed in are plain unless they are called html.
namespace burnish {

struct HtmlColumn {
  std::string title;
  std::vector<std::string> cells;  ///< HTML
  bool number = true;              ///< set to the right
};

/// All columns have as many cells.
std::string htmlTable(const std::vector<HtmlColumn>& columns);

/// Names and what stands for them, in two columns.
using Facts = std::vector<std::pair<std::string, std::string>>;
std::string htmlFacts(const Facts& facts);

/// A box with a heading; `style`: empty, "good" or "bad".
std::string htmlCard(const std::string& id, const std::string& title, const std::string& html,
                     const std::string& style = "");

/// The warnings as a list, or that there are none.
std::string htmlWarnings(const std::vector<std::string>& warnings);

/// Charts as drawings within the page.
std::string htmlCharts(const std::vector<CaptionedChart>& charts);

/// <img> of the bytes of a PNG; `attributes` are HTML.
std::string htmlPicture(const std::string& png, const std::string& description,
                        const std::string& attributes = "");

/// Links to the parts of the page: id and title.
std::string htmlContents(const std::vector<std::pair<std::string, std::string>>& parts);

}  // namespace burnish

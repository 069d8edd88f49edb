#include "postproc/compare/report.h"

#include <fmt/format.h>

#include <string_view>
#include <system_error>

#include "engine/core/error.h"
#include "engine/core/version.h"
#include "postproc/compare/comparison_json.h"
#include "postproc/compare/difference_picture.h"
#include "postproc/compare/report_page.h"
#include "postproc/text/page.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// The picture as it is in its file; null if it is no picture, so that the page does not ask for it.
Json::Value fileJson(const fs::path& file) {
  try {
    readPicture(file);
    return pngUri(readText(file));
  } catch (const Error&) {
    return Json::nullValue;
  }
}

Json::Value differenceJson(const Comparison& comparison) {
  if (!isMeasured(comparison)) return Json::nullValue;
  return pngUri(
      encodePng(differencePicture(readPicture(comparison.actual), readPicture(comparison.baseline))));
}

Json::Value pairJson(const Comparison& comparison, const PictureRule& rule, bool updates) {
  Json::Value pair = comparisonJson(comparison, rule);
  pair["comparable"] = isMeasured(comparison);
  pair["acceptable"] = isAcceptable(comparison.verdict) && !updates;
  pair["updated"] = isAcceptable(comparison.verdict) && updates;
  pair["baseline"] = fileJson(comparison.baseline);
  pair["actual"] = fileJson(comparison.actual);
  pair["difference"] = differenceJson(comparison);
  return pair;
}

}  // namespace

void requireNoOtherPage(const fs::path& directory) {
  constexpr std::string_view kOfAllPages = "<footer id=\"accept\"";  // in those of former versions, too
  const fs::path file = directory / "index.html";
  std::error_code absent;
  if (fs::exists(file, absent) && readText(file).find(kOfAllPages) == std::string::npos)
    throw Error(
        fmt::format("{}: found a page that is no report of burnish compare, which is not overwritten; "
                    "name another directory",
                    file.string()));
}

fs::path writeReport(const ReportPage& page, const fs::path& directory) {
  Json::Value data;
  data["program"] = programName();
  data["title"] = page.title;
  data["what"] = page.what;
  data["rule"] = page.rule;
  data["command"] = page.acceptCommand;
  data["pairs"] = Json::arrayValue;
  for (const bool equal : {false, true})
    for (const Json::Value& pair : page.pairs)
      if ((pair["verdict"] == "equal") == equal)
        data["pairs"].append(pair)["updated"] = page.isUpdated && pair["updated"].asBool();
  std::string body = kComparePage;
  constexpr std::string_view place = "/*data*/";
  body.replace(body.find(place), place.size(), scriptText(data));
  const fs::path file = directory / "index.html";
  writeText(htmlText({page.title, kCompareStyle, body, kCompareScript, kCompareScriptHash}), file);
  return file;
}

ReportPage picturePage(const std::vector<Comparison>& comparisons, const PictureRule& rule,
                       const std::string& acceptCommand, bool updates) {
  ReportPage page{"Image regression",
                  "pictures",
                  fmt::format("Metric {}, threshold {}.", metricName(rule.metric), rule.threshold),
                  acceptCommand,
                  {},
                  false};
  for (const Comparison& comparison : comparisons) page.pairs.push_back(pairJson(comparison, rule, updates));
  return page;
}

}  // namespace burnish

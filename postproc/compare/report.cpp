#include "postproc/compare/report.h"

#include <algorithm>
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

Json::Value pageData(const std::vector<Comparison>& comparisons, const PictureRule& rule,
                     const std::string& acceptCommand) {
  Json::Value data;
  data["program"] = programName();
  data["command"] = acceptCommand;
  data["pairs"] = Json::arrayValue;
  std::vector<const Comparison*> sorted;
  for (const Comparison& comparison : comparisons) sorted.push_back(&comparison);
  std::stable_partition(sorted.begin(), sorted.end(),
                        [](const Comparison* each) { return each->verdict != PictureVerdict::Equal; });
  for (const Comparison* comparison : sorted) {
    Json::Value pair = comparisonJson(*comparison, rule);
    pair["acceptable"] = isAcceptable(comparison->verdict);
    pair["baseline"] = fileJson(comparison->baseline);
    pair["actual"] = fileJson(comparison->actual);
    pair["difference"] = differenceJson(*comparison);
    data["pairs"].append(pair);
  }
  return data;
}

}  // namespace

fs::path writeReport(const std::vector<Comparison>& comparisons, const PictureRule& rule,
                     const std::string& acceptCommand, const fs::path& directory) {
  std::string body = kComparePage;
  constexpr std::string_view place = "/*data*/";
  body.replace(body.find(place), place.size(), scriptText(pageData(comparisons, rule, acceptCommand)));
  const fs::path file = directory / "index.html";
  writeText(htmlText({"Image regression", kCompareStyle, body, kCompareScript, kCompareScriptHash}), file);
  return file;
}

}  // namespace burnish

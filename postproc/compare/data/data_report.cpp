#include "postproc/compare/data/data_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "postproc/compare/data/worst_pictures.h"
#include "postproc/text/page.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

/// Fields with pictures on a page, which they make large.
constexpr std::size_t kMostDrawn = 24;

Json::Value pictureJson(const std::string& png) {
  return png.empty() ? Json::Value() : Json::Value(pngUri(png));
}

Json::Value pairJson(const DataPair& pair, const FieldComparison& field, const FieldPictures& pictures,
                     bool isUpdated) {
  Json::Value value;
  value["name"] = fullName(pair, field);
  value["verdict"] = verdictName(field.verdict);
  value["message"] = field.message;
  value["acceptable"] = false;
  value["updated"] = isUpdated && field.verdict != FieldVerdict::Equal;
  value["comparable"] = !pictures.baseline.empty() && !pictures.actual.empty();
  value["baseline"] = pictureJson(pictures.baseline);
  value["actual"] = pictureJson(pictures.actual);
  value["difference"] = pictureJson(pictures.difference);
  return value;
}

}  // namespace

ReportPage dataPage(const std::vector<ResultComparison>& comparisons, const std::string& note, bool updates) {
  const std::vector<WorstField> worst = worstFields(comparisons, kMostDrawn);
  const WorstPictures pictures(worst);
  std::map<const FieldComparison*, FieldPictures> drawn;
  for (const WorstField& each : worst) drawn[each.field] = pictures.draw(each);
  ReportPage page{"Data regression", "fields", note, "", {}, false};
  for (const ResultComparison& comparison : comparisons) {
    const bool isUpdated = updates && becomesBaseline(comparison);
    for (const FieldComparison& field : comparison.fields) {
      const auto own = drawn.find(&field);
      page.pairs.push_back(
          pairJson(comparison.pair, field, own == drawn.end() ? FieldPictures{} : own->second, isUpdated));
    }
  }
  if (worstFields(comparisons, kMostDrawn + 1).size() > kMostDrawn)
    page.rule +=
        fmt::format("{}The {} fields that differ most are drawn.", note.empty() ? "" : " ", kMostDrawn);
  return page;
}

std::string drawWorst(const std::vector<ResultComparison>& comparisons, const std::filesystem::path& png) {
  const std::vector<WorstField> worst = worstFields(comparisons, kMostDrawn);
  const WorstPictures pictures(worst);
  const auto write = [&](const std::string& picture, const char* kind, const WorstField& drawn) {
    writeText(picture, png);
    const std::string& component = drawn.field->worst->component;
    return kind + fullName(*drawn.pair, *drawn.field) + (component.empty() ? "" : ", component " + component);
  };
  std::string first;  // for want of a difference
  const WorstField* ofFirst = nullptr;
  for (const WorstField& each : worst) {
    const FieldPictures drawn = pictures.draw(each);
    if (!drawn.difference.empty()) return write(drawn.difference, "difference of ", each);
    if (ofFirst || drawn.actual.empty()) continue;
    first = drawn.actual;
    ofFirst = &each;
  }
  return ofFirst ? write(first, "actual ", *ofFirst) : "";
}

}  // namespace burnish

#include "postproc/compare/data/data_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "postproc/compare/data/worst_pictures.h"
#include "postproc/compare/report.h"
#include "postproc/text/page.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

/// Fields with pictures on a page, which they make large.
constexpr std::size_t kMostDrawn = 24;

Json::Value pictureJson(const std::string& png) {
  return png.empty() ? Json::Value() : Json::Value(pngUri(png));
}

Json::Value pairJson(const DataPair& pair, const FieldComparison& field, const FieldPictures& pictures) {
  Json::Value value;
  value["name"] = fullName(pair, field);
  value["verdict"] = verdictName(field.verdict);
  value["message"] = field.message;
  value["acceptable"] = false;
  value["comparable"] = !pictures.baseline.empty() && !pictures.actual.empty();
  value["baseline"] = pictureJson(pictures.baseline);
  value["actual"] = pictureJson(pictures.actual);
  value["difference"] = pictureJson(pictures.difference);
  return value;
}

}  // namespace

std::filesystem::path writeDataReport(const std::vector<ResultComparison>& comparisons,
                                      const std::string& note, const std::filesystem::path& directory) {
  const std::vector<WorstField> worst = worstFields(comparisons, kMostDrawn);
  const std::vector<FieldPictures> pictures = worstPictures(worst);
  std::map<const FieldComparison*, const FieldPictures*> drawn;
  for (std::size_t k = 0; k < worst.size(); ++k) drawn[worst[k].field] = &pictures[k];
  ReportPage page{"Data regression", "fields", note, "", {}};
  for (const auto& [pair, fields] : comparisons)
    for (const FieldComparison& field : fields) {
      const auto own = drawn.find(&field);
      page.pairs.push_back(pairJson(pair, field, own == drawn.end() ? FieldPictures{} : *own->second));
    }
  if (worstFields(comparisons, kMostDrawn + 1).size() > kMostDrawn)
    page.rule +=
        fmt::format("{}The {} fields that differ most are drawn.", note.empty() ? "" : " ", kMostDrawn);
  return writeReport(page, directory);
}

void drawWorst(const std::vector<ResultComparison>& comparisons, const std::filesystem::path& png) {
  const std::vector<FieldPictures> pictures = worstPictures(worstFields(comparisons, kMostDrawn));
  for (const auto picture : {&FieldPictures::difference, &FieldPictures::actual}) {
    const auto first = std::ranges::find_if(
        pictures, [](const std::string& bytes) { return !bytes.empty(); }, picture);
    if (first != pictures.end()) return writeText((*first).*picture, png);
  }
}

}  // namespace burnish

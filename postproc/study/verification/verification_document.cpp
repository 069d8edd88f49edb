#include "postproc/study/verification/verification_document.h"

#include <fmt/format.h>

#include <string>

#include "engine/core/version.h"
#include "postproc/study/verification/check_table.h"
#include "postproc/study/verification/history_chart.h"
#include "postproc/study/verification/order_chart.h"
#include "postproc/text/markdown.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

std::string titleOf(const VerificationCase& verified) {
  return verified.document.scene.title.empty() ? verified.name : verified.document.scene.title;
}

/// "1 of 1 check holds", "2 of 3 checks hold".
std::string countText(std::size_t holding, std::size_t all) {
  return fmt::format("{} of {} {}", holding, all, all == 1 ? "check holds" : "checks hold");
}

std::string overview(const std::vector<VerifiedCase>& cases) {
  MarkdownColumn titles{"case", {}, false}, scenes{"scene", {}, false}, runs{"runs", {}},
      checks{"checks", {}}, hold{"hold", {}};
  std::size_t all = 0, holding = 0;
  for (const auto& [verified, outcomes, judged] : cases) {
    titles.cells.push_back(fmt::format("[{}](#{})", titleOf(*verified), verified->name));
    scenes.cells.push_back(verified->name + ".yaml");
    runs.cells.push_back(
        std::to_string(verified->families.size() * verified->families.front().variants.size()));
    checks.cells.push_back(std::to_string(judged.size()));
    hold.cells.push_back(std::to_string(numHolding(judged)));
    all += judged.size();
    holding += numHolding(judged);
  }
  return fmt::format("{}.\n\n{}\n", countText(holding, all),
                     markdownTable({titles, scenes, runs, checks, hold}));
}

/// A picture as the document, which need not stand in the current directory, finds it.
fs::path linkTo(const fs::path& picture, const fs::path& document) {
  return fs::absolute(picture).lexically_normal().lexically_relative(
      fs::absolute(document).lexically_normal().parent_path());
}

std::string section(const VerifiedCase& verifiedCase, const fs::path& file, const fs::path& pictures) {
  const auto& [verified, outcomes, judged] = verifiedCase;
  std::string text = fmt::format("<a id=\"{}\"></a>\n\n## {}\n\n", verified->name, titleOf(*verified));
  if (!verified->explanation.empty()) text += verified->explanation + "\n";
  Footnotes sources;
  text += checkTable(*verified, judged, &sources) + "\n";
  for (const std::string& part : {problemsText(judged), doubtsText(*verified, outcomes), sources.text()})
    if (!part.empty()) text += part + "\n";
  for (const fs::path& picture : drawOrderCharts(*verified, judged, pictures))
    text += markdownPicture(linkTo(picture, file), "") + "\n";
  for (const fs::path& picture : drawHistoryCharts(*verified, outcomes, pictures))
    text += markdownPicture(linkTo(picture, file), "") + "\n";
  return text;
}

}  // namespace

void writeVerification(const std::vector<VerifiedCase>& cases, const fs::path& file,
                       const fs::path& pictures) {
  std::string text = fmt::format(
      "# Verification\n\nMade by `burnish verify` ({}) from the scenes named below, which say what is "
      "computed and what is expected. Values stand for all meshes, h is the size of the cells, Δt "
      "that of the steps; an order is that of the two finest meshes; the deviation is that of the judged "
      "meshes, the finest one unless the "
      "scene says every. This file is generated; changes to it are lost.\n\n",
      programName());
  text += overview(cases);
  for (const VerifiedCase& verified : cases) text += section(verified, file, pictures);
  while (text.ends_with("\n\n")) text.pop_back();
  writeText(text, file);
}

}  // namespace burnish

#include "postproc/study/verification/check_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "postproc/text/account_text.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

constexpr int kValueDigits = 4, kErrorDigits = 2;

std::vector<std::string> valueTexts(const JudgedCheck& judged, const CheckRow& row) {
  const bool areErrors = std::holds_alternative<ExpectedOrder>(judged.check->expect);
  std::vector<std::string> texts;
  for (const auto& value : row.values)
    texts.push_back(value ? numberText(*value, areErrors ? kErrorDigits : kValueDigits) : "—");
  return texts;
}

std::string ordersText(const CheckRow& row) {
  std::string text;
  for (const auto& order : row.orders)
    text += (text.empty() ? "" : ", ") + (order ? fmt::format("{:.2f}", *order) : "—");
  return text;
}

std::string deviationText(const CheckRow& row) {
  if (!row.deviation) return {};
  return row.isShare ? numberText(100.0 * *row.deviation, kErrorDigits) + " %"
                     : numberText(*row.deviation, kErrorDigits);
}

std::string toleranceText(const CheckRow& row) {
  return row.tolerance + (row.isShare ? " %" : "");
}

std::vector<MarkdownColumn> meshColumns(const VerificationCase& verified) {
  const auto& variants = verified.families.front().variants;
  if (variants.size() == 1) return {{"value", {}}};
  std::vector<MarkdownColumn> columns;
  for (const CaseVariant& variant : variants) columns.push_back({sizeText(verified.sizes, variant.size), {}});
  return columns;
}

}  // namespace

std::string checkTable(const VerificationCase& verified, const std::vector<JudgedCheck>& judged,
                       Footnotes* sources) {
  MarkdownColumn names{"check", {}, false}, families{"family", {}, false}, expected{"expected", {}},
      orders{"orders", {}}, deviations{"deviation", {}}, tolerances{"tolerance", {}},
      verdicts{"verdict", {}, false};
  std::vector<MarkdownColumn> meshes = meshColumns(verified);
  for (const JudgedCheck& check : judged)
    for (const CheckRow& row : check.rows) {
      const bool first = &row == &check.rows.front();
      const std::string mark = sources != nullptr ? sources->mark(check.check->source) : "";
      names.cells.push_back(first ? check.check->name + mark : "");
      families.cells.push_back(row.family);
      const std::vector<std::string> values = valueTexts(check, row);
      for (std::size_t m = 0; m < meshes.size(); ++m) meshes[m].cells.push_back(values[m]);
      expected.cells.push_back(row.expected);
      orders.cells.push_back(ordersText(row));
      deviations.cells.push_back(deviationText(row));
      tolerances.cells.push_back(toleranceText(row));
      verdicts.cells.emplace_back(row.holds() ? "holds" : "**FAILS**");
    }
  std::vector<MarkdownColumn> all{std::move(names), std::move(families)};
  std::move(meshes.begin(), meshes.end(), std::back_inserter(all));
  for (MarkdownColumn* column : {&orders, &expected, &deviations, &tolerances, &verdicts})
    all.push_back(std::move(*column));
  std::erase_if(all, [](const MarkdownColumn& column) {
    return std::all_of(column.cells.begin(), column.cells.end(),
                       [](const std::string& cell) { return cell.empty(); });
  });
  return markdownTable(all);
}

std::string problemsText(const std::vector<JudgedCheck>& judged) {
  std::string text;
  for (const JudgedCheck& check : judged)
    for (const CheckRow& row : check.rows)
      if (!row.problem.empty())
        text += fmt::format("- {}{}: {}\n", check.check->name, row.family.empty() ? "" : ", " + row.family,
                            row.problem);
  return text;
}

std::string doubtsText(const VerificationCase& verified, const CaseOutcomes& outcomes) {
  std::map<std::string, std::string> doubtful, idle;  // runs, by condition and by tool
  const auto add = [](std::string& listed, const std::string& run) {
    listed += (listed.empty() ? "" : "; ") + run;
  };
  for (std::size_t f = 0; f < verified.families.size(); ++f)
    for (std::size_t m = 0; m < verified.families[f].variants.size(); ++m) {
      const std::string label = labelOf(verified.families[f], verified.families[f].variants[m]);
      for (const DoubtRecord& doubt : outcomes[f][m].doubts)
        add(doubtful[doubt.what],
            fmt::format("{}{}t = {:.4g}", label, label.empty() ? "" : " from ", doubt.firstTime));
      for (const std::string& tool : outcomes[f][m].idleTools) add(idle[tool], label);
    }
  std::string text;
  for (const auto& [what, listed] : doubtful) text += fmt::format("- doubtful ({}): {}\n", what, listed);
  for (const auto& [tool, listed] : idle)
    text += fmt::format("- {}{}{}\n", idleToolText(tool), listed.empty() ? "" : ": ", listed);
  return text;
}

std::size_t numHolding(const std::vector<JudgedCheck>& judged) {
  return static_cast<std::size_t>(
      std::count_if(judged.begin(), judged.end(), [](const JudgedCheck& check) { return check.holds(); }));
}

}  // namespace burnish

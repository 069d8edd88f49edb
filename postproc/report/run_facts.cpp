#include "postproc/report/run_facts.h"

#include <fmt/format.h>

#include "postproc/text/account_text.h"
#include "postproc/text/markdown.h"

namespace burnish {

Facts runFacts(const RunRecord& run) {
  Facts facts{{"state", run.state()}, {"frames", std::to_string(run.result.numFrames())}};
  if (run.account) {
    facts.emplace_back("end", "t = " + plainNumber(run.account->endTime));
    facts.emplace_back("basis functions", std::to_string(run.account->functions));
    for (auto& line : accountLines(*run.account, run.history)) facts.push_back(std::move(line));
    facts.emplace_back("time taken", plainNumber(run.account->timings.total) + " s");
  }
  facts.emplace_back("computed by", run.result.model().program);
  return facts;
}

}  // namespace burnish

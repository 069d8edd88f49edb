#include "postproc/study/combinations.h"

#include <utility>

namespace burnish {

std::vector<std::map<std::string, std::string>> combinations(const std::vector<ParameterSpec>& vary) {
  std::vector<std::map<std::string, std::string>> all{{}};
  for (const ParameterSpec& parameter : vary) {
    std::vector<std::map<std::string, std::string>> longer;
    for (const auto& combination : all) {
      for (std::size_t i = 0; i < parameter.values.size(); ++i) {
        longer.push_back(combination);
        longer.back()[parameter.name] = parameter.values[i];
        longer.back()[parameter.name + ".label"] =
            i < parameter.labels.size() ? parameter.labels[i] : parameter.values[i];
      }
    }
    all = std::move(longer);
  }
  return all;
}

}  // namespace burnish

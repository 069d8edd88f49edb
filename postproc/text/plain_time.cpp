#include "postproc/text/plain_time.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace burnish {
namespace {

constexpr double kTimeRounding = 1e-14;  // of sums of some tens of steps

}  // namespace

double plainTime(double time) {
  const double rounded = std::strtod(fmt::format("{:.12g}", time).c_str(), nullptr);
  return std::abs(rounded - time) <= kTimeRounding * std::abs(time) ? rounded : time;
}

}  // namespace burnish

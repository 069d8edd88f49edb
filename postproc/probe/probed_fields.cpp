#include "postproc/probe/probed_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/probe/probe_point.h"

namespace burnish {
namespace {

void requireBodyField(const FrameRecord& frame, const std::string& name) {
  std::vector<std::string> names = fieldNames(frame);
  std::erase_if(names, isContactField);
  if (std::ranges::count(names, name)) return;
  throw Error(fmt::format("field: found {}{}; available in frame {}: {}.{}", quoted(name),
                          isContactField(name) ? ", which only faces in contact have" : "", frame.index,
                          fmt::join(names, ", "), didYouMean(name, names)));
}

}  // namespace

ProbedFields::ProbedFields(const ModelRecord& model, const FrameRecord& frame,
                           const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    requireBodyField(frame, name);
    choices_.push_back(chooseField(model, frame, name));
    const std::vector<std::string> without = bodiesWithout(model, frame, name);
    std::vector<bool>& has = has_.emplace_back();
    if (without.empty()) continue;
    for (const std::string& body : model.bodies) has.push_back(!std::ranges::count(without, body));
  }
}

Eigen::VectorXd ProbedFields::values(int body, const std::vector<int>& nodes,
                                     const Eigen::VectorXd& R) const {
  Eigen::VectorXd values(std::ssize(choices_));
  for (std::size_t k = 0; k < choices_.size(); ++k) {
    const bool has = has_[k].empty() || has_[k][static_cast<std::size_t>(body)];
    values(static_cast<Eigen::Index>(k)) =
        has ? choices_[k].scalars(choices_[k].coefficients(Eigen::all, nodes) * R)(0) : ProbePoint::kNone;
  }
  return values;
}

}  // namespace burnish

#include "engine/contact/tool_contact.h"

#include <algorithm>
#include <cassert>

#include "engine/contact/contact_term.h"
#include "engine/contact/integral_contact_term.h"

namespace burnish {

template <int Dim>
void ToolContact<Dim>::keepInTouch(std::vector<const ToolContact*> others) {
  assert(this->options_.gapLimit.value_or(kAnyGap) == kAnyGap);
  keepsInTouch_ = true;
  others_ = std::move(others);
}

template <int Dim>
bool ToolContact<Dim>::isAlone() const {
  return std::none_of(others_.begin(), others_.end(), [](const ToolContact* other) {
    return other->state().pressure.size() > 0 && other->state().pressure.maxCoeff() > 0.0;
  });
}

template <int Dim>
std::unique_ptr<ToolContact<Dim>> makeToolContact(const Body<Dim>& body, int patch, FaceId face,
                                                  const Tool& tool, const ContactOptions& options,
                                                  int firstMultiplier, const std::vector<bool>& held,
                                                  const std::vector<DefinitionSpec>& definitions) {
  if (options.method == Enforcement::IntegralAugmentedLagrangian)
    return std::make_unique<IntegralContactTerm<Dim>>(body, patch, face, tool, options, firstMultiplier, held,
                                                      definitions);
  return std::make_unique<ContactTerm<Dim>>(body, patch, face, tool, options, firstMultiplier);
}

template <int Dim>
double meanControlPointDistance(const Patch<Dim>& patch, FaceId face) {
  const auto trace = tracePatch(patch, face);
  const auto& basis = trace.basis();
  double sum = 0.0;
  int count = 0;
  for (int a = 0; a < basis.numFunctions(); ++a)
    for (std::size_t d = 0; d < static_cast<std::size_t>(Dim - 1); ++d) {
      auto next = basis.functionIndex(a);
      if (++next[d] == basis.direction(static_cast<int>(d)).numFunctions()) continue;
      sum += (trace.points().col(basis.functionNumber(next)) - trace.points().col(a)).norm();
      ++count;
    }
  return sum / count;
}

template class ToolContact<2>;
template class ToolContact<3>;
template std::unique_ptr<ToolContact<2>> makeToolContact(const Body<2>&, int, FaceId, const Tool&,
                                                         const ContactOptions&, int, const std::vector<bool>&,
                                                         const std::vector<DefinitionSpec>&);
template std::unique_ptr<ToolContact<3>> makeToolContact(const Body<3>&, int, FaceId, const Tool&,
                                                         const ContactOptions&, int, const std::vector<bool>&,
                                                         const std::vector<DefinitionSpec>&);
template double meanControlPointDistance(const Patch<2>&, FaceId);
template double meanControlPointDistance(const Patch<3>&, FaceId);

}  // namespace burnish

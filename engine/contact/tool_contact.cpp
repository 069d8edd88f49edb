#include "engine/contact/tool_contact.h"

#include "engine/contact/contact_term.h"
#include "engine/contact/partner_contact.h"
#include "engine/contact/tool_partner.h"

namespace burnish::inline contact {

GapAt gapTo(const Tool& tool, const ToolPose& pose) {
  return [&tool, pose](const Eigen::Vector3d& x) { return tool.query(pose, x).gap; };
}

template <int Dim>
std::unique_ptr<FaceContact<Dim>> makeToolContact(const Body<Dim>& body, int patch, FaceId face,
                                                  const Tool& tool, const ContactOptions& options,
                                                  int firstMultiplier, const std::vector<bool>& held,
                                                  const std::vector<DefinitionSpec>& definitions) {
  if (options.method == Enforcement::IntegralAugmentedLagrangian || options.hasFriction())
    return makePartnerContact<Dim>(body, patch, face, onTool<Dim>(tool), options, firstMultiplier, held,
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

template std::unique_ptr<FaceContact<2>> makeToolContact(const Body<2>&, int, FaceId, const Tool&,
                                                         const ContactOptions&, int, const std::vector<bool>&,
                                                         const std::vector<DefinitionSpec>&);
template std::unique_ptr<FaceContact<3>> makeToolContact(const Body<3>&, int, FaceId, const Tool&,
                                                         const ContactOptions&, int, const std::vector<bool>&,
                                                         const std::vector<DefinitionSpec>&);
template double meanControlPointDistance(const Patch<2>&, FaceId);
template double meanControlPointDistance(const Patch<3>&, FaceId);

}  // namespace burnish::inline contact

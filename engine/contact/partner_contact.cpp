#include "engine/contact/partner_contact.h"

#include "engine/contact/integral_contact_term.h"
#include "engine/contact/mortar_contact_term.h"
#include "engine/contact/pointwise_penalty_term.h"

namespace burnish::inline contact {

template <int Dim>
std::unique_ptr<FaceContact<Dim>> makePartnerContact(const Body<Dim>& body, int patch, FaceId face,
                                                     const PartnerMaker<Dim>& makePartner,
                                                     const ContactOptions& options, int firstMultiplier,
                                                     const std::vector<bool>& held,
                                                     const std::vector<DefinitionSpec>& definitions) {
  switch (options.method) {
    case Enforcement::IntegralAugmentedLagrangian:
      return std::make_unique<IntegralContactTerm<Dim>>(body, patch, face, makePartner, options,
                                                        firstMultiplier, held, definitions);
    case Enforcement::PointwisePenalty:
      return std::make_unique<PointwisePenaltyTerm<Dim>>(body, patch, face, makePartner, options,
                                                         firstMultiplier, definitions);
    case Enforcement::AugmentedLagrangian:
    case Enforcement::MortarPenalty:
      break;
  }
  return std::make_unique<MortarContactTerm<Dim>>(body, patch, face, makePartner, options, firstMultiplier,
                                                  definitions);
}

template std::unique_ptr<FaceContact<2>> makePartnerContact(const Body<2>&, int, FaceId,
                                                            const PartnerMaker<2>&, const ContactOptions&,
                                                            int, const std::vector<bool>&,
                                                            const std::vector<DefinitionSpec>&);
template std::unique_ptr<FaceContact<3>> makePartnerContact(const Body<3>&, int, FaceId,
                                                            const PartnerMaker<3>&, const ContactOptions&,
                                                            int, const std::vector<bool>&,
                                                            const std::vector<DefinitionSpec>&);

}  // namespace burnish::inline contact

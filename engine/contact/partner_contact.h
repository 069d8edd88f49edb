#pragma once
#include <memory>
#include <vector>

#include "engine/contact/face_contact.h"
#include "engine/contact/partner.h"

namespace burnish::inline contact {

/// Contact of a face with a partner, by the method that the options say.
/// options: with a parameter. firstMultiplier: number of the first of the pair's multipliers among the
/// unknowns. held: displacement components that supports prescribe. definitions: of names in the formula for
/// friction. The body must outlive the term. Throws `Error` as the term of the method.
template <int Dim>
std::unique_ptr<FaceContact<Dim>> makePartnerContact(const Body<Dim>& body, int patch, FaceId face,
                                                     const PartnerMaker<Dim>& makePartner,
                                                     const ContactOptions& options, int firstMultiplier,
                                                     const std::vector<bool>& held,
                                                     const std::vector<DefinitionSpec>& definitions);

}  // namespace burnish::inline contact

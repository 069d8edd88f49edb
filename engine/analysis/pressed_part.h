#pragma once
#include "engine/contact/face_contact.h"

namespace burnish::inline analysis {

/// What of an undeformed face is pressed in the state that its contact has been evaluated at.
struct PressedPart {
  double area = 0.0;         ///< per thickness in the plane
  double largestSpan = 0.0;  ///< size of the largest knot span with a pressed point; 0 where none is
};

template <int Dim>
PressedPart pressedPart(const FaceContact<Dim>& contact);

/// Half the width of a contact: in the plane that of a strip of this area per thickness, in space the radius of a circle.
template <int Dim>
double halfWidthOf(double area);

}  // namespace burnish::inline analysis

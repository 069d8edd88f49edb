#pragma once
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <UnitsMethods.hxx>

#include "engine/cad/length_unit.h"

namespace burnish {

/// Shapes in memory, and files that are written, are in millimetres. To be called before a reader or writer is made.
inline void takeMillimetres() {
  STEPControl_Controller::Init();
  UnitsMethods::SetCasCadeLengthUnit(1.0);
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  Interface_Static::SetCVal("write.step.unit", "MM");
}

inline double millimetresOf(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Micrometre:
      return 1e-3;
    case LengthUnit::Millimetre:
      return 1.0;
    case LengthUnit::Centimetre:
      return 10.0;
    case LengthUnit::Metre:
      return 1000.0;
    case LengthUnit::Inch:
      return 25.4;
    case LengthUnit::Foot:
      return 304.8;
  }
  return 1.0;
}

}  // namespace burnish

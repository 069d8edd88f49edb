#pragma once
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <UnitsMethods.hxx>

namespace burnish::inline cad {

/// Shapes in memory, and files that are written, are in millimetres. To be called before a reader or writer is made.
inline void takeMillimetres() {
  STEPControl_Controller::Init();
  UnitsMethods::SetCasCadeLengthUnit(1.0);
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  Interface_Static::SetCVal("write.step.unit", "MM");
}

}  // namespace burnish::inline cad

#pragma once
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "engine/results/result.h"

class vtkPolyData;

/// What a frame holds beside the body's fields, as VTK data sets on current positions in double precision.
/// Units stand behind the names of arrays, see `labelled`. All throw `Error` if frame and model disagree.
namespace burnish {

/// What is in contact: faces with a tool, a pair of faces, both by name; neither where faces touch themselves.
struct ContactName {
  std::string tool, pair;

  bool operator==(const ContactName&) const = default;
};

/// What is in contact in a frame, each once.
std::vector<ContactName> contactsOf(const FrameRecord& frame);

/// The faces in contact that have the quadrature points, through these: one polyline per face in 2D,
/// quadrilaterals in 3D. Point data: `contact_pressure` (nominal, per undeformed area), `traction` (its
/// vector, with that of friction: what the face feels), `gap`, `status` (1 where it is pressed, else 0); with
/// friction `friction` (its vector, a part of the traction), `slip` in the last step, `slipped` (way since the start), `sliding` (0 open, 1 stick, 2 slip).
vtkSmartPointer<vtkPolyData> contactSurface(const ModelRecord& model, const FrameRecord& frame,
                                            const ContactName& contact);

/// The quadrature points of the body as vertices with the values there, not projected: stresses, `J`, …
vtkSmartPointer<vtkPolyData> quadraturePoints(const FrameRecord& frame);

/// The control points of the body and the lines between them. Point data: `displacement`, `weight`, `node`,
/// `in_contact` (1 for an active control point of a contact face, else 0).
vtkSmartPointer<vtkPolyData> controlNet(const ModelRecord& model, const FrameRecord& frame);

}  // namespace burnish

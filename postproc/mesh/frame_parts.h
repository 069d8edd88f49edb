#pragma once
#include <vtkSmartPointer.h>

#include <cstddef>

#include "engine/results/result.h"

class vtkPolyData;

/// What a frame holds beside the body's fields, as VTK data sets on current positions in double precision.
/// Units stand behind the names of arrays, see `labelled`. All throw `Error` if frame and model disagree.
namespace burnish {

/// The faces that `tool` may touch, through their quadrature points: one polyline per face in 2D,
/// quadrilaterals in 3D. Point data: `contact_pressure` (nominal, per undeformed area), `traction` (its
/// vector: what the tool does to the body), `gap`, `status` (1 where the tool presses, else 0). Without
/// points if the frame has no contact with the tool.
vtkSmartPointer<vtkPolyData> contactSurface(const ModelRecord& model, const FrameRecord& frame,
                                            std::size_t tool);

/// The same of the faces that may touch themselves: what the other part does to the one with the smaller
/// parameter.
vtkSmartPointer<vtkPolyData> selfContactSurface(const ModelRecord& model, const FrameRecord& frame);

/// The quadrature points of the body as vertices with the values there, not projected: stresses, `J`, …
vtkSmartPointer<vtkPolyData> quadraturePoints(const FrameRecord& frame);

/// The control points of the body and the lines between them. Point data: `displacement`, `weight`, `node`,
/// `in_contact` (1 for an active control point of a contact face, else 0).
vtkSmartPointer<vtkPolyData> controlNet(const ModelRecord& model, const FrameRecord& frame);

}  // namespace burnish

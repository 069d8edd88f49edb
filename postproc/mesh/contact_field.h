#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "engine/results/result.h"

class vtkPolyData;

namespace burnish {

/// Quantities of contact that are drawn on the faces that have its quadrature points: contact_pressure
/// (nominal), with friction friction_traction (its amount, nominal), slip (its amount in the last step),
/// slipped (way under pressure since the start) and sliding (0 open, 1 stick, 2 slip).
std::vector<std::string> contactFieldNames();
bool isContactField(const std::string& name);

/// Whether it is one that only contact with friction has.
bool isOfFriction(const std::string& name);

/// Those that a frame has.
std::vector<std::string> contactFieldsOf(const FrameRecord& frame);

/// What the values 0, 1, … of one of them mean; empty if they are amounts.
std::vector<std::string> statesOfContactField(const std::string& name);

/// Unit of one of them; may be empty.
std::string unitOfContactField(const ModelRecord& model, const std::string& name);

/// One of them at the quadrature points of a face: amounts. name: one that the face has.
Eigen::VectorXd contactValues(const ContactRecord& contact, const std::string& name);
/// The array of `contactSurface` that one of them shows, which has its unit behind its name.
struct ContactArray {
  std::string name;
  bool isVector = false;  ///< its amount is shown
};
ContactArray arrayOfContactField(const std::string& name);

/// The faces that have a contact field, as `contactSurface` has them; the point scalars are the values. Where
/// these are states, every point has the part of its cells that is nearest, with points of its own. name: one
/// of `contactFieldsOf`. Throws `Error` if frame and model disagree.
vtkSmartPointer<vtkPolyData> contactFieldFaces(const ModelRecord& model, const FrameRecord& frame,
                                               const std::string& name);

}  // namespace burnish

#pragma once
#include <string>
#include <vector>

#include "postproc/mesh/model_frame.h"

namespace burnish {

/// The bodies with these names alone: their patches, contact and points, and the fields that one of them has.
/// Nodes keep their numbers. Throws `Error` that lists the bodies for a name that none has.
ModelFrame chosenBodies(const ModelRecord& model, const FrameRecord& frame,
                        const std::vector<std::string>& names);

/// The mesh of a frame parted by whether its bodies have a field. No body has a contact field.
class FieldMesh {
 public:
  /// Model and frame must outlive the object.
  FieldMesh(const ModelRecord& model, const FrameRecord& frame, const std::string& field);

  const MeshRecord& with() const { return parted_ ? with_ : whole_; }

  /// Null if all bodies have the field.
  const MeshRecord* without() const { return parted_ ? &without_ : nullptr; }

 private:
  const MeshRecord& whole_;
  bool parted_;
  MeshRecord with_, without_;
};

/// Names of the bodies that do not have a field of the frame; none for `displacement`, which all have. Names
/// with a component, such as stress.xx, stand for their field.
std::vector<std::string> bodiesWithout(const ModelRecord& model, const FrameRecord& frame,
                                       const std::string& field);

}  // namespace burnish

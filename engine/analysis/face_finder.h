#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/solid/body.h"
#include "engine/solid/face_place.h"

namespace burnish {

/// A face of the body that is joined to no other patch.
struct OuterFace {
  FacePlace place;
  std::string text;  ///< for messages: 'top', or 'top' of patch 'rim'
};

/// The patches of a body by the names of the scene.
template <int Dim>
class FaceFinder {
 public:
  /// names: one per patch. The body must outlive the object.
  FaceFinder(const Body<Dim>& body, std::vector<std::string> names) : body_(body), names_(std::move(names)) {}

  /// Number of the patch; of the first one for an empty name.
  int patch(const std::string& name) const;

  /// The face that the scene names.
  FacePlace face(const FaceSpec& place) const { return {patch(place.patch), faceFromName<Dim>(place.face)}; }

  const Body<Dim>& body() const { return body_; }

  /// Name of the patch that the face is joined to; none for an outer face.
  std::optional<std::string> neighbour(const FaceSpec& place) const;

  /// All faces that are joined to no other patch.
  std::vector<OuterFace> outerFaces() const;

  /// Throws `InputError` at `key` if the face is joined to another patch: it lies inside the body.
  void requireOuter(const FaceSpec& place, const std::string& key) const;

  /// The part of a face as begin and end in [0, 1] for each of its directions; empty for all of it. Throws
  /// `InputError` below `key`, that of the place, for lengths that the face does not have.
  std::vector<double> part(const FaceSpec& place, const std::string& key) const;

  /// Functions of the patch on the face, and their nodes.
  std::vector<int> functions(const FaceSpec& place) const;
  std::vector<int> nodes(const FaceSpec& place) const;

 private:
  const Body<Dim>& body_;
  std::vector<std::string> names_;
};

}  // namespace burnish

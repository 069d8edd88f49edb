#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/solid/body.h"
#include "engine/solid/face_place.h"

namespace burnish::inline analysis {

/// A face of a body that is joined to no other patch.
struct OuterFace {
  FacePlace place;
  std::string text;  ///< for messages, see `FaceFinder::textOf`
};

/// What the scene calls a body and its patches.
struct BodyNames {
  std::string body;  ///< empty for the one body of a scene without `bodies`
  std::vector<std::string> patches;
};

/// The patches of bodies by the names of the scene. Patches are numbered over all bodies.
template <int Dim>
class FaceFinder {
 public:
  /// body: of the patches of all bodies, which must outlive the object.
  FaceFinder(const Body<Dim>& body, std::vector<BodyNames> names);

  /// Number of the patch; of the first one (of the first body) for an empty name.
  int patch(const std::string& body, const std::string& name) const;
  int patch(const FaceSpec& place) const { return patch(place.body, place.patch); }

  /// The face that the scene names.
  FacePlace face(const FaceSpec& place) const { return {patch(place), faceFromName<Dim>(place.face)}; }

  const Body<Dim>& body() const { return body_; }

  /// For messages: "'top'", with the names of the patch if its body has several and of the body if there are
  /// several.
  std::string textOf(const FacePlace& place) const;

  /// Name of the patch that the face is joined to; none for an outer face.
  std::optional<std::string> neighbour(const FacePlace& place) const;

  /// All faces that are joined to no other patch.
  std::vector<OuterFace> outerFaces() const;

  /// Throws `InputError` at `key` if the face is joined to another patch: it lies inside the body.
  void requireOuter(const FaceSpec& place, const std::string& key) const;

  /// The part of a face as begin and end in [0, 1] for each of its directions; empty for all of it. Throws
  /// `InputError` below `key`, that of the place, for lengths that the face does not have.
  std::vector<double> part(const FaceSpec& place, const std::string& key) const;

  /// Nodes of the face.
  std::vector<int> nodes(const FaceSpec& place) const;

 private:
  /// Of a patch: its body, and its own name.
  struct Name {
    std::size_t body;
    std::string patch;
  };

  std::vector<int> nodesOn(const FacePlace& place) const;

  const Body<Dim>& body_;
  std::vector<BodyNames> names_;
  std::vector<Name> patches_;
};

}  // namespace burnish::inline analysis

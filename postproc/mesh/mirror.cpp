#include "postproc/mesh/mirror.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/recorded_shape.h"

namespace burnish {
namespace {

/// Lengths that are rounding, as a part of the size of the body; displacements on a plane of symmetry.
constexpr double kRounding = 1e-9, kStaysOnPlane = 1e-6;

char nameOf(const MirrorPlane& plane) {
  return "xyz"[plane.axis];
}

/// Points as columns.
Eigen::MatrixXd image(Eigen::MatrixXd points, const MirrorPlane& plane) {
  points.row(plane.axis) = (2.0 * plane.at - points.row(plane.axis).array()).matrix();
  return points;
}

/// Vectors as columns.
Eigen::MatrixXd imageOfVectors(Eigen::MatrixXd vectors, const MirrorPlane& plane) {
  if (vectors.cols() > 0) vectors.row(plane.axis) *= -1.0;
  return vectors;
}

Eigen::Affine3d mapOf(const MirrorPlane& plane) {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear()(plane.axis, plane.axis) = -1.0;
  map.translation()(plane.axis) = 2.0 * plane.at;
  return map;
}

/// The nodes of a mesh and of its image.
struct MirroredNodes {
  int count = 0;               ///< of both together
  std::vector<int> image;      ///< of each node; a node on the plane is its own
  std::vector<int> originals;  ///< the nodes that have another node for an image, in its order
};

/// Adds the image of a model in one plane.
class Mirror {
 public:
  Mirror(ModelFrame& whole, const MirrorPlane& plane) : whole_(whole), plane_(plane) {
    check(plane.axis >= 0 && plane.axis < whole.model.dim && std::isfinite(plane.at),
          fmt::format("the model has {} dimensions", whole.model.dim));
    findSize();
    numberImages();
  }

  void addImages() {
    if (whole_.frame.mesh) {
      addPatches(*whole_.frame.mesh, nodes_);
      addPatches(whole_.model.mesh, nodesOf(whole_.model.mesh, kRounding));
    } else {
      addPatches(whole_.model.mesh, nodes_);
    }
    addToNodes();
    addContact();
    addTools();
  }

 private:
  void check(bool holds, const std::string& what) const {
    if (!holds)
      throw Error(fmt::format("mirror: found the plane {} = {:.6g}; {}", nameOf(plane_), plane_.at, what));
  }

  void findSize() {
    Eigen::AlignedBox3d box;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const PatchRecord& patch : whole_.model.mesh.patches)
      for (const auto& point : patch.points.colwise()) {
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        x.head(point.size()) = point;
        box.extend(x);
        low = std::min(low, point(plane_.axis));
        high = std::max(high, point(plane_.axis));
      }
    size_ = box.diagonal().norm();
    const double rounding = kRounding * size_;
    const bool isAxis =
        plane_.axis == 0 && plane_.at == 0.0 && low >= -rounding && isAxisymmetric(whole_.model);
    check(isAxis || std::abs(low - plane_.at) <= rounding || std::abs(high - plane_.at) <= rounding,
          fmt::format(
              "the undeformed body goes from {0} = {1:.6g} to {0} = {2:.6g}; expected one of these ends",
              nameOf(plane_), low, high));
  }

  /// tolerance: a part of the size of the body.
  MirroredNodes nodesOf(const MeshRecord& mesh, double tolerance) const {
    MirroredNodes nodes{mesh.numNodes, std::vector<int>(static_cast<std::size_t>(mesh.numNodes), -1), {}};
    for (const PatchRecord& patch : mesh.patches)
      for (std::size_t a = 0; a < patch.nodes.size(); ++a)
        if (std::abs(patch.points(plane_.axis, static_cast<Eigen::Index>(a)) - plane_.at) <=
            tolerance * size_)
          nodes.image[static_cast<std::size_t>(patch.nodes[a])] = patch.nodes[a];
    for (std::size_t node = 0; node < nodes.image.size(); ++node)
      if (nodes.image[node] < 0) {
        nodes.image[node] = nodes.count++;
        nodes.originals.push_back(static_cast<int>(node));
      }
    return nodes;
  }

  /// Of the frame's mesh. Where the material of a mesh made on the way was at the start is known as well as
  /// displacements are.
  void numberImages() {
    const FrameRecord& frame = whole_.frame;
    nodes_ = nodesOf(meshOf(whole_.model, frame), frame.mesh ? kStaysOnPlane : kRounding);
    for (Eigen::Index node = 0; node < frame.displacement.cols(); ++node)
      if (nodes_.image[static_cast<std::size_t>(node)] == node)
        check(std::abs(frame.displacement(plane_.axis, node)) <= kStaysOnPlane * size_,
              fmt::format("the body leaves it in frame {}, so that it is no plane of symmetry", frame.index));
  }

  /// With the first direction reversed, so that the image is not inside out.
  PatchRecord imageOf(const PatchRecord& patch, const std::vector<int>& imageOfNode) const {
    PatchRecord result = patch;
    DirectionRecord& first = result.directions.front();
    const double sum = first.knots.front() + first.knots.back();
    std::reverse(first.knots.begin(), first.knots.end());
    for (double& knot : first.knots) knot = sum - knot;
    const int row = basisOf(first).numFunctions();
    const Eigen::MatrixXd points = image(patch.points, plane_);
    for (Eigen::Index a = 0; a < points.cols(); ++a) {
      const Eigen::Index from = a - a % row + row - 1 - a % row;
      result.points.col(a) = points.col(from);
      result.weights(a) = patch.weights(from);
      result.nodes[static_cast<std::size_t>(a)] =
          imageOfNode[static_cast<std::size_t>(patch.nodes[static_cast<std::size_t>(from)])];
    }
    return result;
  }

  void addPatches(MeshRecord& mesh, const MirroredNodes& nodes) const {
    const std::size_t count = mesh.patches.size();
    for (std::size_t p = 0; p < count; ++p) mesh.patches.push_back(imageOf(mesh.patches[p], nodes.image));
    mesh.numNodes = nodes.count;
  }

  /// Values at nodes with those of their images. signs: one per component.
  Eigen::MatrixXd withImages(const Eigen::MatrixXd& values, const Eigen::VectorXd& signs) const {
    Eigen::MatrixXd all(values.rows(), nodes_.count);
    all << values, signs.asDiagonal() * values(Eigen::all, nodes_.originals);
    return all;
  }

  Eigen::VectorXd signsOf(const FieldRecord& field) const {
    Eigen::VectorXd signs = Eigen::VectorXd::Ones(field.values.rows());
    for (std::size_t c = 0; c < field.components.size(); ++c)
      signs(static_cast<Eigen::Index>(c)) = signInMirror(field.components[c], plane_.axis);
    return signs;
  }

  void addToNodes() {
    FrameRecord& frame = whole_.frame;
    Eigen::VectorXd signs = Eigen::VectorXd::Ones(frame.displacement.rows());
    signs(plane_.axis) = -1.0;
    frame.displacement = withImages(frame.displacement, signs);
    for (auto& [name, field] : frame.fields) field.values = withImages(field.values, signsOf(field));
  }

  /// The first direction of the image is reversed.
  static std::string faceOfImage(const std::string& face) {
    const FaceId id = faceFromName<3>(face);
    return id / 2 == 0 ? faceName(1 - id) : face;
  }

  void addContact() {
    std::vector<ContactRecord>& contact = whole_.frame.contact;
    const std::size_t count = contact.size();
    for (std::size_t k = 0; k < count; ++k) {
      ContactRecord copy = contact[k];
      copy.patch += static_cast<int>(meshOf(whole_.model, whole_.frame).patches.size() / 2);
      copy.face = faceOfImage(copy.face);
      for (int& node : copy.nodes) node = nodes_.image[static_cast<std::size_t>(node)];
      copy.quadraturePoints = image(copy.quadraturePoints, plane_);
      for (Eigen::MatrixXd* vectors :
           {&copy.quadratureNormal, &copy.quadratureFriction, &copy.quadratureSlip})
        if (vectors->size() > 0) *vectors = imageOfVectors(*vectors, plane_);
      contact.push_back(std::move(copy));
    }
  }

  bool isOwnImage(const ToolRecord& tool) const {
    return areSame(tool.shape, mappedShape(tool.shape, mapOf(plane_)), kRounding * size_);
  }

  void addTools() {
    std::vector<ToolRecord>& tools = whole_.model.tools;
    FrameRecord& frame = whole_.frame;
    const std::size_t count = tools.size();
    for (std::size_t k = 0; k < count; ++k) {
      ToolRecord copy = tools[k];
      copy.shape = mappedShape(tools[k].shape, mapOf(plane_));
      const Eigen::Vector3d axis = imageOfVectors(tools[k].axis, plane_);
      copy.pivot = image(tools[k].pivot, plane_);
      copy.axis = -axis;  // a turn goes round the other way in a mirror
      if (isOwnImage(tools[k]) && isOwnImage(placedTool(whole_.model, frame, k))) continue;
      const auto tool = static_cast<Eigen::Index>(k), last = frame.toolDisplacement.cols();
      frame.toolDisplacement.conservativeResize(Eigen::NoChange, last + 1);
      frame.toolDisplacement.col(last) = imageOfVectors(frame.toolDisplacement.col(tool), plane_);
      if (frame.toolAngle.size() > 0) {
        frame.toolAngle.conservativeResize(last + 1);
        frame.toolAngle(last) = frame.toolAngle(tool);
      }
      tools.push_back(std::move(copy));
    }
  }

  ModelFrame& whole_;
  MirrorPlane plane_;
  double size_ = 0.0;    ///< of the body
  MirroredNodes nodes_;  ///< of the frame's mesh
};

}  // namespace

double signInMirror(const std::string& component, int axis) {
  return std::ranges::count(component, "xyz"[axis]) % 2 == 1 ? -1.0 : 1.0;
}

ModelFrame mirrored(const ModelRecord& model, const FrameRecord& frame,
                    const std::vector<MirrorPlane>& planes) {
  ModelFrame whole{model, {}};
  whole.frame.index = frame.index;
  whole.frame.step = frame.step;
  whole.frame.time = frame.time;
  whole.frame.mesh = frame.mesh;
  whole.frame.displacement = frame.displacement;
  whole.frame.fields = frame.fields;
  whole.frame.toolDisplacement = frame.toolDisplacement;
  whole.frame.toolAngle = frame.toolAngle;
  whole.frame.contact = frame.contact;
  for (const MirrorPlane& plane : planes) Mirror(whole, plane).addImages();
  return whole;
}

}  // namespace burnish

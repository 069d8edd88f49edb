#pragma once
#include <Eigen/Dense>
#include <concepts>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "engine/tools/gap_query.h"
#include "engine/tools/recorded_shape.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

/// What a shape of a tool answers for:
///
///     query          gap at a point and its derivatives
///     halfThickness  how deep a point can be inside the tool before the nearest surface is on another side of
///                    it; infinity for a plane and an edge. A bound for simple forms, else an estimate
///     middle         the point that stands for the shape: its centre or tip, or where a plane was given
///     outline        its surface, to be drawn in so many dimensions: roundings in pieces of 5 degrees,
///                    infinite shapes cut at the distance `reach` from their own point
///
/// A shape may say `halfThicknessOfDie` too: how deep a point can be in the die around it, else infinity; and
/// `bulge`: how far it stands out of what it was made from, else 0.
template <class S>
concept ToolSurface = requires(const S& shape, const Eigen::Vector3d& x) {
  { shape.query(x) } -> std::same_as<GapQuery>;
  { shape.halfThickness() } -> std::same_as<double>;
  { shape.middle() } -> std::same_as<Eigen::Vector3d>;
  { shape.outline(2, 1.0) } -> std::same_as<SurfaceMesh>;
};

/// Any shape of a rigid tool, in the tool's reference position. 2D scenes live in the plane z = 0. Copies
/// share the shape, which does not change.
class RigidShape {
 public:
  RigidShape() : RigidShape(Plane{}) {}

  template <class S>
  requires(!std::same_as<S, RigidShape> && ToolSurface<S>) RigidShape(S shape)
      : shape_(std::make_shared<const Held<S>>(std::move(shape))) {}

  GapQuery query(const Eigen::Vector3d& x) const { return shape_->query(x); }
  double halfThickness() const { return shape_->halfThickness(); }
  double halfThicknessOfDie() const { return shape_->halfThicknessOfDie(); }
  double bulge() const { return shape_->bulge(); }
  Eigen::Vector3d middle() const { return shape_->middle(); }
  SurfaceMesh outline(int dim, double reach) const { return shape_->outline(dim, reach); }

  /// What a result keeps of it: the shape as it is if it can, else its outline.
  RecordedShape recorded(int dim, double reach) const { return shape_->recorded(dim, reach); }

 private:
  struct Any {
    virtual ~Any() = default;
    virtual GapQuery query(const Eigen::Vector3d& x) const = 0;
    virtual double halfThickness() const = 0;
    virtual double halfThicknessOfDie() const = 0;
    virtual double bulge() const = 0;
    virtual Eigen::Vector3d middle() const = 0;
    virtual SurfaceMesh outline(int dim, double reach) const = 0;
    virtual RecordedShape recorded(int dim, double reach) const = 0;
  };

  template <class S>
  struct Held final : Any {
    explicit Held(S held) : shape(std::move(held)) {}

    GapQuery query(const Eigen::Vector3d& x) const override { return shape.query(x); }
    double halfThickness() const override { return shape.halfThickness(); }
    double halfThicknessOfDie() const override {
      if constexpr (requires { shape.halfThicknessOfDie(); })
        return shape.halfThicknessOfDie();
      else
        return std::numeric_limits<double>::infinity();
    }
    double bulge() const override {
      if constexpr (requires { shape.bulge(); })
        return shape.bulge();
      else
        return 0.0;
    }
    Eigen::Vector3d middle() const override { return shape.middle(); }
    SurfaceMesh outline(int dim, double reach) const override { return shape.outline(dim, reach); }
    RecordedShape recorded(int dim, double reach) const override {
      if constexpr (std::is_constructible_v<RecordedShape, S>)
        return shape;
      else
        return shape.outline(dim, reach);
    }

    S shape;
  };

  std::shared_ptr<const Any> shape_;
};

}  // namespace burnish::inline tools

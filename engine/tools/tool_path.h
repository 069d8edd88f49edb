#pragma once
#include <Eigen/Dense>
#include <optional>
#include <variant>
#include <vector>

#include "engine/schema/alternatives.h"
#include "engine/schema/coordinates.h"

/// Paths of tools: where a tool goes, and when.
namespace burnish::inline tools {

/// Straight from point to point.
struct PolylinePath {
  static constexpr PartKind kind{"polyline", "Straight from point to point; one pass."};

  std::vector<std::vector<double>> points;  ///< displacements from the tool's place in the scene
};

template <class Visitor>
void describe(Visitor& v, PolylinePath& s) {
  v.field("points", s.points, {.required = true, .minEntries = 2, .unit = "length"},
          "Displacements of the tool from its place in the scene, one after the other.");
}

/// Parallel passes.
struct RasterPath {
  static constexpr PartKind kind{"raster", "Parallel passes, a feed apart."};

  Point start;
  Direction stroke, feed;
  int passes = 1;
  bool bothWays = false;
};

template <class Visitor>
void describe(Visitor& v, RasterPath& s) {
  v.field("start", s.start, {.unit = "length"},
          "Displacement at which the first pass begins; none when left out.");
  v.field("stroke", s.stroke, {.required = true, .unit = "length"}, "Way of a pass.");
  v.field("feed", s.feed, {.unit = "length"}, "Way from pass to pass; the same track again when left out.");
  v.field("passes", s.passes, {.atLeast = 1, .atMost = 10'000}, "Number of passes.");
  v.field("both_ways", s.bothWays, {},
          "Whether every other pass goes back; else all begin on the same side.");
}

/// Round an axis and along it.
struct HelixPath {
  static constexpr PartKind kind{"helix",
                                 "Round an axis and along it, at the distance that the tool has (3D)."};

  Point center;  ///< of the axis
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double pitch = 0.0;
  double turns = 1.0;
};

template <class Visitor>
void describe(Visitor& v, HelixPath& s) {
  v.field("center", s.center, {.required = true, .unit = "length"}, "A point of the axis.");
  v.field("axis", s.axis, {}, "Direction of the axis.");
  v.field("pitch", s.pitch, {.unit = "length"}, "Way along the axis per turn.");
  v.field("turns", s.turns, {.above = 0, .atMost = 10'000},
          "Number of turns, counter-clockwise where the axis points at the reader.");
}

using PathCourse = std::variant<PolylinePath, RasterPath, HelixPath>;

/// A path with its speed.
struct PathSpec {
  PathCourse course;
  double speed = 1.0;
  double begin = 0.0;   ///< time at which the tool sets off
  Direction clearance;  ///< from where the tool comes down, and to where it is lifted; none when left out
  double ramp =
      0.0;  ///< way at the begin and the end of a pass on which the force on the tool comes and goes
  std::optional<double> stepPerHalfWidth;  ///< largest way of a step in a pass, over the contact's half width
};

template <class Visitor>
void describe(Visitor& v, PathSpec& s) {
  v.alternatives("course", s.course, alternativesOf(s.course), "Course of the path.");
  v.field("speed", s.speed, {.required = true, .above = 0, .unit = "length per time"}, "Speed of the tool.");
  v.field("begin", s.begin, {.atLeast = 0, .unit = "time"}, "Time at which the tool sets off.");
  v.field("clearance", s.clearance, {.unit = "length"},
          "Away from the body: by so much the tool is off it before a pass, comes down, and is lifted after "
          "it. A helix turns it with the tool. Without it the tool begins and ends where the passes do.");
  v.field(
      "ramp", s.ramp, {.atLeast = 0, .unit = "length"},
      "Way at the begin of a pass on which the force that the tool carries along clearance comes up from a "
      "twentieth, with which it touches, and at the end of the pass goes back to that. All turns of a helix are one "
      "pass here.");
  v.field(
      "step_per_half_width", s.stepPerHalfWidth, {.above = 0},
      "Largest way of the tool in a step of a pass, over the half width of its contact at the first full force; "
      "the steps of the scene are divided so.");
}

/// Where a tool on a path is.
class ToolPath {
 public:
  /// pivot: of the tool at its place in the scene.
  ToolPath(const PathSpec& spec, const Eigen::Vector3d& pivot);

  /// Displacement at time t; at rest before and after the path.
  Eigen::Vector3d displacement(double t) const;

  /// Turn about the axis of a helix at time t, in radians; none on other paths.
  double turn(double t) const;

  /// Unit vector along the axis of a helix; zero on other paths.
  Eigen::Vector3d axis() const;

  /// Times at which the direction changes, in order, the begin and the end among them; behind these those at which
  /// the share of the force has a corner.
  std::vector<double> corners() const;

  /// Share of the force across the path that the tool carries at time t.
  double forceShare(double t) const;

  struct Pass {
    double begin, end;  ///< times
  };

  /// In order. Of a helix: its turns.
  const std::vector<Pass>& passes() const { return passes_; }

  /// Times at which a pass (of a helix, a turn) is done, in order.
  std::vector<double> passEnds() const;

  /// From where the tool comes down to where it is lifted, in order: passes that follow one another in touch, as the
  /// turns of a helix, are one.
  const std::vector<Pass>& touches() const { return touches_; }

  /// Whether it has been lifted off a touch and does not come down to the next one yet. Never without clearance.
  bool isLifted(double t) const;

  /// The same, and it is not on its way up any more.
  bool hasBeenLifted(double t) const;

  /// Way of the part of a touch that the tool goes at time t or, in the air, that it comes down to; none behind the last.
  Eigen::Vector3d wayAhead(double t) const;

  /// From where the tool comes down and to where it is lifted, as a helix has turned it at time t.
  Eigen::Vector3d clearance(double t) const;

  /// Whether it is in the part of a touch in which the force is full, its ends included.
  bool hasFullForce(double t) const;

  double speed() const { return speed_; }

  double end() const { return legs_.empty() ? begin_ : legs_.back().end; }

 private:
  /// Straight way, or part of the helix, that begins when the one before ends.
  struct Leg {
    double begin, end;
    Eigen::Vector3d from, to;  ///< displacements
    double turnFrom = 0.0, turnTo = 0.0;
    bool isHelical = false;
  };

  void lay(const PolylinePath& path);
  void lay(const RasterPath& path);
  void lay(const HelixPath& path);

  /// A straight way to a displacement.
  void goTo(const Eigen::Vector3d& to);

  /// From when to when the force of a touch is full.
  Pass fullForceIn(const Pass& touch) const { return {touch.begin + rampTime_, touch.end - rampTime_}; }

  void beginPass() { passes_.push_back({end(), end()}); }
  void endPass();

  /// Displacement of the tool when it has turned about the axis of a helix.
  Eigen::Vector3d onHelix(double turn) const;

  const Leg* legAt(double t) const;

  double speed_, begin_, rampTime_;
  Eigen::Vector3d clearance_, pivot_;
  std::optional<HelixPath> helix_;
  Eigen::Vector3d here_ = Eigen::Vector3d::Zero();  ///< displacement at the end of the last leg
  std::vector<Leg> legs_;
  std::vector<Pass> passes_, touches_;
};

}  // namespace burnish::inline tools

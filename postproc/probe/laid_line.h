#pragma once
#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "postproc/probe/nearest_on_face.h"

namespace burnish {

/// A straight line laid on a face in space, by the arc length of the curve that it is there: each of its points goes to the
/// nearest one of the face. Where the line runs on beyond the border there is a gap as long as it is itself, and where the
/// nearest point jumps, as across a groove, one as long as the jump. Along a border that it runs beside, beyond it by less
/// than three tenths of its distance, it follows that: in a plane of symmetry the face is never quite normal to the plane.
class LaidLine {
 public:
  /// What is at a length.
  struct Place {
    std::optional<Eigen::Vector2d> xi;  ///< parameters of the face; nothing in a gap
    Eigen::Vector3d position;           ///< on the face; in a gap on the line
  };

  /// The face is looked at from `points` (2 or more) equally distant points of the line, and where windows of this width need
  /// it also from beyond its ends. Throws `Error` for a line across the face, which is a point on it.
  LaidLine(const Patch<2, 3>& face, const Eigen::Vector3d& begin, const Eigen::Vector3d& end, int points,
           double window);

  double length() const { return length_; }

  /// Smallest and largest length that `at` knows: 0 and `length()` without windows.
  std::array<double, 2> ofWindows() const;

  Place at(double length) const;

  /// "across from face top, which lies between (0, 1, 0) and (1, 1, 1)": where a line has a part on the face.
  std::string where(const std::string& face) const;

 private:
  /// Where a point of the line is as seen from the face.
  enum class Where { Across, Beside, Beyond };
  struct Side {
    Where where = Where::Beyond;
    std::array<int, 2> border{};  ///< which one it is beside, see `NearestOnFace`

    bool operator==(const Side&) const = default;
  };

  /// A point of the line and that of the face.
  struct Laid {
    double along = 0.0;  ///< the line, from its begin
    Eigen::Vector3d onLine;
    NearestOnFace<3>::Found nearest;
    Side side;
  };

  /// Part of the curve, or a gap.
  struct Piece {
    Laid from, to;
    double begin = 0.0, length = 0.0;
    bool isGap = false;
  };

  Laid lay(double along) const;
  void add(double from, double to, int points);
  void add(const Laid& from, const Laid& to, int halvings);
  void addChange(const Laid& from, const Laid& to, int halvings);
  void addPiece(const Laid& from, const Laid& to, double length, bool isGap);
  double reach() const;

  NearestOnFace<3> nearest_;
  Eigen::Vector3d begin_, direction_;
  std::vector<Piece> pieces_;
  double length_ = 0.0;
  int cuts_ = 0;  ///< into halves so far
};

/// What is wrong with all of a face in space as a path, with a line that would do.
Error areaIsNoPath(const Patch<2, 3>& face, const std::string& name);

/// What is wrong with a line on a face in the plane.
Error planeFaceIsPath();

}  // namespace burnish

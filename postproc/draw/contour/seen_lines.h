#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "postproc/draw/page/view.h"

class vtkPolyData;

namespace burnish {

class RayStops;

/// A surface that hides lines behind it, as it is drawn.
struct HidingSurface {
  vtkSmartPointer<vtkPolyData> shape;
  double lift;     ///< towards the eye
  double opacity;  ///< what comes through a surface is this much less dark
};

/// Which part of lines in space is seen from the eye of a view: from where rays to the eye meet no surface. Where they begin
/// is as far before a line as this is drawn before the surface.
class SeenLines {
 public:
  /// Throws as `RayStops`.
  SeenLines(const std::vector<HidingSurface>& surfaces, const View& view);
  ~SeenLines();
  SeenLines(const SeenLines&) = delete;
  SeenLines& operator=(const SeenLines&) = delete;

  /// A part of a line that is behind the same surfaces everywhere.
  struct Piece {
    std::vector<Eigen::Vector3d> places;
    double share;  ///< of its darkness that comes through
  };

  /// The parts of polylines, seen are those of which the middle or one of the sides is seen in the area of the view, or which may be beside it: of one
  /// round a surface the side beyond it. What is hidden or seen over less than a quarter of a pixel may be missed. lift: towards
  /// the eye, as they are drawn. width: in pixels.
  std::vector<Piece> piecesOf(vtkPolyData& lines, double lift, double width) const;

  /// The parts of which hardly anything is seen.
  vtkSmartPointer<vtkPolyData> hiddenOf(vtkPolyData& lines, double lift, double width) const;

  /// What comes through of the darkness of a point.
  double shareAt(const Eigen::Vector3d& point, double lift) const;

 private:
  struct Group;
  View view_;
  std::vector<Group> groups_;  ///< of surfaces of the same lift and opacity
};

}  // namespace burnish

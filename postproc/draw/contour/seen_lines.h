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
  /// Of what of its darkness less comes through counts as hidden.
  static constexpr double kHidden = 0.25;

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

  /// Polylines in the area of the view, in parts, of which those are seen whose middle or one of whose sides is: a line round a surface
  /// is seen from beyond it. Where less than a quarter of a pixel is hidden or seen, that may be missed. lift: towards the eye, as
  /// they are drawn. width: in pixels. Throws `Interrupted`.
  std::vector<Piece> piecesOf(vtkPolyData& lines, double lift, double width) const;

  /// The parts that are hidden.
  vtkSmartPointer<vtkPolyData> hiddenOf(vtkPolyData& lines, double lift, double width) const;

  /// What comes through of the darkness of a point.
  double shareAt(const Eigen::Vector3d& point, double lift) const;

 private:
  struct Group;
  View view_;
  std::vector<Group> groups_;  ///< of surfaces of the same lift and opacity
};

}  // namespace burnish

#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/result.h"
#include "engine/scene/scene.h"
#include "postproc/draw/page/rich_text.h"
#include "postproc/draw/page/view.h"
#include "postproc/draw/setup/setup_faces.h"
#include "postproc/draw/setup/setup_loads.h"

class vtkPolyData;

namespace burnish {

/// What moves, from where, and how.
struct Mover {
  std::string name;
  Eigen::Vector2d start;  ///< of the arrows, in pixels
  std::vector<Eigen::Vector2d> phases;
  bool toScale;  ///< the arrows are as long as the phases, if that is long enough
  bool differs;  ///< from point to point of a face: the phases are those of its middle
};

/// Where everything stands in the drawing of a set-up in two dimensions.
class SetupLayout {
 public:
  /// Throws `Error` if the picture is too small. The model must outlive the layout.
  SetupLayout(const ModelRecord& model, const std::array<int, 2>& size);

  const Scene& scene() const { return scene_; }
  /// Those of the model; what is no closed shape only near the body.
  const std::vector<ToolRecord>& tools() const { return tools_; }
  const SetupFaces& faces() const { return faces_; }
  const View& view() const { return view_; }
  /// Cells per knot span and direction that draw curves smoothly.
  int subdivision() const { return subdivision_; }
  double textSize() const { return textSize_; }
  double endTime() const { return end_; }
  /// The end of the run, or the time at which the tool is taken away.
  double endTime(std::size_t tool) const { return scene_.tools[tool].until.value_or(end_); }

  /// Box of the undeformed body, and the one along which planes are drawn.
  const Eigen::AlignedBox3d& box() const { return box_; }
  const Eigen::AlignedBox3d& toolBox() const { return toolBox_; }

  /// Lower and upper end in pixels of the axis of an axisymmetric body, if it is near enough to be drawn.
  std::optional<std::array<Eigen::Vector2d, 2>> axis() const;

  /// Whether a line lies on the axis of an axisymmetric body.
  bool isOnAxis(const std::vector<Eigen::Vector2d>& line) const;

  /// A face with its points in pixels.
  FaceLine pixels(const FaceSpec& place) const;

  /// Lines of the outline of a tool in pixels; those that are closed end where they begin.
  std::vector<std::vector<Eigen::Vector2d>> toolPixels(std::size_t tool, const Eigen::Vector2d& shift) const;

  /// Of the part of a tool that is seen, or the point of a plane that is nearest to the body's middle; in
  /// pixels.
  Eigen::Vector2d middleOf(std::size_t tool) const;

  /// What a tool carries.
  DrawnToolLoad carriedBy(std::size_t tool) const;

  /// "F = 2.0 MPa·mm" of a force per thickness, or of one on a ring; "M = ..." of a moment.
  std::string forceText(double force) const;
  std::string momentText(double moment) const;

  /// Displacement of a tool at the end.
  Eigen::Vector2d endOf(std::size_t tool) const;

  std::vector<Mover> movers() const;

  /// Lines about how far the movers go, and where the middle of the lowest one lies.
  std::vector<RichText> amounts() const;
  Eigen::Vector2d amountsAt(const RichText& line) const;

  /// Offsets of the dimension lines of the width, below the body, and of the height, left of it.
  Eigen::Vector2d belowBody() const;
  Eigen::Vector2d besideBody() const;

  static constexpr int kDigits = 6;

  /// A number as it is set, with a unit if there is any.
  static std::string number(double value, const std::string& unit, int digits = kDigits);
  std::string length(double value) const { return number(value, model_.lengthUnit); }

  /// What one of so many phases is called.
  static RichText phaseName(std::size_t count, std::size_t phase);

 private:
  vtkSmartPointer<vtkPolyData> outlineOf(std::size_t tool, const Eigen::Vector2d& shift) const;
  /// Room beside the body in text sizes, on the side to which a normal points.
  struct Rooms {
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;

    double& at(const Eigen::Vector2d& normal);
  };

  std::vector<Eigen::Vector2d> phasesOf(std::size_t tool) const;
  Eigen::AlignedBox2d toolBounds(std::size_t tool, const Eigen::Vector2d& shift) const;
  Eigen::Vector2d arrowStart(const Eigen::Vector2d& at, const Eigen::Vector2d& normal,
                             const Eigen::Vector2d& phase) const;
  void findBoxes();
  void findTools();
  void findRooms();
  void findRoomsOfTools();
  void findView();
  bool axisIsNear() const;

  const ModelRecord& model_;
  Scene scene_;
  int subdivision_;
  SetupFaces faces_;
  std::array<int, 2> size_;
  double textSize_;
  double end_;  ///< of the run
  Eigen::AlignedBox3d box_, toolBox_;
  double lowest_ = 0.0;  ///< y of the lowest of body and tools
  std::vector<ToolRecord> tools_;
  Rooms rooms_;
  View view_;
};

}  // namespace burnish

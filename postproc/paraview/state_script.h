#pragma once
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/theme.h"
#include "postproc/draw/page/view.h"

namespace burnish {

/// What a script of ParaView shows of a series of VTK files.
struct StateScript {
  std::vector<std::string> colored, plain, tools, knots, hidden;  ///< blocks

  /// Of the blocks that are coloured; nothing of it counts without any.
  struct Field {
    std::string array, component;  ///< in the files; component: empty where there is but one
    std::string title;
    ColorScale scale;
    std::vector<std::string> states{};  ///< what the values 0, 1, … mean; empty for quantities
  };
  std::optional<Field> field;

  std::optional<double> time{};  ///< that is shown; the last one without

  ViewAxes axes = ViewAxes::Identity();
  Eigen::AlignedBox2d window;  ///< of the view's plane, that is seen; may be empty
  Eigen::AlignedBox3d box;     ///< of the bodies; may be empty
  std::array<int, 2> size{};   ///< pixels of a picture
  Theme theme;
  double toolOpacity = 1.0;
  bool isFlat = false;    ///< a plane body
  bool isCurved = false;  ///< cells are
};

/// The script: a program in Python, which names the collection `frames.pvd` in its own directory.
std::string textOf(const StateScript& script);

}  // namespace burnish

#include "postproc/paraview/state_script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "postproc/paraview/paraview_texts.h"
#include "postproc/text/page.h"
#include "postproc/text/plain_time.h"

namespace burnish {
namespace {

/// Of light on bodies in space: enough to see their shape, little enough to read their colours.
constexpr double kSpaceLight = 0.45;

/// ParaView's lines through a curved cell: with four, the eye finds no corners.
constexpr int kCurvedSubdivision = 4;

/// A text as Python spells it.
std::string spelled(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < ' ')
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

std::string listOf(std::vector<std::string> texts) {
  for (std::string& text : texts) text = spelled(text);
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string listOf(const Eigen::Vector3d& vector) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", vector.x() + 0.0, vector.y() + 0.0, vector.z() + 0.0);
}

std::string hex(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

/// Colours one after the other, as many to a line as the other lines of the script are long.
std::string listOf(const std::vector<Color>& colors) {
  constexpr std::size_t kPerLine = 12;
  std::string text = "(";
  for (std::size_t k = 0; k < colors.size(); ++k) {
    if (k % kPerLine == 0) text += "\n    \"";
    text += hex(colors[k]);
    if (k + 1 == colors.size())
      text += '"';
    else
      text += k % kPerLine == kPerLine - 1 ? " \"" : " ";
  }
  return text + "\n)";
}

/// The middle of the window, as deep in space as the middle of the bodies.
Eigen::Vector3d centerOf(const StateScript& script, const Eigen::Vector3d& eye) {
  if (script.box.isEmpty()) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d middle = script.box.center();
  if (script.window.isEmpty()) return middle;
  return script.axes.transpose() * script.window.center() + eye.dot(middle) * eye;
}

}  // namespace

std::string textOf(const StateScript& script) {
  const Eigen::Vector3d up = script.axes.row(1).transpose(),
                        eye = Eigen::Vector3d(script.axes.row(0).transpose()).cross(up);
  const Eigen::Vector2d window =
      script.window.isEmpty() ? Eigen::Vector2d(1.0, 1.0) : script.window.sizes().cwiseMax(1e-9);
  const auto& field = script.field;
  return filled(
      kStateScript,
      {{"@colored@", listOf(script.colored)},
       {"@plain@", listOf(script.plain)},
       {"@tools@", listOf(script.tools)},
       {"@knots@", listOf(script.knots)},
       {"@hidden@", listOf(script.hidden)},
       {"@array@", field ? spelled(field->array) : "None"},
       {"@component@", field && !field->component.empty() ? spelled(field->component) : "None"},
       {"@title@", spelled(field ? field->title : "")},
       {"@range@",
        field ? fmt::format("{:.6g}, {:.6g}", field->scale.range()[0], field->scale.range()[1]) : "0, 1"},
       {"@colors@", field ? listOf(field->scale.joints()) : "\"\""},
       {"@steps@", std::to_string(field ? field->scale.colors().size() : 0)},
       {"@states@", listOf(field ? field->states : std::vector<std::string>())},
       {"@time@", script.time ? fmt::format("{}", plainTime(*script.time)) : "None"},
       {"@eye@", listOf(eye)},
       {"@up@", listOf(up)},
       {"@center@", listOf(centerOf(script, eye))},
       {"@window@", fmt::format("{:.6g}, {:.6g}", window.x(), window.y())},
       {"@size@", fmt::format("[{}, {}]", script.size[0], script.size[1])},
       {"@paper@", spelled(hex(script.theme.paper))},
       {"@ink@", spelled(hex(script.theme.ink))},
       {"@plain_color@", spelled(hex(script.theme.tool))},
       // Lines take a stronger colour than areas.
       {"@tool_color@", spelled(hex(script.isFlat ? script.theme.softInk : script.theme.tool))},
       {"@knot_color@", spelled(hex(script.theme.knots))},
       {"@opacity@", fmt::format("{:.6g}", script.isFlat ? 1.0 : script.toolOpacity)},
       {"@light@", fmt::format("{:.6g}", script.isFlat ? 0.0 : kSpaceLight)},
       {"@subdivision@", std::to_string(script.isCurved ? kCurvedSubdivision : 1)},
       {"@mode@", spelled(script.isFlat ? "2D" : "3D")}});
}

}  // namespace burnish

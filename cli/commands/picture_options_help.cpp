#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdint>

#include "cli/arguments.h"
#include "cli/commands/picture_options.h"
#include "postproc/draw/contour/contour_view.h"
#include "postproc/draw/page/color_scale.h"

namespace burnish {
namespace {

void addWhat(CLI::App& command, PictureOptions& options) {
  command.add_option("RESULT", options.result, "Directory of a run or the result file in it")->required();
  command
      .add_option("--frame", options.frame,
                  fmt::format("Number of the frame, last or end, or time=T; for several A-B or all [{}]",
                              options.frame))
      ->type_name("N|A-B|all|last|time=T");
  command
      .add_option(
          "--field", options.field,
          "displacement, plastic_strain, von_mises, stress.xx, ..., pressure [plastic_strain or von_mises]")
      ->type_name("NAME");
  command
      .add_option("--component", options.component,
                  "Component of the field: x, xx, ...; of a vector also magnitude")
      ->type_name("NAME");
  command.add_option("--warp", options.warp, "Factor on the displacements of body and tools [1]")
      ->type_name("S");
  command
      .add_option("--subdivision", options.subdivision,
                  "Cells per knot span and direction: more for smoother lines [that of the scene]")
      ->check(CLI::Range(1, 64));
}

void addColors(CLI::App& command, PictureOptions& options) {
  command
      .add_option("--range", options.range,
                  "Values at the ends of the colour scale: those of the frame, of the whole run, or given; "
                  "auto: of all frames that are drawn [auto]")
      ->type_name("auto|frame|run|LO,HI");
  command
      .add_option("--clip", options.clip,
                  "End the colours at this percentile and at 100 minus it, by undeformed area (2D) or volume "
                  "(3D), so that a spike leaves colours for the rest; the picture says so [no]")
      ->type_name("P");
  command
      .add_option("--colormap", options.colormap,
                  fmt::format("{} [that of the theme]", fmt::join(colormapNames(), ", ")))
      ->type_name("NAME");
  command.add_option("--bands", options.bands, "Number of colour bands, or smooth [as the theme has it]")
      ->type_name("N|smooth");
  command.add_option("--isolines", options.isolines, "Number of lines of equal value [as the theme has it]")
      ->check(CLI::Range(0, 100));
}

void addThings(CLI::App& command, PictureOptions& options) {
  command.add_flag_function(
      "--knots,!--no-knots", [&options](std::int64_t count) { options.knots = count > 0; },
      "Draw the knot lines, or do not [as the theme has it]");
  command.add_flag("--control-net", options.controlNet, "Draw the control points and the lines between them");
  command
      .add_option("--undeformed", options.undeformed,
                  "Draw the outline of the undeformed body [as the theme has it]")
      ->type_name("on|off");
  command.add_option("--tools", options.tools, "Draw the tools [as the theme has it]")->type_name("on|off");
  command
      .add_option("--tool-opacity", options.toolOpacity,
                  "Of the tools in space, up to 1, which hides what is behind [0.3]")
      ->type_name("A");
  command
      .add_option("--vectors", options.vectors,
                  "Draw arrows: displacement, or traction, that of the contact [none]")
      ->type_name("FIELD");
}

void addView(CLI::App& command, PictureOptions& options) {
  command
      .add_option("--view", options.view,
                  fmt::format("{}, or the direction towards the eye [auto]", fmt::join(viewNames(), ", ")))
      ->type_name("NAME|X,Y,Z");
  command
      .add_option("--zoom", options.zoom,
                  "Corners of what is seen, in the plane of the view: coordinates of a plane body [all]")
      ->type_name("X0,Y0,X1,Y1");
  command
      .add_option("--cut", options.cut,
                  "Leave out what is on the eye's side of this plane: z=V, or a point and a normal; the "
                  "section shows the field inside [no]")
      ->type_name("z=V|X,Y,Z,NX,NY,NZ");
  command
      .add_option("--slice", options.slice,
                  "Draw only the section of body and tools with this plane, seen against its normal [no]")
      ->type_name("z=V|X,Y,Z,NX,NY,NZ");
  command
      .add_option("--mirror", options.mirror,
                  "Draw also the images of a symmetric part beyond these planes: x, or x,z=V where one is "
                  "not at 0 [no]")
      ->type_name("x[=V],...");
  command.add_option("--size", options.size, "Size of the picture in pixels [1600,900]")->type_name("W,H");
  command
      .add_option("--scale", options.scale,
                  "Factor on the size with all texts and lines: 2 for a screen of high density [1]")
      ->type_name("S");
  command.add_option("--text-size", options.textSize, "Height of the font in pixels [from the size]")
      ->check(CLI::Range(6.0, 200.0))
      ->type_name("PIXELS");
}

void addLook(CLI::App& command, PictureOptions& options) {
  command.add_option("--title", options.title, "Title of the picture, empty for none [that of the scene]")
      ->check(cannotBeShown)
      ->type_name("TEXT");
  addLookOptions(command, options.look);
  command.add_option("--background", options.background, "Colour of the paper [that of the theme]")
      ->type_name("#rrggbb|NAME");
  command.add_flag("--transparent", options.transparent,
                   "No paper: what is behind the picture shows through");
  command.add_flag("--no-doubts", options.noDoubts,
                   "Do not mark pictures of results that the run doubts [as the theme has it]");
}

}  // namespace

void addPictureOptions(CLI::App& command, PictureOptions& options) {
  addWhat(command, options);
  addColors(command, options);
  addThings(command, options);
  addView(command, options);
  addLook(command, options);
}

}  // namespace burnish

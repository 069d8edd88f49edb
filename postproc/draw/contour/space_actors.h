#pragma once
#include <vtkSmartPointer.h>

#include <array>

#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/view.h"

class vtkActor;
class vtkPolyData;
class vtkRenderer;

/// Actors of the part of a picture that shows space.
namespace burnish {

/// Point data of surfaces: which share of the light around comes to a point; all of it without.
inline constexpr const char* kSky = "sky";

/// A surface in one colour; `shaded` where its shape must be seen; opacity: 1 hides what is behind.
vtkSmartPointer<vtkActor> plainActor(vtkPolyData& surface, const Color& color, bool shaded, double opacity);

/// A surface whose colours are looked up pixel by pixel from its point scalars.
vtkSmartPointer<vtkActor> contourActor(vtkPolyData& surface, const ColorScale& scale, bool shaded);

/// A surface whose points have colours of their own, RGBA, without light.
vtkSmartPointer<vtkActor> shadowActor(vtkPolyData& surface);

/// Lines; opaque ones that are not thin have round ends and corners. width: in pixels of the window.
vtkSmartPointer<vtkActor> lineActor(vtkPolyData& lines, const Color& color, double width, double opacity);

/// Lines whose colours are looked up as those of `contourActor`.
vtkSmartPointer<vtkActor> contourLineActor(vtkPolyData& lines, const ColorScale& scale, double width);

struct Dashes {
  double length;  ///< of a dash with its gap, in pixels of the view
  double share;   ///< of it that is drawn
  double opacity;
  int number = 0;  ///< those of a higher one are before those of lower ones
};

/// Lines with `kWayAlong`, in front of everything, dashed.
vtkSmartPointer<vtkActor> dashedActor(vtkPolyData& lines, const Color& color, double width,
                                      const Dashes& dashes);

/// The points as round dots. diameter: in pixels of the window.
vtkSmartPointer<vtkActor> pointActor(vtkPolyData& points, const Color& color, double diameter);

/// Moves an actor towards the eye by a length, before other things at its place. In perspective every point moves
/// along its line of sight and at most to the front of what is seen, so that it stays where it is in the picture.
/// distance: that of `aim`.
void lift(vtkActor& actor, const View& view, double length, double distance);

/// Lets a renderer show a view in its part of a picture of this size (pixels), when all actors have been
/// added. distance: of the eye of a parallel view from what is nearest to it, of any size; in perspective, how far
/// behind the plane of the eye one sees.
void aim(vtkRenderer& renderer, const View& view, const std::array<int, 2>& pictureSize, double distance);

}  // namespace burnish

#pragma once
#include <string>
#include <vector>

#include "postproc/draw/chart/chart_curves.h"

class vtkTextProperty;

namespace burnish {

/// The letters of a text as closed polygons around the point where the text is anchored, in pixels. A letter
/// with holes is one polygon with a cut of no width from each hole to the outer outline.
std::vector<Polyline> glyphPolygons(const std::string& text, vtkTextProperty& property);

}  // namespace burnish

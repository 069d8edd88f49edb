#pragma once
#include <string>
#include <vector>

#include "postproc/draw/chart/chart_curves.h"

class vtkTextProperty;

namespace burnish {

/// The letters of a text as closed polygons around the point where the text is anchored, in pixels. A letter
/// with holes is one polygon with a cut of no width from each hole to the outer outline.
std::vector<Polyline> glyphPolygons(const std::string& text, vtkTextProperty& property);

/// The text (UTF-8) in ASCII: "×10⁻³" becomes "x10^-3", and a letter without a like a question mark.
std::string asciiText(const std::string& text);

}  // namespace burnish

#pragma once

class vtkRenderer;

namespace burnish {

struct PageSketch;

/// Paints the lines, areas, stripes and texts of a sketch as flat actors in a renderer that is `scale` times
/// larger.
void paint(const PageSketch& sketch, vtkRenderer& renderer, int scale);

}  // namespace burnish

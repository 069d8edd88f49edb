#pragma once

class vtkDataSet;

namespace burnish {

/// Whether a data set holds what VTK's filters take for granted: numbers of points that are there, offsets that
/// rise, cells of known types with as many points as these have. Filters end the program where it does not.
bool isSound(vtkDataSet& data);

}  // namespace burnish

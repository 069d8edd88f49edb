#pragma once
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace burnish {

struct ContourParts;

/// A part of a picture where its point scalars are finite, and the cells with a corner where one is not.
struct PartsByValue {
  vtkSmartPointer<vtkPolyData> with;
  vtkSmartPointer<vtkPolyData> without;  ///< null where all have values
};

PartsByValue partsByValue(vtkPolyData& part);

/// Whether what is drawn in colours has cells without values.
bool hasGaps(const ContourParts& parts);

}  // namespace burnish

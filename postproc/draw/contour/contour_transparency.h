#pragma once
#include <vtkSmartPointer.h>

class vtkImageData;

namespace burnish {

/// The picture without its paper, RGBA, from the same picture (RGB) on white and on black paper: what differs
/// between the two is the paper that shines through.
vtkSmartPointer<vtkImageData> withoutPaper(vtkImageData& onWhite, vtkImageData& onBlack);

}  // namespace burnish

#include "postproc/draw/contour/contour_transparency.h"

#include <vtkImageData.h>

#include <algorithm>
#include <cmath>

namespace burnish {

vtkSmartPointer<vtkImageData> withoutPaper(vtkImageData& onWhite, vtkImageData& onBlack) {
  const auto picture = vtkSmartPointer<vtkImageData>::New();
  picture->SetDimensions(onWhite.GetDimensions());
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  const auto* white = static_cast<const unsigned char*>(onWhite.GetScalarPointer());
  const auto* black = static_cast<const unsigned char*>(onBlack.GetScalarPointer());
  auto* pixel = static_cast<unsigned char*>(picture->GetScalarPointer());
  for (vtkIdType k = 0; k < picture->GetNumberOfPoints(); ++k, white += 3, black += 3, pixel += 4) {
    // White paper adds 255 (1 - alpha) to every channel, black paper nothing.
    int paper = 255;
    for (int c = 0; c < 3; ++c) paper = std::min(paper, white[c] - black[c]);
    const int alpha = 255 - std::max(0, paper);
    for (int c = 0; c < 3; ++c)
      pixel[c] = alpha == 0 ? 0
                            : static_cast<unsigned char>(
                                  std::min(255L, std::lround(255.0 * black[c] / static_cast<double>(alpha))));
    pixel[3] = static_cast<unsigned char>(alpha);
  }
  return picture;
}

}  // namespace burnish

#include "postproc/draw/contour/frame_pictures.h"

#include <algorithm>

#include "postproc/text/text_file.h"

namespace burnish {

std::vector<int> evenlyChosen(int count, int most) {
  std::vector<int> chosen;
  const int number = std::min(count, most);
  for (int k = 0; k < number; ++k)
    chosen.push_back(number == 1 ? 0 : static_cast<int>(static_cast<long>(k) * (count - 1) / (number - 1)));
  return chosen;
}

std::string framePicture(const ResultReader& result, const FrameRecord& frame, const ContourOptions& options,
                         const std::filesystem::path& scratchDirectory) {
  const auto file = scratchDirectory / "frame.png";
  drawContour(result.model(), frame, options, file);
  return readText(file);
}

}  // namespace burnish

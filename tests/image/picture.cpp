#include "tests/image/picture.h"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/core/error.h"

namespace burnish {

const Color& Picture::at(const Eigen::Vector2d& position) const {
  const int i = std::clamp(static_cast<int>(std::floor(position.x())), 0, width - 1);
  const int j = std::clamp(static_cast<int>(std::floor(position.y())), 0, height - 1);
  return pixels[static_cast<std::size_t>(j * width + i)];
}

Picture readPicture(const std::filesystem::path& png) {
  vtkNew<vtkPNGReader> reader;
  if (!std::filesystem::is_regular_file(png) || !reader->CanReadFile(png.c_str()))
    throw Error("no PNG file " + png.string());
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData& data = *reader->GetOutput();
  if (data.GetNumberOfScalarComponents() != 3 || data.GetScalarType() != VTK_UNSIGNED_CHAR)
    throw Error(png.string() + " is no picture of RGB bytes");
  Picture picture{data.GetDimensions()[0], data.GetDimensions()[1], {}};
  const auto* bytes = static_cast<const unsigned char*>(data.GetScalarPointer());
  for (vtkIdType k = 0; k < data.GetNumberOfPoints(); ++k)
    picture.pixels.push_back({bytes[3 * k], bytes[3 * k + 1], bytes[3 * k + 2]});
  return picture;
}

int difference(const Color& a, const Color& b) {
  int largest = 0;
  for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

double differentShare(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) return 1.0;
  constexpr int visible = 8;
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k)
    if (difference(a.pixels[k], b.pixels[k]) > visible) ++count;
  return static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

double drawnShare(const Picture& picture) {
  const auto same = std::count(picture.pixels.begin(), picture.pixels.end(), picture.pixels.front());
  return 1.0 - static_cast<double>(same) / static_cast<double>(picture.pixels.size());
}

void expectBaseline(const std::filesystem::path& drawn, const std::string& name) {
  const auto baseline = std::filesystem::path(BURNISH_SOURCE_DIR) / "images" / "baseline" / (name + ".png");
  if (std::getenv("BURNISH_WRITE_BASELINES") != nullptr) {
    std::filesystem::copy_file(drawn, baseline, std::filesystem::copy_options::overwrite_existing);
    ADD_FAILURE() << baseline << " was written anew; look at it, then run again without the variable";
    return;
  }
  ASSERT_TRUE(std::filesystem::exists(baseline)) << baseline << " is missing";
  const Picture picture = readPicture(drawn);
  EXPECT_GT(drawnShare(picture), 0.01) << drawn << " is blank";
  EXPECT_LT(differentShare(picture, readPicture(baseline)), kAllowedShare) << baseline;
}

}  // namespace burnish

#include "tests/postproc/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "postproc/compare/comparison.h"

namespace burnish {

int difference(const Color& a, const Color& b) {
  int largest = 0;
  for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

void expectBaseline(const std::filesystem::path& drawn, const std::string& name) {
  const auto baseline = std::filesystem::path(BURNISH_SOURCE_DIR) / "images" / "baseline" / (name + ".png");
  if (std::getenv("BURNISH_WRITE_BASELINES") != nullptr) {
    std::filesystem::copy_file(drawn, baseline, std::filesystem::copy_options::overwrite_existing);
    ADD_FAILURE() << baseline << " was written anew; look at it, then run again without the variable";
    return;
  }
  const Comparison comparison = compareFiles(name, drawn, baseline, {});
  EXPECT_EQ(comparison.verdict, PictureVerdict::Equal) << baseline << ": " << comparison.message;
}

}  // namespace burnish

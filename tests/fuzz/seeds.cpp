#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/results/frame_io.h"
#include "postproc/compare/picture.h"
#include "tests/fuzz/small_result.h"
#include "tests/fuzz/temporary_file.h"

namespace {

using namespace burnish;
namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

/// Writes the binary inputs from which fuzzing starts into a directory, one folder a target, and reads them
/// as the targets do: inputs that are refused at once would test nothing.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: fuzz_seeds DIRECTORY\n", stderr);
    return 2;
  }
  const fs::path directory = argv[1];
  const StoredModel model = fuzz::smallModel();
  FrameRecord frame = samples::frameOf(model.record, 0, 0.5);
  const auto frameBytes = frameImage(frame, model.id);
  frame.mesh = model.record.mesh;
  const auto meshedBytes = frameImage(frame, model.id);
  const auto modelBytes = modelImage(model);
  const auto pictureBytes = encodePng({4, 3, std::vector<Color>(12, Color{10, 200, 30})});
  write(directory / "result/model", std::string(1, '\0') + text(modelBytes));
  write(directory / "result/frame", std::string(1, '\1') + text(frameBytes));
  write(directory / "result/frame_with_mesh", std::string(1, '\1') + text(meshedBytes));
  write(directory / "picture/small.png", pictureBytes);
  fuzz::TemporaryFile result(".h5"), picture(".png");
  readModel(result.hold(modelBytes.data(), modelBytes.size()));
  for (const auto& bytes : {frameBytes, meshedBytes})
    readFrame(result.hold(bytes.data(), bytes.size()), model);
  readPicture(picture.hold(pictureBytes.data(), pictureBytes.size()));
  return 0;
}

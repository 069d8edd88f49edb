#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/results/result_writer.h"
#include "engine/results/summary_file.h"
#include "engine/scene/reader.h"
#include "engine/tools/surface_file.h"
#include "postproc/compare/picture.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/study/study_reader.h"
#include "postproc/text/text_file.h"
#include "tests/postproc/sample_records.h"

/// Files from elsewhere may be cut off or changed: reading one gives what is in it or an `Error` that names
/// it.
namespace burnish {
namespace {

namespace fs = std::filesystem;

class DamagedFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    dir_ = fs::temp_directory_path() /
           (std::string("burnish_damaged_") + test->name() + std::to_string(::getpid()));
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }

  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(dir_ / name, std::ios::binary) << bytes;
    return dir_ / name;
  }

  /// Reads the file whole, cut off at 200 lengths, and with one to three bytes changed 500 times.
  void expectRefusedOrRead(const fs::path& file, const std::function<void()>& read) const;

 private:
  static std::string changed(std::string bytes, std::mt19937& random);
  void expectErrorOrNothing(const fs::path& file, const std::string& bytes,
                            const std::function<void()>& read) const;

  fs::path dir_;
};

std::string DamagedFiles::changed(std::string bytes, std::mt19937& random) {
  const auto number = [&random](std::size_t below) { return random() % below; };
  for (std::size_t count = 1 + number(3); count > 0; --count)
    bytes[number(bytes.size())] = static_cast<char>(number(256));
  return bytes;
}

void DamagedFiles::expectErrorOrNothing(const fs::path& file, const std::string& bytes,
                                        const std::function<void()>& read) const {
  std::ofstream(file, std::ios::binary) << bytes;
  try {
    read();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(file.filename().string()), std::string::npos) << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << file.filename() << ": " << error.what() << ", is no sentence for people\n" << bytes;
  }
}

void DamagedFiles::expectRefusedOrRead(const fs::path& file, const std::function<void()>& read) const {
  constexpr std::size_t kCuts = 200, kChanges = 500;
  constexpr long kMostMemory = 1 << 20;  // kB
  const std::string whole = readText(file);
  ASSERT_NO_THROW(read()) << "before it is damaged";
  for (std::size_t k = 0; k < kCuts; ++k)
    expectErrorOrNothing(file, whole.substr(0, whole.size() * k / kCuts), read);
  std::mt19937 random(11);
  for (std::size_t k = 0; k < kChanges; ++k) expectErrorOrNothing(file, changed(whole, random), read);
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, kMostMemory);
}

/// A cube of triangles.
struct Cube {
  std::array<std::array<float, 3>, 8> points{};
  std::array<std::array<int, 3>, 12> cells{{{0, 2, 1},
                                            {1, 2, 3},
                                            {4, 5, 6},
                                            {5, 7, 6},
                                            {0, 1, 4},
                                            {1, 5, 4},
                                            {2, 6, 3},
                                            {3, 6, 7},
                                            {0, 4, 2},
                                            {2, 4, 6},
                                            {1, 3, 5},
                                            {3, 7, 5}}};
  Cube() {
    for (std::size_t k = 0; k < 8; ++k)
      points[k] = {static_cast<float>(k & 1), static_cast<float>(k >> 1 & 1), static_cast<float>(k >> 2)};
  }
};

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

std::string textStl(const Cube& cube) {
  std::ostringstream text;
  text << "solid cube\n";
  for (const auto& cell : cube.cells) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : cell) {
      const auto& p = cube.points[static_cast<std::size_t>(corner)];
      text << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    }
    text << "endloop\nendfacet\n";
  }
  text << "endsolid cube\n";
  return text.str();
}

std::string binaryStl(const Cube& cube) {
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(cube.cells.size()));
  for (const auto& cell : cube.cells) {
    append(bytes, std::array<float, 3>{});
    for (const int corner : cell) append(bytes, cube.points[static_cast<std::size_t>(corner)]);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// Points and cells as lines of text; `first` is the number of the first point.
std::string textBody(const Cube& cube, const char* point, const char* cell, int first) {
  std::ostringstream text;
  for (const auto& p : cube.points) text << point << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const auto& c : cube.cells)
    text << cell << c[0] + first << ' ' << c[1] + first << ' ' << c[2] + first << '\n';
  return text.str();
}

std::string plyHeader(const char* format) {
  return std::string("ply\nformat ") + format +
         " 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string binaryPly(const Cube& cube) {
  std::string bytes = plyHeader("binary_little_endian");
  for (const auto& point : cube.points) append(bytes, point);
  for (const auto& cell : cube.cells) {
    append(bytes, std::uint8_t{3});
    append(bytes, cell);
  }
  return bytes;
}

TEST_F(DamagedFiles, MeshesOfTools) {
  const Cube cube;
  for (const auto& [name, bytes] : {std::pair{"text.stl", textStl(cube)},
                                    {"binary.stl", binaryStl(cube)},
                                    {"cube.obj", textBody(cube, "v ", "f ", 1)},
                                    {"cube.off", "OFF\n8 12 0\n" + textBody(cube, "", "3 ", 0)},
                                    {"text.ply", plyHeader("ascii") + textBody(cube, "", "3 ", 0)},
                                    {"binary.ply", binaryPly(cube)}}) {
    const fs::path file = write(name, bytes);
    expectRefusedOrRead(file, [&file] { readSurface(file, 1.0, false); });
  }
}

TEST_F(DamagedFiles, LinesOfTools) {
  const fs::path file = write("line.txt", "0 0\n1 0\n1.5 0.25\n2 1e-3\n2 2\n0 2\n");
  expectRefusedOrRead(file, [&file] { readPolyline(file, true); });
}

TEST_F(DamagedFiles, Pictures) {
  Picture picture{.width = 24, .height = 16, .pixels = {}};
  for (int k = 0; k < 24 * 16; ++k)
    picture.pixels.push_back(
        {static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(k * k), static_cast<std::uint8_t>(7 * k)});
  const fs::path file = write("picture.png", encodePng(picture));
  expectRefusedOrRead(file, [&file] { readPicture(file); });
  write("picture.png", encodePng(picture));
  expectRefusedOrRead(file, [&file] { drawSheet({{file, ""}}, 1, 200, file.parent_path() / "made.png"); });
}

TEST_F(DamagedFiles, PicturesThatWouldFillTheMemory) {
  // A header of 50,000 x 50,000 pixels with its checksum, and nothing behind it.
  std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xc3\x50\0\0\xc3\x50\x08\x02\0\0\0", 29);
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 12, 17);
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(crc >> shift & 0xff);
  bytes += std::string("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12);
  const fs::path file = write("bomb.png", bytes);
  for (const auto& read : std::array<std::function<void()>, 2>{
           [&] { readPicture(file); },
           [&] {
             drawSheet({{file, ""}}, 1, 200, file.parent_path() / "made.png");
           }})
    try {
      read();
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("bomb.png: found 50000 x 50000 pixels"), std::string::npos)
          << error.what();
    }
}

constexpr const char* kScene =
    "geometry: {shape: control-net, file: net.yaml}\nmaterial: {law: neo-hookean, E: 1, nu: 0.3}\n"
    "supports: [{face: bottom, fix: [x, y]}]\nsteps: [{until: 1, count: 2}]\n";
constexpr const char* kNet =
    "degrees: [1, 2]\nknots: [[0, 0, 1, 1], [0, 0, 0, 1, 1, 1]]\n"
    "points: [[1, 0], [2, 0], [1, 1], [2, 2], [0, 1], [0, 2]]\nweights: [1, 1, 0.7, 0.7, 1, 1]\n";

TEST_F(DamagedFiles, ControlNets) {
  const fs::path scene = write("scene.yaml", kScene), file = write("net.yaml", kNet);
  const auto read = [&scene] { readScene(scene); };
  ASSERT_NO_THROW(read());
  expectRefusedOrRead(file, read);
}

TEST_F(DamagedFiles, ControlNetsOfOtherPrograms) {
  const std::vector<std::pair<std::string, std::string>> nets{
      {"net.g2",
       "200 1 0 0\n2 1\n2 2\n0 0 1 1\n3 3\n0 0 0 1 1 1\n1 0 1\n2 0 1\n0.7 0.7 0.7\n1.4 1.4 0.7\n0 1 1\n0 2 1\n"},
      {"net.json",
       "{\"shape\": {\"data\": [{\"degree_u\": 1, \"degree_v\": 1, \"knotvector_u\": [0, 0, 1, 1], \"knotvector_v\": [0, 0, 1, 1], "
       "\"control_points\": {\"points\": [[0, 0], [0, 1], [1, 0], [1, 1]]}}]}}"}};
  for (const auto& [name, text] : nets) {
    const fs::path scene =
        write("scene.yaml", "geometry: {shape: control-net, file: " + name +
                                "}\nmaterial: {law: neo-hookean, E: 1, nu: 0.3}\n"
                                "supports: [{face: bottom, fix: [x, y]}]\nsteps: [{until: 1, count: 2}]\n");
    const fs::path file = write(name.c_str(), text);
    const auto read = [&scene] { readScene(scene); };
    ASSERT_NO_THROW(read());
    expectRefusedOrRead(file, read);
  }
}

TEST_F(DamagedFiles, ScenesAndStudies) {
  write("net.yaml", kNet);
  const fs::path scene = write("scene.yaml", kScene);
  expectRefusedOrRead(scene, [&scene] { readScene(scene); });
  write("scene.yaml", kScene);
  const fs::path study = write("study.yaml",
                               "runs:\n  - {name: a, scene: scene.yaml, set: [\"degree=2\"]}\n"
                               "figures:\n  - {name: one, kind: history, runs: [a], x: time, y: energy}\n");
  expectRefusedOrRead(study, [&study] { readStudy(study); });
}

TEST_F(DamagedFiles, HistoriesAndSummaries) {
  const fs::path history = write("history.csv", "time,disc.fy\n0,0\n0.25,-1.5e-3\n0.5,-3.25\n1,-4\n");
  expectRefusedOrRead(history, [&history] { readHistory(history); });
  const fs::path directory = history.parent_path();
  RunAccount account;
  account.program = "burnish 0";
  account.completed = true;
  account.doubts = {{"smallest J below 0.05", 0.1, 3}};
  account.steps = 12;
  writeSummary(directory, account);
  expectRefusedOrRead(directory / "summary.yaml", [&directory] { readSummary(directory); });
}

TEST_F(DamagedFiles, Results) {
  const samples::Sample sample = samples::slab();
  const fs::path directory = write("history.csv", "").parent_path();
  ResultWriter(directory, sample.model).append(sample.frame);
  const auto read = [&directory] {
    const ResultReader reader(directory);
    for (int k = 0; k < reader.numFrames(); ++k) reader.frame(k);
  };
  expectRefusedOrRead(directory / "result.h5", read);
}

TEST_F(DamagedFiles, FramesOfResults) {
  const samples::Sample sample = samples::meshedAnew(samples::slab(), samples::slab({5, 3}));
  const fs::path directory = write("history.csv", "").parent_path();
  ResultWriter(directory, sample.model).append(sample.frame);
  expectRefusedOrRead(directory / "result/frame_000000.h5",
                      [&directory] { ResultReader(directory).frame(0); });
}

}  // namespace
}  // namespace burnish

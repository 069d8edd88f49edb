#include "postproc/foreign/announced_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/lower_case.h"
#include "engine/core/stl_counts.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

void require(bool holds, const fs::path& file, const char* what, std::int64_t announced, std::int64_t found) {
  if (!holds)
    throw Error(fmt::format("{}: the file is damaged: it announces {} {} and holds {}", file.string(),
                            announced, what, found));
}

void requireStl(const fs::path& file) {
  if (const std::string damage = stlDamage(file); !damage.empty())
    throw Error(fmt::format("{}: {}", file.string(), damage));
}

/// The numbers behind words that begin a line of a header, each the first one.
std::map<std::string, std::int64_t> numbersBehind(const fs::path& file, const std::vector<std::string>& words,
                                                  std::string_view end) {
  std::ifstream stream(file, std::ios::binary);
  std::map<std::string, std::int64_t> numbers;
  std::string line;
  while (std::getline(stream, line) && !(end.size() > 0 && line.starts_with(end)))
    for (const std::string& word : words) {
      if (!line.starts_with(word + " ") || numbers.contains(word)) continue;
      std::int64_t number = 0;
      const char* first = line.data() + word.size() + 1;
      if (std::from_chars(first, line.data() + line.size(), number).ec == std::errc()) numbers[word] = number;
    }
  return numbers;
}

void requireCounts(const fs::path& file, const std::vector<ForeignBlock>& blocks, std::int64_t points,
                   std::int64_t cells) {
  std::int64_t foundPoints = 0, foundCells = 0;
  for (const ForeignBlock& block : blocks) {
    foundPoints += block.grid->GetNumberOfPoints();
    foundCells += block.grid->GetNumberOfCells();
  }
  require(points < 0 || points == foundPoints, file, "points", points, foundPoints);
  require(cells < 0 || cells == foundCells, file, "cells", cells, foundCells);
}

std::int64_t numWords(std::string_view line) {
  std::int64_t words = 0;
  bool inWord = false;
  for (const char letter : line) {
    const bool isBlank = letter == ' ' || letter == '\t' || letter == '\r';
    if (!isBlank && !inWord) ++words;
    inWord = !isBlank;
  }
  return words;
}

void requirePly(const fs::path& file, const std::vector<ForeignBlock>& blocks) {
  const auto numbers = numbersBehind(file, {"element vertex", "element face"}, "end_header");
  const auto points = numbers.find("element vertex"), faces = numbers.find("element face");
  requireCounts(file, blocks, points == numbers.end() ? -1 : points->second,
                faces == numbers.end() ? -1 : faces->second);
}

/// What a file says of its cells; version 5 counts offsets, of which there is one more.
void requireLegacy(const fs::path& file, const std::vector<ForeignBlock>& blocks) {
  const std::vector<std::string> kinds{"CELLS", "VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"};
  std::vector<std::string> words = kinds;
  words.emplace_back("POINTS");
  const auto numbers = numbersBehind(file, words, "");
  std::ifstream stream(file);
  std::string version;
  std::getline(stream, version);
  const bool countsOffsets = version.find("Version 5") != std::string::npos;
  std::int64_t cells = -1;
  for (const std::string& kind : kinds)
    if (const auto found = numbers.find(kind); found != numbers.end())
      cells = std::max<std::int64_t>(0, cells) + found->second - (countsOffsets ? 1 : 0);
  const auto points = numbers.find("POINTS");
  requireCounts(file, blocks, points == numbers.end() ? -1 : points->second, cells);
}

}  // namespace

void requireAnnounced(const fs::path& file, const std::vector<ForeignBlock>& blocks) {
  const std::string ending = file.extension().string();
  if (ending == ".stl") requireStl(file);
  if (ending == ".ply") requirePly(file, blocks);
  if (ending == ".vtk") requireLegacy(file, blocks);
}

void requireAvs(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  while (std::getline(stream, line) && line.starts_with('#')) {
  }
  std::array<std::int64_t, 5> numbers{};  // of points, cells, and values of each point, cell and of all
  std::istringstream header(line);
  for (std::int64_t& number : numbers)
    if (!(header >> number) || number < 0)
      throw Error(
          fmt::format("{}: this is no AVS UCD file in letters: it does not begin with five numbers, of "
                      "points, cells and values",
                      file.string()));
  const auto requireLines = [&](std::int64_t count, std::int64_t words, const char* what) {
    for (std::int64_t k = 0; k < count; ++k)
      require(std::getline(stream, line) && numWords(line) >= words, file, what, count, k);
  };
  constexpr std::int64_t kNumberAndPlace = 4, kNumberMaterialKindAndPoint = 4;
  requireLines(numbers[0], kNumberAndPlace, "points");
  requireLines(numbers[1], kNumberMaterialKindAndPoint, "cells");
  const auto requireValues = [&](std::int64_t values, std::int64_t count, const char* what) {
    if (values == 0) return;
    std::int64_t components = 0;
    require(std::getline(stream, line) && std::istringstream(line) >> components, file, what, count, 0);
    requireLines(components, 0, "names of values");
    requireLines(count, 1 + values, what);
  };
  requireValues(numbers[2], numbers[0], "values of points");
  requireValues(numbers[3], numbers[1], "values of cells");
}

void requireTecplot(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  while (std::getline(stream, line)) {
    line.erase(0, std::min(line.find_first_not_of(" \t"), line.size()));
    if (inLowerCase(line.substr(0, 4)) == "zone") return;
  }
  throw Error(fmt::format("{}: this is no Tecplot file in letters: none of its lines begins with ZONE",
                          file.string()));
}

}  // namespace burnish

#include "engine/tools/polygon_soup.h"

#include <CGAL/IO/OFF/File_scanner_OFF.h>
#include <CGAL/IO/PLY/PLY_reader.h>
#include <CGAL/IO/STL/STL_reader.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "engine/core/error.h"

namespace burnish::inline tools {
namespace {

/// An STL file as what its size says that it is: the reader of all formats takes text with a mistake in it
/// for binary data, and then whatever stands there for the number of triangles.
bool readStl(std::ifstream& stream, std::uintmax_t size, std::vector<SoupPoint>& points,
             SoupPolygons& polygons) {
  constexpr std::uintmax_t kHeader = 84, kTriangle = 50;
  std::array<char, kHeader> header{};
  std::uint32_t triangles = 0;
  stream.read(header.data(), header.size());
  std::memcpy(&triangles, header.data() + kHeader - sizeof(triangles), sizeof(triangles));
  const bool isWhole = static_cast<bool>(stream);
  std::string_view begin(header.data(), header.size());
  begin.remove_prefix(std::min(begin.find_first_not_of(" \t\r\n"), begin.size()));
  const bool saysText = begin.starts_with("solid");
  // Behind the triangles there may be something else, unless the file claims to be text.
  const std::uintmax_t needed = kHeader + kTriangle * triangles;
  const bool isBinary = isWhole && (saysText ? size == needed : triangles > 0 && size >= needed);
  if (!isBinary && !saysText) return false;
  stream.clear();
  stream.seekg(0);
  return isBinary ? CGAL::IO::internal::parse_binary_STL(stream, points, polygons, false)
                  : CGAL::IO::internal::parse_ASCII_STL(stream, points, polygons, false);
}

/// An OFF file, point by point and face by face: the reader of all formats makes room for whatever it
/// promises.
bool readOff(std::ifstream& stream, std::vector<SoupPoint>& points, SoupPolygons& polygons) {
  CGAL::File_scanner_OFF scanner(stream);
  for (std::size_t i = 0; !stream.fail() && i < scanner.size_of_vertices(); ++i) {
    double x = 0.0, y = 0.0, z = 0.0;
    scanner.scan_vertex(x, y, z);
    scanner.skip_to_next_vertex(i);
    points.emplace_back(x, y, z);
  }
  for (std::size_t i = 0; !stream.fail() && i < scanner.size_of_facets(); ++i) {
    std::size_t corners = 0;
    scanner.scan_facet(corners, i);
    auto& polygon = polygons.emplace_back();
    for (std::size_t k = 1; !stream.fail() && k <= corners; ++k)
      scanner.scan_facet_vertex_index(polygon.emplace_back(), k, i);
    scanner.skip_to_next_facet(i);
  }
  return !stream.fail();
}

/// Throws unless CGAL's reader can be trusted with this header of a PLY file: it makes room for a list of any
/// length before it reads one, and takes it for granted that properties belong to an element.
void requirePlyHeader(std::ifstream& stream) {
  static const std::set<std::string> lengths{"uchar", "uint8", "ushort", "uint16"};
  std::string line, word;
  for (bool hasElement = false; word != "end_header" && std::getline(stream, line);) {
    std::istringstream words(line);
    std::string type, length;
    words >> word >> type >> length;
    hasElement = hasElement || word == "element";
    if (word != "property") continue;
    if (!hasElement) throw Error(fmt::format("found \"{}\" in its header before any element", line));
    if (type == "list" && !lengths.contains(length))
      throw Error(fmt::format("found \"{}\" in its header; allowed as the type of a list's length: {}", line,
                              fmt::join(lengths, ", ")));
  }
  stream.clear();
  stream.seekg(0);
}

using PlyElement = CGAL::IO::internal::PLY_element;

/// Reads the items of an element, in whose properties the function then finds the values of one.
template <class F>
bool readItems(std::ifstream& stream, PlyElement& element, const F& take) {
  for (std::size_t i = 0; i < element.number_of_items(); ++i) {
    for (std::size_t k = 0; k < element.number_of_properties(); ++k) {
      element.property(k)->get(stream);
      if (stream.fail()) return false;
    }
    take();
  }
  return true;
}

bool readPlyPoints(std::ifstream& stream, PlyElement& element, std::vector<SoupPoint>& points) {
  for (const char* name : {"x", "y", "z"})
    if (!element.has_property<double>(name))
      throw Error(fmt::format("found points without {}; allowed: x, y and z as float or double", name));
  return readItems(stream, element, [&] {
    double x = 0.0, y = 0.0, z = 0.0;
    element.assign(x, "x");
    element.assign(y, "y");
    element.assign(z, "z");
    points.emplace_back(x, y, z);
  });
}

/// Index: the type of the numbers of points in this file.
template <class Index>
bool readPlyFaces(std::ifstream& stream, PlyElement& element, const char* name, SoupPolygons& polygons) {
  std::vector<Index> corners;
  return readItems(stream, element, [&] {
    element.assign(corners, name);
    polygons.emplace_back(corners.begin(), corners.end());
  });
}

bool readPlyFaces(std::ifstream& stream, PlyElement& element, SoupPolygons& polygons) {
  using Signed = std::int32_t;
  using Unsigned = std::uint32_t;
  for (const char* name : {"vertex_indices", "vertex_index"}) {
    if (element.has_property<std::vector<Signed>>(name))
      return readPlyFaces<Signed>(stream, element, name, polygons);
    if (element.has_property<std::vector<Unsigned>>(name))
      return readPlyFaces<Unsigned>(stream, element, name, polygons);
  }
  throw Error("found faces without corners; allowed: vertex_indices as a list of int or uint");
}

/// A PLY file, element by element: the reader of all formats crashes when a property is of another type than
/// it expects.
bool readPly(std::ifstream& stream, std::uintmax_t size, std::vector<SoupPoint>& points,
             SoupPolygons& polygons) {
  requirePlyHeader(stream);
  CGAL::IO::internal::PLY_reader reader(false);
  if (!reader.init(stream)) return false;
  for (std::size_t i = 0; i < reader.number_of_elements(); ++i) {
    PlyElement& element = reader.element(i);
    const std::string& name = element.name();
    if (element.number_of_items() > size)
      throw Error(fmt::format("found {} times the element \"{}\" in its header, more than the file can hold",
                              element.number_of_items(), name));
    const bool isRead = name == "vertex" || name == "vertices" ? readPlyPoints(stream, element, points)
                        : name == "face" || name == "faces"    ? readPlyFaces(stream, element, polygons)
                                                               : readItems(stream, element, [] {});
    if (!isRead) return false;
  }
  return true;
}

}  // namespace

bool readPolygonSoup(const std::filesystem::path& file, std::vector<SoupPoint>& points,
                     SoupPolygons& polygons) {
  const std::uintmax_t size = std::filesystem::file_size(file);
  std::ifstream stream(file, std::ios::binary);
  std::string kind = file.extension().string();
  std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return std::tolower(c); });
  if (kind == ".stl") return readStl(stream, size, points, polygons);
  if (kind == ".off") return readOff(stream, points, polygons);
  if (kind == ".ply") return readPly(stream, size, points, polygons);
  return CGAL::IO::read_polygon_soup(file.string(), points, polygons, CGAL::parameters::verbose(false));
}

}  // namespace burnish::inline tools

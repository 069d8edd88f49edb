#include "engine/results/file_header.h"

#include <fmt/format.h>

#include "engine/core/error.h"

namespace burnish::inline results {
namespace {

int formatOf(const hdf5::InputGroup& root) {
  try {
    return root.integer("burnish_format");
  } catch (const Error&) {
    throw Error(
        fmt::format("{} is an HDF5 file, but no result of burnish (it has no burnish_format)", root.place()));
  }
}

}  // namespace

void writeHeader(const hdf5::OutputGroup& root, const std::string& kind, const std::string& modelId) {
  root.attribute("burnish_format", kResultFormat);
  root.attribute("kind", kind);
  root.attribute("model", modelId);
}

std::string readHeader(const hdf5::InputGroup& root, const std::string& kind) {
  const int format = formatOf(root);
  if (format != kResultFormat)
    throw Error(fmt::format(
        "{} has result format {}, but this program reads format {}; use the version that wrote it",
        root.place(), format, kResultFormat));
  const std::string found = root.text("kind");
  if (found != kind)
    throw Error(fmt::format("{} is the {} file of a result where its {} file is expected", root.place(),
                            found, kind));
  return root.text("model");
}

}  // namespace burnish::inline results

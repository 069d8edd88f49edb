#include "engine/cad/cad_file.h"

#include <fmt/format.h>

#include "engine/cad/require_cad.h"
#include "engine/core/error.h"
#include "engine/core/module_function.h"

namespace burnish {
namespace {

constexpr Module kModule{"burnish_occt.so", "OpenCASCADE", "BURNISH_OCCT"};

}  // namespace

void requireCad() {
  moduleFunction(kModule, "burnishReadCad", "CAD");
}

CadSurface readCad(const CadRequest& request) {
  static auto* const read =
      reinterpret_cast<ReadCadFunction*>(moduleFunction(kModule, "burnishReadCad", "a tool from a CAD file"));
  CadSurface surface;
  std::string problem;
  read(request, surface, problem);
  if (!problem.empty()) throw Error(fmt::format("{}: {}", request.file, problem));
  return surface;
}

void writeCad(const std::vector<CadFace>& faces, LengthUnit unit, CadFormat format, const std::string& file) {
  static auto* const write =
      reinterpret_cast<WriteCadFunction*>(moduleFunction(kModule, "burnishWriteCad", "writing a CAD file"));
  std::string problem;
  write(faces, unit, format, file, problem);
  if (!problem.empty()) throw Error(fmt::format("{}: {}", file, problem));
}

}  // namespace burnish

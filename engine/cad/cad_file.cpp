#include "engine/cad/cad_file.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/cad/require_cad.h"
#include "engine/core/error.h"
#include "engine/core/module_function.h"
#include "engine/core/reading_process.h"

namespace burnish {
namespace {

constexpr Module kModule{"burnish_occt.so", "OpenCASCADE", "BURNISH_OCCT", "burnish-cad"};

void sendPoints(const Eigen::Matrix3Xd& points, const TakeBytes& take) {
  send(std::int64_t{points.cols()}, take);
  take(points.data(), static_cast<std::size_t>(points.size()) * sizeof(double));
}

Eigen::Matrix3Xd receivePoints(const FillBytes& fill) {
  Eigen::Matrix3Xd points(3, receiveNumber(fill));
  fill(points.data(), static_cast<std::size_t>(points.size()) * sizeof(double));
  return points;
}

void sendFace(const CadFace& face, const TakeBytes& take) {
  for (std::size_t d = 0; d < 2; ++d) {
    send(std::int64_t{face.degrees[d]}, take);
    send(face.knots[d], take);
  }
  sendPoints(face.points, take);
  send(std::vector<double>(face.weights.begin(), face.weights.end()), take);
  send(std::int64_t{face.reversed}, take);
  send(face.name, take);
}

CadFace receiveFace(const FillBytes& fill) {
  CadFace face;
  for (std::size_t d = 0; d < 2; ++d) {
    face.degrees[d] = static_cast<int>(receiveNumber(fill));
    face.knots[d] = receiveNumbers(fill);
  }
  face.points = receivePoints(fill);
  const std::vector<double> weights = receiveNumbers(fill);
  face.weights = Eigen::Map<const Eigen::VectorXd>(weights.data(), std::ssize(weights));
  face.reversed = receiveNumber(fill) != 0;
  face.name = receiveText(fill);
  return face;
}

void sendSurface(const CadSurface& surface, const TakeBytes& take) {
  send(std::int64_t{surface.exact.has_value()}, take);
  if (surface.exact) return sendFace(*surface.exact, take);
  sendPoints(surface.points, take);
  sendPoints(surface.normals, take);
  send(std::int64_t{surface.cells.cols()}, take);
  take(surface.cells.data(), static_cast<std::size_t>(surface.cells.size()) * sizeof(int));
}

CadSurface receiveSurface(const FillBytes& fill) {
  CadSurface surface;
  if (receiveNumber(fill) != 0) {
    surface.exact = receiveFace(fill);
    return surface;
  }
  surface.points = receivePoints(fill);
  surface.normals = receivePoints(fill);
  surface.cells.resize(3, receiveNumber(fill));
  fill(surface.cells.data(), static_cast<std::size_t>(surface.cells.size()) * sizeof(int));
  return surface;
}

}  // namespace

void requireCad() {
  moduleFunction(kModule, "burnishReadCad", "CAD");
}

CadSurface readCad(const CadRequest& request) {
  static auto* const read =
      reinterpret_cast<ReadCadFunction*>(moduleFunction(kModule, "burnishReadCad", "a tool from a CAD file"));
  ReadingProcess process(request.file, [&request](std::int64_t) -> ReadingProcess::Send {
    CadSurface surface;
    std::string problem;
    read(request, surface, problem);
    if (!problem.empty()) throw Error(fmt::format("{}: {}", request.file, problem));
    return [surface = std::move(surface)](const TakeBytes& take) { sendSurface(surface, take); };
  });
  CadSurface surface;
  process.ask(0, [&surface](const FillBytes& fill) { surface = receiveSurface(fill); });
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

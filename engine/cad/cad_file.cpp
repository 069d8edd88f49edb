#include "engine/cad/cad_file.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/cad/require_cad.h"
#include "engine/core/error.h"
#include "engine/core/key_error.h"
#include "engine/core/lower_case.h"
#include "engine/core/module_function.h"
#include "engine/core/reading_process.h"

namespace burnish::inline cad {
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

void sendParts(const std::vector<CadPart>& parts, const TakeBytes& take) {
  send(std::ssize(parts), take);
  for (const CadPart& part : parts) {
    send(part.name, take);
    take(part.box.min().data(), 3 * sizeof(double));
    take(part.box.max().data(), 3 * sizeof(double));
    for (const int number : {int{part.isExact}, part.solid, part.faces}) send(std::int64_t{number}, take);
  }
}

std::vector<CadPart> receiveParts(const FillBytes& fill) {
  std::vector<CadPart> parts(static_cast<std::size_t>(receiveNumber(fill)));
  for (CadPart& part : parts) {
    part.name = receiveText(fill);
    fill(part.box.min().data(), 3 * sizeof(double));
    fill(part.box.max().data(), 3 * sizeof(double));
    part.isExact = receiveNumber(fill) != 0;
    part.solid = static_cast<int>(receiveNumber(fill));
    part.faces = static_cast<int>(receiveNumber(fill));
  }
  return parts;
}

void sendListing(const CadListing& listing, const TakeBytes& take) {
  send(listing.fileUnit, take);
  send(static_cast<std::int64_t>(listing.unit), take);
  sendParts(listing.solids, take);
  sendParts(listing.shells, take);
  sendParts(listing.faces, take);
}

CadListing receiveListing(const FillBytes& fill) {
  CadListing listing;
  listing.fileUnit = receiveText(fill);
  listing.unit = static_cast<LengthUnit>(receiveNumber(fill));
  listing.solids = receiveParts(fill);
  listing.shells = receiveParts(fill);
  listing.faces = receiveParts(fill);
  return listing;
}

/// What `work(result, problem)` makes of a file in a process of its own. Throws `KeyError` for its problem.
template <class Result, class Work>
Result readApart(const std::string& file, const Work& work,
                 void (*sendResult)(const Result&, const TakeBytes&),
                 Result (*receiveResult)(const FillBytes&)) {
  ReadingProcess process(file, [&](std::int64_t) -> ReadingProcess::Send {
    Result result;
    CadProblem problem;
    work(result, problem);
    return [sendResult, result = std::move(result), problem = std::move(problem)](const TakeBytes& take) {
      send(problem.key, take);
      send(problem.text, take);
      if (problem.text.empty()) sendResult(result, take);
    };
  });
  Result result;
  CadProblem problem;
  process.ask(0, [&](const FillBytes& fill) {
    problem.key = receiveText(fill);
    problem.text = receiveText(fill);
    if (problem.text.empty()) result = receiveResult(fill);
  });
  if (!problem.text.empty()) throw KeyError(problem.key, fmt::format("{}: {}", file, problem.text));
  return result;
}

}  // namespace

void requireCad() {
  moduleFunction(kModule, "burnishReadCad", "CAD");
}

bool isCadFile(const std::filesystem::path& file) {
  const std::string ending = inLowerCase(file.extension().string());
  return ending == ".step" || ending == ".stp" || ending == ".iges" || ending == ".igs";
}

CadSurface readCad(const CadRequest& request) {
  static auto* const read =
      reinterpret_cast<ReadCadFunction*>(moduleFunction(kModule, "burnishReadCad", "reading a CAD file"));
  return readApart<CadSurface>(
      request.file, [&](CadSurface& surface, CadProblem& problem) { read(request, surface, problem); },
      sendSurface, receiveSurface);
}

CadFace readCadFace(const std::string& file, const std::string& face, LengthUnit unit) {
  return *readCad({.file = file, .face = face, .unit = unit, .oneExactFace = true}).exact;
}

CadListing listCad(const std::string& file) {
  static auto* const list =
      reinterpret_cast<ListCadFunction*>(moduleFunction(kModule, "burnishListCad", "reading a CAD file"));
  return readApart<CadListing>(
      file, [&](CadListing& listing, CadProblem& problem) { list(file, listing, problem); }, sendListing,
      receiveListing);
}

void writeCad(const std::vector<CadBody>& bodies, LengthUnit unit, CadFormat format,
              const std::string& file) {
  static auto* const write =
      reinterpret_cast<WriteCadFunction*>(moduleFunction(kModule, "burnishWriteCad", "writing a CAD file"));
  CadProblem problem;
  write(bodies, unit, format, file, problem);
  if (!problem.text.empty()) throw Error(fmt::format("{}: {}", file, problem.text));
}

}  // namespace burnish::inline cad

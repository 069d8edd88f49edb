#include <BRepAdaptor_Curve2d.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRepGProp_Face.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_TShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/cad/cad_file.h"
#include "engine/cad/occt/units.h"
#include "engine/core/error.h"
#include "engine/core/key_error.h"
#include "engine/core/lower_case.h"
#include "engine/core/unit_label.h"

namespace burnish::inline cad {
namespace {

struct Model {
  std::unique_ptr<XSControl_Reader> reader;
  TopoDS_Shape shape;
  bool isStep = true;
};

/// A file as a shape in millimetres.
Model modelOf(const std::string& file) {
  const std::string kind = inLowerCase(std::filesystem::path(file).extension().string());
  const bool isStep = kind == ".step" || kind == ".stp";
  if (!isStep && kind != ".iges" && kind != ".igs")
    throw Error(fmt::format("found the ending {}; allowed: .step, .stp, .iges and .igs", kind));
  Message::DefaultMessenger()->ChangePrinters().Clear();
  takeMillimetres();
  Model model;
  model.isStep = isStep;
  if (isStep)
    model.reader = std::make_unique<STEPControl_Reader>();
  else
    model.reader = std::make_unique<IGESControl_Reader>();
  if (model.reader->ReadFile(file.c_str()) != IFSelect_RetDone)
    throw Error(fmt::format("this is no {} file that can be read", isStep ? "STEP" : "IGES"));
  model.reader->TransferRoots();
  if (model.reader->NbShapes() > 0) model.shape = model.reader->OneShape();
  if (model.shape.IsNull()) throw Error("found no shape in the file; allowed: faces, shells or solids");
  return model;
}

/// The names that a file gives to its faces, shells and solids.
std::map<const TopoDS_TShape*, std::string> namesOf(const Model& model) {
  std::map<const TopoDS_TShape*, std::string> names;
  const Handle(Transfer_TransientProcess) process = model.reader->WS()->TransferReader()->TransientProcess();
  for (int k = 1; k <= process->NbMapped(); ++k) {
    const Handle(Standard_Transient) entity = process->Mapped(k);
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
    if (shape.IsNull()) continue;
    Handle(TCollection_HAsciiString) name;
    if (const auto item = Handle(StepRepr_RepresentationItem)::DownCast(entity); !item.IsNull())
      name = item->Name();
    if (const auto item = Handle(IGESData_IGESEntity)::DownCast(entity); !item.IsNull() && item->HasName())
      name = item->NameValue();
    if (!name.IsNull() && !name->IsEmpty()) names.emplace(shape.TShape().get(), name->ToCString());
  }
  return names;
}

/// The part of a kind with this name, or else this number from 1. key: of a kind, which is what one is called, too.
TopoDS_Shape partOf(const Model& model, TopAbs_ShapeEnum kind, const char* key, const std::string& wanted) {
  constexpr std::size_t kNamed = 10;
  TopTools_IndexedMapOfShape parts;
  TopExp::MapShapes(model.shape, kind, parts);
  const auto nameOf = namesOf(model);
  std::vector<std::string> names;
  std::vector<int> found;
  for (int k = 1; k <= parts.Extent(); ++k) {
    const auto name = nameOf.find(parts(k).TShape().get());
    if (name == nameOf.end()) continue;
    if (name->second == wanted) found.push_back(k);
    if (names.size() < kNamed) names.push_back(name->second);
  }
  if (found.size() == 1) return parts(found.front());
  if (found.size() > 1)
    throw KeyError(
        key,
        fmt::format("found {} {}s that are called {}, with the numbers {}; allowed: one of these numbers",
                    found.size(), key, wanted, fmt::join(found, ", ")));
  int number = 0;
  const char* end = wanted.data() + wanted.size();
  const auto [stop, fault] = std::from_chars(wanted.data(), end, number);
  if (fault == std::errc() && stop == end && number >= 1 && number <= parts.Extent()) return parts(number);
  if (parts.Extent() == 0) throw KeyError(key, fmt::format("found no {} in the file", key));
  throw KeyError(
      key, fmt::format("found no {} {}; allowed: a number from 1 to {}{}", key, wanted, parts.Extent(),
                       names.empty() ? "" : fmt::format(", or a name such as {}", fmt::join(names, ", "))));
}

std::vector<TopoDS_Face> facesOf(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, TopAbs_FACE, map);
  std::vector<TopoDS_Face> faces;
  for (int k = 1; k <= map.Extent(); ++k) faces.push_back(TopoDS::Face(map(k)));
  return faces;
}

/// Whether all edges of a face run along the ends of its parameters.
bool isUntrimmed(const TopoDS_Face& face, const std::array<double, 4>& bounds) {
  constexpr int kSamples = 8;
  int wires = 0;
  for (TopExp_Explorer wire(face, TopAbs_WIRE); wire.More(); wire.Next()) ++wires;
  if (wires > 1) return false;
  const double closeU = 1e-6 * (bounds[1] - bounds[0]), closeV = 1e-6 * (bounds[3] - bounds[2]);
  for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next()) {
    const BRepAdaptor_Curve2d curve(TopoDS::Edge(edge.Current()), face);
    std::array<bool, 4> isOn{true, true, true, true};
    for (int k = 0; k <= kSamples; ++k) {
      const gp_Pnt2d p = curve.Value(
          std::lerp(curve.FirstParameter(), curve.LastParameter(), static_cast<double>(k) / kSamples));
      for (std::size_t side = 0; side < 4; ++side)
        isOn[side] =
            isOn[side] && std::abs((side < 2 ? p.X() : p.Y()) - bounds[side]) < (side < 2 ? closeU : closeV);
    }
    if (std::ranges::none_of(isOn, [](bool on) { return on; })) return false;
  }
  return true;
}

std::array<double, 4> boundsOf(const TopoDS_Face& face) {
  std::array<double, 4> bounds{};
  BRepTools::UVBounds(face, bounds[0], bounds[1], bounds[2], bounds[3]);
  return bounds;
}

/// The face as a NURBS surface, unless it is trimmed.
std::optional<CadFace> exactFace(const TopoDS_Face& face, double scale) {
  const std::array<double, 4> bounds = boundsOf(face);
  if (!isUntrimmed(face, bounds)) return std::nullopt;
  const Handle(Geom_Surface) whole = BRep_Tool::Surface(face);
  Handle(Geom_BSplineSurface) surface = GeomConvert::SurfaceToBSplineSurface(
      new Geom_RectangularTrimmedSurface(whole, bounds[0], bounds[1], bounds[2], bounds[3]));
  surface->SetUNotPeriodic();
  surface->SetVNotPeriodic();
  surface->Segment(bounds[0], bounds[1], bounds[2],
                   bounds[3]);  // the knots at the ends as often as they should stand
  CadFace exact;
  exact.degrees = {surface->UDegree(), surface->VDegree()};
  const int n = surface->NbUPoles(), m = surface->NbVPoles();
  for (int k = 1; k <= surface->NbUKnots(); ++k)
    exact.knots[0].insert(exact.knots[0].end(), static_cast<std::size_t>(surface->UMultiplicity(k)),
                          surface->UKnot(k));
  for (int k = 1; k <= surface->NbVKnots(); ++k)
    exact.knots[1].insert(exact.knots[1].end(), static_cast<std::size_t>(surface->VMultiplicity(k)),
                          surface->VKnot(k));
  exact.points.resize(3, n * m);
  exact.weights.resize(n * m);
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const gp_Pnt p = surface->Pole(i + 1, j + 1);
      exact.points.col(i + n * j) = scale * Eigen::Vector3d(p.X(), p.Y(), p.Z());
      exact.weights(i + n * j) = surface->Weight(i + 1, j + 1);
    }
  exact.reversed = face.Orientation() == TopAbs_REVERSED;
  return exact;
}

double extentOf(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  if (box.IsVoid()) throw Error("found nothing that has an extent; allowed: faces, shells or solids");
  std::array<double, 6> b{};
  box.Get(b[0], b[1], b[2], b[3], b[4], b[5]);
  return std::max({b[3] - b[0], b[4] - b[1], b[5] - b[2]});
}

/// Triangles that are nowhere farther than `tolerance`, in millimetres, from the faces.
void triangulate(const TopoDS_Shape& shape, double tolerance, double scale, CadSurface& surface) {
  constexpr double kAngle = 0.2;      // radians between the normals of neighbours
  constexpr double kNoNormal = 1e-9;  // at a pole, where the surface has none by its parameters
  BRepMesh_IncrementalMesh(shape, tolerance, false, kAngle, false);
  std::vector<Eigen::Vector3d> points, normals;
  std::vector<Eigen::Vector3i> cells;
  for (const TopoDS_Face& face : facesOf(shape)) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
    if (mesh.IsNull() || !mesh->HasUVNodes())
      throw Error("found a face that cannot be divided into triangles");
    const int first = static_cast<int>(points.size());
    const BRepGProp_Face oriented(face);
    for (int k = 1; k <= mesh->NbNodes(); ++k) {
      const gp_Pnt p = mesh->Node(k).Transformed(location.Transformation());
      points.emplace_back(scale * p.X(), scale * p.Y(), scale * p.Z());
      gp_Pnt place;
      gp_Vec normal;
      oriented.Normal(mesh->UVNode(k).X(), mesh->UVNode(k).Y(), place, normal);
      const Eigen::Vector3d n(normal.X(), normal.Y(), normal.Z());
      normals.push_back(n.norm() > kNoNormal ? n.normalized() : Eigen::Vector3d::Zero());
    }
    for (int k = 1; k <= mesh->NbTriangles(); ++k) {
      std::array<int, 3> corner{};
      mesh->Triangle(k).Get(corner[0], corner[1], corner[2]);
      if (face.Orientation() == TopAbs_REVERSED) std::swap(corner[1], corner[2]);
      const Eigen::Vector3i cell = Eigen::Vector3i(corner[0], corner[1], corner[2]).array() + (first - 1);
      const auto at = [&](int c) { return points[static_cast<std::size_t>(cell(c))]; };
      // Triangles at a pole have two corners there.
      if (at(0) != at(1) && at(1) != at(2) && at(2) != at(0)) cells.push_back(cell);
    }
  }
  surface.points.resize(3, std::ssize(points));
  surface.cells.resize(3, std::ssize(cells));
  surface.normals.resize(3, std::ssize(points));
  for (std::size_t k = 0; k < points.size(); ++k) {
    surface.points.col(static_cast<Eigen::Index>(k)) = points[k];
    surface.normals.col(static_cast<Eigen::Index>(k)) = normals[k];
  }
  for (std::size_t k = 0; k < cells.size(); ++k) surface.cells.col(static_cast<Eigen::Index>(k)) = cells[k];
}

/// Faces that are loose in the file, joined where their edges lie on one another.
TopoDS_Shape sewn(const TopoDS_Shape& shape, double extent) {
  BRepBuilderAPI_Sewing sewing(1e-5 * extent);
  sewing.Add(shape);
  sewing.Perform();
  return sewing.SewedShape();
}

/// A shell that is closed with its faces looking out of what it encloses; that of a void looks into it.
TopoDS_Shape outwards(TopoDS_Shape shell) {
  if (!BRep_Tool::IsClosed(shell)) return shell;
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shell, properties);
  if (properties.Mass() < 0.0) shell.Reverse();
  return shell;
}

void readSurface(const CadRequest& request, CadSurface& surface) {
  const Model model = modelOf(request.file);
  TopoDS_Shape shape = model.shape;
  if (!request.face.empty()) shape = partOf(model, TopAbs_FACE, "face", request.face);
  if (!request.shell.empty()) shape = outwards(partOf(model, TopAbs_SHELL, "shell", request.shell));
  if (!request.solid.empty()) shape = partOf(model, TopAbs_SOLID, "solid", request.solid);
  const auto faces = facesOf(shape);
  if (faces.empty()) throw Error("found no face in the file; allowed: faces, shells or solids");
  const double scale = 1.0 / millimetresOf(request.unit), extent = extentOf(shape);
  if (request.oneExactFace && faces.size() > 1)
    throw KeyError("face",
                   fmt::format("missing, in a file of {0} faces; required: the name of one, or its number "
                               "from 1 to {0}",
                               faces.size()));
  if (faces.size() == 1) surface.exact = exactFace(faces.front(), scale);
  if (surface.exact) return;
  if (request.oneExactFace)
    throw KeyError("face",
                   "found a face that is trimmed by curves on its surface; allowed: one whose edges are the "
                   "ends of its surface");
  if (!model.isStep && faces.size() > 1) shape = sewn(shape, extent);
  const double tolerance = request.tolerance ? *request.tolerance / scale : 1e-3 * extent;
  triangulate(shape, tolerance, scale, surface);
}

/// As a file names its unit of lengths; empty if it does not.
std::string unitOf(const Model& model) {
  if (auto* step = dynamic_cast<STEPControl_Reader*>(model.reader.get())) {
    TColStd_SequenceOfAsciiString lengths, angles, solidAngles;
    step->FileUnits(lengths, angles, solidAngles);
    return lengths.IsEmpty() ? "" : lengths.First().ToCString();
  }
  const auto iges = Handle(IGESData_IGESModel)::DownCast(model.reader->Model());
  const auto name = iges.IsNull() ? Handle(TCollection_HAsciiString)() : iges->GlobalSection().UnitName();
  return name.IsNull() ? "" : name->ToCString();
}

Eigen::AlignedBox3d boxOf(const TopoDS_Shape& shape, double scale) {
  constexpr double kNone = 1e-6;  // of the largest coordinate: OpenCASCADE's boxes are wider by its tolerance
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, false, false);
  if (box.IsVoid()) return {};
  std::array<double, 6> b{};
  box.Get(b[0], b[1], b[2], b[3], b[4], b[5]);
  const double largest = std::abs(*std::ranges::max_element(b, {}, [](double x) { return std::abs(x); }));
  const auto at = [&](std::size_t k) { return std::abs(b[k]) < kNone * largest ? 0.0 : scale * b[k]; };
  return {Eigen::Vector3d(at(0), at(1), at(2)), Eigen::Vector3d(at(3), at(4), at(5))};
}

void listParts(const std::string& file, CadListing& listing) {
  const Model model = modelOf(file);
  listing.fileUnit = unitOf(model);
  listing.unit = lengthUnitOf(inLowerCase(listing.fileUnit)).value_or(LengthUnit::Millimetre);
  const double scale = 1.0 / millimetresOf(listing.unit);
  const auto nameOf = namesOf(model);
  const auto partAt = [&](const TopoDS_Shape& shape) {
    const auto name = nameOf.find(shape.TShape().get());
    return CadPart{.name = name == nameOf.end() ? "" : name->second, .box = boxOf(shape, scale)};
  };
  TopTools_IndexedMapOfShape solids, shells, faces;
  TopExp::MapShapes(model.shape, TopAbs_SOLID, solids);
  TopExp::MapShapes(model.shape, TopAbs_SHELL, shells);
  TopExp::MapShapes(model.shape, TopAbs_FACE, faces);
  for (int k = 1; k <= faces.Extent(); ++k) {
    const TopoDS_Face face = TopoDS::Face(faces(k));
    listing.faces.push_back(partAt(face));
    listing.faces.back().isExact = isUntrimmed(face, boundsOf(face));
  }
  for (int k = 1; k <= shells.Extent(); ++k) {
    listing.shells.push_back(partAt(shells(k)));
    listing.shells.back().faces = static_cast<int>(facesOf(shells(k)).size());
  }
  for (int k = 1; k <= solids.Extent(); ++k) {
    listing.solids.push_back(partAt(solids(k)));
    for (TopExp_Explorer shell(solids(k), TopAbs_SHELL); shell.More(); shell.Next())
      listing.shells[static_cast<std::size_t>(shells.FindIndex(shell.Current())) - 1].solid = k;
    for (const TopoDS_Face& face : facesOf(solids(k))) {
      ++listing.solids.back().faces;
      listing.faces[static_cast<std::size_t>(faces.FindIndex(face)) - 1].solid = k;
    }
  }
}

/// Acts; what it throws becomes the problem.
template <class Act>
void noting(CadProblem& problem, const Act& act) {
  try {
    act();
  } catch (const Standard_Failure& failure) {
    problem = {"file", fmt::format("OpenCASCADE cannot read it ({})", failure.GetMessageString())};
  } catch (const KeyError& failure) {
    problem = {failure.key(), failure.what()};
  } catch (const std::exception& failure) {
    problem = {"file", failure.what()};
  }
}

}  // namespace
}  // namespace burnish::inline cad

extern "C" void burnishReadCad(const burnish::CadRequest& request, burnish::CadSurface& surface,
                               burnish::CadProblem& problem) {
  burnish::noting(problem, [&] { burnish::readSurface(request, surface); });
}

extern "C" void burnishListCad(const std::string& file, burnish::CadListing& listing,
                               burnish::CadProblem& problem) {
  burnish::noting(problem, [&] { burnish::listParts(file, listing); });
}

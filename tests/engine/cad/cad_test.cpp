// Tools from CAD files that OpenCASCADE has written, and surfaces that are written for it.
#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pwd.h>
#include <unistd.h>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "engine/cad/cad_file.h"
#include "engine/core/error.h"
#include "engine/nurbs/shapes.h"
#include "engine/scene/reader.h"
#include "engine/tools/cad_tool.h"
#include "engine/tools/sphere.h"

namespace burnish {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// Files in a directory of their own.
class Cad : public testing::Test {
 protected:
  Cad() : directory_(std::filesystem::path(testing::TempDir()) / ("cad_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(directory_);
  }
  ~Cad() override { std::filesystem::remove_all(directory_); }

  std::string path(const char* name) const { return (directory_ / name).string(); }

  std::string step(const char* name, const TopoDS_Shape& shape, const char* unit = "MM") const {
    STEPControl_Controller::Init();
    Interface_Static::SetCVal("write.step.unit", unit);
    STEPControl_Writer writer;
    EXPECT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
    EXPECT_EQ(writer.Write(path(name).c_str()), IFSelect_RetDone);
    return path(name);
  }

  std::string iges(const char* name, const TopoDS_Shape& shape) const {
    IGESControl_Controller::Init();
    IGESControl_Writer writer("MM", 0);
    writer.AddShape(shape);
    writer.ComputeModel();
    EXPECT_TRUE(writer.Write(path(name).c_str()));
    return path(name);
  }

  std::filesystem::path directory_;
};

TopoDS_Shape ball() {
  return BRepPrimAPI_MakeSphere(gp_Pnt(1.0, 2.0, 3.0), 2.5).Solid();
}

/// A punch: a cylinder about z whose lower edge is rounded.
TopoDS_Shape punch() {
  const TopoDS_Shape cylinder =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 3.0, 5.0).Solid();
  BRepFilletAPI_MakeFillet fillet(cylinder);
  for (TopExp_Explorer edge(cylinder, TopAbs_EDGE); edge.More(); edge.Next()) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(edge.Current()));
    if (curve.GetType() == GeomAbs_Circle && curve.Circle().Location().Z() < 1e-9)
      fillet.Add(1.0, TopoDS::Edge(edge.Current()));
  }
  return fillet.Shape();
}

/// The largest difference of gap and normal from those of a sphere, outside and inside.
double offFrom(const RigidShape& shape, const Vector3d& center, double radius) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  double largest = 0.0;
  for (int k = 0; k < 300; ++k) {
    const Vector3d direction = Vector3d::NullaryExpr([&] { return normal(generator); }).normalized();
    const double gap = (k % 7 - 2) * 0.1 * radius;
    const GapQuery query = shape.query(center + (radius + gap) * direction);
    largest = std::max({largest, std::abs(query.gap - gap), radius * (query.normal - direction).norm()});
  }
  return largest;
}

CadTool toolOf(
    const std::string& file, const std::function<void(CadTool&)>& set = [](CadTool&) {}) {
  CadTool tool;
  tool.file = file;
  set(tool);
  return tool;
}

std::string errorOf(const CadTool& tool) {
  try {
    tool.made();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(Cad, ABallOfOneFaceIsTheSphereExactly) {
  for (const std::string& file :
       {step("ball.step", ball()), step("ball.STP", ball()), iges("ball.igs", ball())})
    EXPECT_LT(offFrom(toolOf(file).made(), {1, 2, 3}, 2.5), 1e-9) << file;
}

TEST_F(Cad, LengthsAreConvertedFromTheUnitOfTheFileIntoThatOfTheScene) {
  // OpenCASCADE's lengths are millimetres; the file gives them in its own unit.
  for (const char* unit : {"MM", "M", "INCH"}) {
    const std::string file = step("ball.step", ball(), unit);
    EXPECT_LT(offFrom(toolOf(file).made(), {1, 2, 3}, 2.5), 1e-9) << unit;
    EXPECT_LT(offFrom(toolOf(file, [](CadTool& tool) { tool.unit = LengthUnit::Metre; }).made(),
                      {1e-3, 2e-3, 3e-3}, 2.5e-3),
              1e-12)
        << unit;
    EXPECT_LT(offFrom(toolOf(file,
                             [](CadTool& tool) {
                               tool.unit = LengthUnit::Inch;
                               tool.scale = 25.4;
                             })
                          .made(),
                      {1, 2, 3}, 2.5),
              1e-9)
        << unit;
  }
}

TEST_F(Cad, ASolidOfSeveralFacesIsMeshedToItsTolerance) {
  const std::string file = step("punch.step", punch());
  const RigidShape shape = toolOf(file, [](CadTool& tool) {
                             tool.tolerance = 0.002;
                             tool.smoothing = 0.05;
                           }).made();
  EXPECT_NEAR(shape.query({0.5, 0.3, -1.0}).gap, 1.0, 0.004) << "below the flat";
  EXPECT_NEAR(shape.query({4.0, 0.0, 3.0}).gap, 1.0, 0.004) << "beside the cylinder";
  const Vector3d corner = Vector3d(2.0, 0.0, 1.0) + 1.5 * Vector3d(1.0, 0.0, -1.0).normalized();
  EXPECT_NEAR(shape.query(corner).gap, 0.5, 0.004) << "at the rounded edge, of radius 1";
  EXPECT_LT(shape.query({0.0, 0.0, 0.5}).gap, 0.0);
  EXPECT_NEAR(shape.halfThickness(), 2.5, 0.01);
}

TEST_F(Cad, AFaceIsChosenByNumberAndASolidByNumber) {
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(-9, 0, 0), 1.0, 1.0, 1.0).Solid());
  builder.Add(both, ball());
  const std::string file = step("two.step", both);
  EXPECT_LT(offFrom(toolOf(file, [](CadTool& tool) { tool.solid = "2"; }).made(), {1, 2, 3}, 2.5), 1e-9);
  EXPECT_LT(offFrom(toolOf(file, [](CadTool& tool) { tool.face = "7"; }).made(), {1, 2, 3}, 2.5), 1e-9);
  EXPECT_NEAR((toolOf(file, [](CadTool& tool) { tool.face = "1"; }).made().query({-10.0, 0.5, 0.5}).gap), 1.0,
              1e-12)
      << "the side of the box at x = -9, exact, with the box behind it";
  EXPECT_THAT(errorOf(toolOf(file, [](CadTool& tool) { tool.face = "8"; })),
              HasSubstr("two.step: found no face 8; allowed: a number from 1 to 7"));
  EXPECT_THAT(errorOf(toolOf(file, [](CadTool& tool) { tool.solid = "punch"; })),
              HasSubstr("two.step: found no solid punch; allowed: a number from 1 to 2"));
}

TEST_F(Cad, AShellIsChosenByNumber) {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  builder.Add(all, BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 3.0, 3.0, 3.0).Shape(),
                                   BRepPrimAPI_MakeBox(gp_Pnt(1, 1, 1), 1.0, 1.0, 1.0).Shape())
                       .Shape());
  TopoDS_Shell corner;
  builder.MakeShell(corner);
  int taken = 0;
  for (TopExp_Explorer face(BRepPrimAPI_MakeBox(gp_Pnt(9, 0, 0), 1.0, 1.0, 1.0).Solid(), TopAbs_FACE);
       face.More() && taken < 3; face.Next(), taken += 1)
    if (taken != 1) builder.Add(corner, face.Current());
  builder.Add(all, corner);
  const std::string file = step("shells.step", all);

  const CadListing listing = listCad(file);
  ASSERT_EQ(listing.shells.size(), 3U);
  EXPECT_EQ(listing.shells[0].solid, 1);
  EXPECT_EQ(listing.shells[0].faces, 6);
  EXPECT_EQ(listing.shells[1].solid, 1);
  EXPECT_LT((listing.shells[1].box.max() - Vector3d(2, 2, 2)).norm(), 1e-6) << "around the void";
  EXPECT_EQ(listing.shells[2].solid, 0);
  EXPECT_EQ(listing.shells[2].faces, 2);

  const auto outer = toolOf(file, [](CadTool& tool) {
                       tool.shell = "1";
                       tool.smoothing = 0.05;
                     }).made();
  EXPECT_NEAR(outer.query({1.5, 1.5, 3.5}).gap, 0.5, 1e-6);
  EXPECT_NEAR(outer.query({1.5, 1.5, 2.5}).gap, -0.5, 1e-6) << "filled: the void is another shell";
  EXPECT_LT(outer.query({1.5, 1.5, 1.5}).gap, -1.0);
  const auto inside = toolOf(file, [](CadTool& tool) {
                        tool.shell = "2";
                        tool.smoothing = 0.05;
                      }).made();
  EXPECT_NEAR(inside.query({1.5, 1.5, 2.5}).gap, 0.5, 1e-6) << "the tool is the cube in the void";
  EXPECT_LT(inside.query({1.5, 1.5, 1.7}).gap, 0.0);
  const std::string round = step(
      "round.step",
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(gp_Pnt(-4, -4, -4), 20.0, 20.0, 20.0).Shape(), ball()).Shape());
  const CadListing hollow = listCad(round);
  ASSERT_EQ(hollow.shells.size(), 2U);
  const std::string ofBall = hollow.shells[0].faces == 1 ? "1" : "2";
  EXPECT_LT(offFrom(toolOf(round, [&](CadTool& tool) { tool.shell = ofBall; }).made(), {1, 2, 3}, 2.5), 1e-9)
      << "one face, exact";
  const auto ends = toolOf(file, [](CadTool& tool) {
                      tool.shell = "3";
                      tool.open = true;
                      tool.smoothing = 0.05;
                    }).made();
  EXPECT_NEAR(ends.query({8.5, 0.5, 0.5}).gap, 0.5, 1e-6);
  EXPECT_THAT(errorOf(toolOf(file, [](CadTool& tool) { tool.shell = "4"; })),
              HasSubstr("shells.step: found no shell 4; allowed: a number from 1 to 3"));
}

TEST_F(Cad, ATrimmedFaceIsMeshedAndMustBeAllowedARim) {
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 4.0, 4.0, 1.0).Solid();
  const TopoDS_Shape hole =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(2, 2, -1), gp_Dir(0, 0, 1)), 1.0, 3.0).Solid();
  const std::string file = step("plate.step", BRepAlgoAPI_Cut(plate, hole).Shape());
  EXPECT_NEAR((toolOf(file,
                      [](CadTool& tool) {
                        tool.tolerance = 1e-3;
                        tool.smoothing = 0.05;
                      })
                   .made()
                   .query({2.5, 2.0, 0.5})
                   .gap),
              0.5, 0.002)
      << "in the hole";
  int trimmed = 0;
  for (const char* face : {"1", "2", "3", "4", "5", "6", "7"})
    trimmed += errorOf(toolOf(file, [&face](CadTool& tool) { tool.face = face; })).find("on a rim") !=
               std::string::npos;
  EXPECT_EQ(trimmed, 2) << "above and below; the others are whole";
}

TEST_F(Cad, FilesThatAreNoneAreNamed) {
  std::ofstream(path("text.step")) << "ISO-10303-21;\nnothing\n";
  std::ofstream(path("text.igs")) << "nothing\n";
  std::ofstream(path("empty.step"));
  EXPECT_THAT(errorOf(toolOf(path("text.step"))),
              HasSubstr("text.step: this is no STEP file that can be read"));
  EXPECT_THAT(errorOf(toolOf(path("empty.step"))),
              HasSubstr("empty.step: this is no STEP file that can be read"));
  EXPECT_THAT(errorOf(toolOf(path("text.igs"))), HasSubstr("text.igs: "));
  EXPECT_THAT(errorOf(toolOf(path("none.step"))), HasSubstr("none.step: there is no such file"));
  std::ofstream(path("ball.stl")) << "solid\n";
  EXPECT_THAT(errorOf(toolOf(path("ball.stl"))),
              HasSubstr("ball.stl: found the ending .stl; allowed: .step, .stp, .iges and .igs"));
}

/// Quarter of a cylinder, with a name.
CadFace quarter() {
  const Patch<2> ring = annulus({0.0, 0.0}, 1.0 / 3.0, 2.0, 0.1, 1.5);
  CadFace face{.degrees = {1, 2},
               .knots = {ring.basis().direction(0).knots(), ring.basis().direction(1).knots()},
               .name = "quarter"};
  face.points = Eigen::Matrix3Xd::Constant(3, 6, std::numbers::pi);
  face.points.topRows<2>() = ring.points();
  face.weights = ring.weights();
  return face;
}

TEST_F(Cad, SurfacesAreReadBackAsTheyWereWritten) {
  const CadFace written = quarter();
  for (const CadFormat format : {CadFormat::Step, CadFormat::Iges})
    for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Metre}) {
      const std::string file = path(format == CadFormat::Step ? "face.step" : "face.igs");
      writeCad({{"body", {written}}}, unit, format, file);
      const CadSurface read = readCad({.file = file, .unit = unit});
      ASSERT_TRUE(read.exact) << file;
      EXPECT_EQ(read.exact->degrees, written.degrees);
      EXPECT_EQ(read.exact->knots, written.knots);
      EXPECT_LT((read.exact->points - written.points).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_LT((read.exact->weights - written.weights).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_FALSE(read.exact->reversed);
    }
}

TEST_F(Cad, FilesSayWhoWroteThemAndNotWhoWasLoggedIn) {
  for (const auto& [format, name] :
       {std::pair{CadFormat::Step, "face.step"}, std::pair{CadFormat::Iges, "face.igs"}}) {
    writeCad({{"body", {quarter()}}}, LengthUnit::Millimetre, format, path(name));
    std::ifstream file(path(name));
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string header = text.substr(0, text.find(format == CadFormat::Step ? "ENDSEC" : "D0000001"));
    EXPECT_NE(header.find("burnish"), std::string::npos) << header;
    EXPECT_NE(header.find("NURBS surfaces"), std::string::npos) << header;
    for (const char* foreign :
         {"Author", "Open CASCADE Shape Model", "Open CASCADE Model", "Filename", "Unknown"})
      EXPECT_EQ(header.find(foreign), std::string::npos) << header;
    const passwd* user = ::getpwuid(::geteuid());
    const std::string login = user != nullptr ? user->pw_name : "";
    if (!login.empty() && login != "burnish") {
      EXPECT_EQ(header.find("H" + login + ","), std::string::npos) << header;
    }
  }
}

TEST_F(Cad, FacesHaveTheirNamesInFilesThatAreWritten) {
  CadFace other = quarter();
  other.name = "body.top";
  other.points.row(2).array() += 1.0;
  for (const auto& [format, name] :
       {std::pair{CadFormat::Step, "faces.step"}, std::pair{CadFormat::Iges, "faces.iges"}}) {
    writeCad({{"body", {quarter(), other}}}, LengthUnit::Millimetre, format, path(name));
    const CadSurface read = readCad({.file = path(name), .face = "body.top"});
    ASSERT_TRUE(read.exact) << name;
    EXPECT_NEAR(read.exact->points(2, 0), std::numbers::pi + 1.0, 1e-12) << name;
  }
}

/// The faces of a cube, with the cube behind them; turned: with the cube around it.
CadBody cube(const std::string& name, double size, const Vector3d& corner, bool turned = false) {
  CadBody body{.name = name};
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      CadFace face{.degrees = {1, 1}, .knots = {{{0, 0, 1, 1}, {0, 0, 1, 1}}}};
      face.name = name + "." + std::to_string(2 * axis + end);
      face.points = corner.replicate(1, 4);
      face.points.row(axis).array() += end * size;
      face.points.row(axis == 0 ? 1 : 0) += size * Eigen::RowVector4d(0, 1, 0, 1);
      face.points.row(axis == 2 ? 1 : 2) += size * Eigen::RowVector4d(0, 0, 1, 1);
      face.weights = Eigen::Vector4d::Ones();
      face.reversed = ((axis == 1) == (end == 1)) != turned;
      body.faces.push_back(face);
    }
  return body;
}

std::string textOf(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST_F(Cad, BodiesWhoseFacesCloseAreSolidsWithTheirNames) {
  CadBody hollow = cube("hollow", 3.0, {10, 0, 0});
  for (const CadFace& face : cube("hollow.in", 1.0, {11, 1, 1}, true).faces) hollow.faces.push_back(face);
  writeCad({cube("punch", 2.0, {0, 0, 0}), hollow, {"plate", {quarter()}}}, LengthUnit::Millimetre,
           CadFormat::Step, path("bodies.step"));

  const CadListing listing = listCad(path("bodies.step"));
  ASSERT_EQ(listing.solids.size(), 2U);
  EXPECT_EQ(listing.solids[0].name, "punch");
  EXPECT_EQ(listing.solids[0].faces, 6);
  EXPECT_LT((listing.solids[0].box.max() - Vector3d(2, 2, 2)).norm(), 1e-6);
  EXPECT_EQ(listing.solids[1].name, "hollow");
  EXPECT_EQ(listing.solids[1].faces, 12);
  ASSERT_EQ(listing.faces.size(), 19U);
  EXPECT_EQ(listing.faces[0].solid, 1);
  EXPECT_EQ(listing.faces[18].solid, 0);
  EXPECT_EQ(listing.faces[18].name, "quarter");
  EXPECT_TRUE(listing.faces[18].isExact);
  EXPECT_EQ(listing.fileUnit, "millimetre");

  for (const char* solid : {"1", "punch"}) {
    const RigidShape shape = toolOf(path("bodies.step"), [&](CadTool& tool) {
                               tool.solid = solid;
                               tool.smoothing = 0.05;
                             }).made();
    EXPECT_NEAR(shape.query({1.0, 1.0, 2.5}).gap, 0.5, 1e-6);
    EXPECT_LT(shape.query({1.0, 1.0, 1.8}).gap, 0.0);
  }
  EXPECT_LT(toolOf(path("bodies.step"),
                   [](CadTool& tool) {
                     tool.solid = "hollow";
                     tool.smoothing = 0.05;
                   })
                .made()
                .query({11.5, 1.5, 0.5})
                .gap,
            0.0)
      << "between the cubes";

  const std::string text = textOf(path("bodies.step"));
  for (const char* name : {"punch", "hollow", "plate"})
    EXPECT_NE(text.find(fmt::format("PRODUCT('{0}','{0}'", name)), std::string::npos) << name;
  EXPECT_EQ(text.find("Open CASCADE STEP translator"), std::string::npos);
}

TEST_F(Cad, FilesOfTheSameBodiesAreTheSameBytesAtAGivenTime) {
  ::setenv("SOURCE_DATE_EPOCH", "86400", 1);
  for (const auto& [format, ending, time] : {std::tuple{CadFormat::Step, ".step", "1970-01-02T00:00:00"},
                                             std::tuple{CadFormat::Iges, ".iges", "19700102.000000"}}) {
    for (const char* name : {"first", "second"})
      writeCad({cube("punch", 2.0, {0, 0, 0})}, LengthUnit::Millimetre, format,
               path((std::string(name) + ending).c_str()));
    const std::string first = textOf(path((std::string("first") + ending).c_str()));
    EXPECT_EQ(first, textOf(path((std::string("second") + ending).c_str())));
    EXPECT_NE(first.find(time), std::string::npos) << ending;
  }
  ::setenv("SOURCE_DATE_EPOCH", "yesterday", 1);
  EXPECT_THROW(
      writeCad({cube("punch", 2.0, {0, 0, 0})}, LengthUnit::Millimetre, CadFormat::Step, path("a.step")),
      Error);
  ::unsetenv("SOURCE_DATE_EPOCH");
}

TEST_F(Cad, ANameThatSeveralPartsHaveIsRefusedWithTheirNumbers) {
  CadBody body = cube("punch", 2.0, {0, 0, 0});
  body.faces[1].name = body.faces[3].name = "side";
  writeCad({body}, LengthUnit::Millimetre, CadFormat::Iges, path("sides.iges"));
  EXPECT_THAT(
      errorOf(toolOf(path("sides.iges"), [](CadTool& tool) { tool.face = "side"; })),
      HasSubstr("sides.iges: found 2 faces that are called side, with the numbers 2, 4; allowed: one of "
                "these numbers"));
}

/// A scene of one body that a file makes.
Scene sceneOf(const std::string& geometry, const std::string& rest, const std::string& name) {
  return parseScene("geometry: {" + geometry + "}\nmaterial: {law: neo-hookean, E: 1, nu: 0.3}\n" +
                        "steps: [{until: 1, count: 1}]\n" + rest,
                    name);
}

std::string errorOfScene(const std::string& geometry, const std::string& rest, const std::string& name) {
  try {
    sceneOf(geometry, rest, name);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

const std::string kBox = "shape: box, size: [1, 1, 1], spans: [1, 1, 1]";

TEST_F(Cad, AToolTakesTheUnitThatTheSceneNamesInAnySpelling) {
  const auto unitWith = [&](const std::string& label) {
    const Scene scene = sceneOf(
        kBox, "units: {length: '" + label + "'}\ntools: [{name: ball, shape: cad, file: ball.step}]\n",
        path("scene.yaml"));
    return std::get<CadTool>(scene.tools.at(0).shape).unit;
  };
  for (const char* label : {"um", "\u00b5m", "\u03bcm", "micron"})
    EXPECT_EQ(unitWith(label), LengthUnit::Micrometre) << label;
  EXPECT_EQ(unitWith("inch"), LengthUnit::Inch);
  EXPECT_EQ(unitWith("metre"), LengthUnit::Metre);
  EXPECT_EQ(unitWith("nm"), LengthUnit::Nanometre);
  EXPECT_EQ(unitWith("MM"), LengthUnit::Millimetre);
  EXPECT_EQ(unitWith(""), LengthUnit::Millimetre);
}

TEST_F(Cad, ALabelThatNamesNoUnitIsRefusedUnlessTheToolSaysOne) {
  const std::string units = "units: {length: fathom}\n";
  EXPECT_THAT(
      errorOfScene(kBox, units + "tools: [{name: ball, shape: cad, file: ball.step}]\n", path("scene.yaml")),
      HasSubstr(
          "scene.yaml:4:17: units.length: found \"fathom\", into which the lengths of the CAD file of tools[0] "
          "cannot be converted; allowed: nm, um"));
  EXPECT_EQ(errorOfScene(kBox, units + "tools: [{name: ball, shape: cad, file: ball.step, unit: mm}]\n",
                         path("scene.yaml")),
            "no error");
  EXPECT_EQ(errorOfScene(kBox, units, path("scene.yaml")), "no error");
}

/// Determinant of the map of an extrusion in its middle.
double determinantOf(const Scene& scene) {
  const Patch<3> patch = std::get<ExtrusionBody>(scene.body.geometry.shape).patch<3>();
  const auto middle = [&](int d) { return patch.basis().direction(d).parameterAt(0.5); };
  return patch.jacobian(Vector3d(middle(0), middle(1), middle(2))).determinant();
}

TEST_F(Cad, AFaceIsExtrudedOutOfItsSolid) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(gp_Pnt(1, 2, 3), 2.0, 3.0, 4.0).Solid();
  step("box.step", box);
  const std::string name = path("scene.yaml");
  int extruded = 0;
  for (int face = 1; face <= 6; ++face)
    for (const Vector3d& vector : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0),
                                   Vector3d(0, -1, 0), Vector3d(0, 0, 1), Vector3d(0, 0, -1)}) {
      const auto geometry = [&](const char* flip) {
        return fmt::format("shape: extrusion, profile: {{file: box.step, face: {}{}}}, vector: [{}]", face,
                           flip, fmt::join(vector, ", "));
      };
      const double determinant = determinantOf(sceneOf(geometry(""), "", name));
      if (std::abs(determinant) < 1e-9) continue;  // along the face
      EXPECT_NEAR(determinantOf(sceneOf(geometry(", flip: true"), "", name)), -determinant, 1e-12);
      if (determinant < 0.0) continue;
      ++extruded;
      const Scene scene = sceneOf(geometry(""), "", name);
      const auto& points = std::get<ExtrusionBody>(scene.body.geometry.shape).profile.points;
      ASSERT_EQ(points.size(), 4U);
      for (const auto& point : points)
        EXPECT_GT((Vector3d(point[0], point[1], point[2]) - Vector3d(2, 3.5, 5)).dot(vector), 0.0)
            << "outwards from the middle of the box";
    }
  EXPECT_EQ(extruded, 6);
}

TEST_F(Cad, AProfileIsTheNurbsOfTheFaceInTheUnitOfTheScene) {
  for (const auto& [format, name] :
       {std::pair{CadFormat::Step, "quarter.STEP"}, std::pair{CadFormat::Iges, "quarter.Igs"}}) {
    writeCad({{"body", {quarter()}}}, LengthUnit::Millimetre, format, path(name));
    const std::string profile = std::string("shape: extrusion, vector: [0, 0, 1], profile: {file: ") + name;
    const Scene scene = sceneOf(profile + "}", "units: {length: um}\n", path("scene.yaml"));
    const Net& net = std::get<ExtrusionBody>(scene.body.geometry.shape).profile;
    EXPECT_EQ(net.degrees, (std::vector<int>{1, 2}));
    EXPECT_EQ(net.knots[1], quarter().knots[1]);
    ASSERT_EQ(net.points.size(), 6U);
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(net.points[a][c], 1000.0 * quarter().points(static_cast<int>(c), static_cast<int>(a)),
                    1e-9);
    EXPECT_NEAR(net.weights[2], quarter().weights(2), 1e-15);
    const Scene given = sceneOf(profile + ", unit: cm}", "units: {length: um}\n", path("scene.yaml"));
    EXPECT_NEAR(std::get<ExtrusionBody>(given.body.geometry.shape).profile.points[0][2],
                0.1 * std::numbers::pi, 1e-12);
    EXPECT_EQ(parseScene(scene.resolvedYaml, "elsewhere.yaml").resolvedYaml, scene.resolvedYaml);
  }
}

TEST_F(Cad, APlaneFaceIsABody) {
  CadBody body = cube("punch", 2.0, {1, 1, 0});
  writeCad({body}, LengthUnit::Millimetre, CadFormat::Step, path("punch.step"));
  const Scene scene = sceneOf("shape: control-net, file: punch.step, face: punch.4", "", path("scene.yaml"));
  EXPECT_EQ(scene.dim(), 2);
  const auto& net = std::get<ControlNetBody>(scene.body.geometry.shape);
  ASSERT_EQ(net.points.front().size(), 2U);
  EXPECT_GT(net.patch<2>().jacobian(Eigen::Vector2d(0.5, 0.5)).determinant(), 0.0) << "seen from above";
  EXPECT_THAT(errorOfScene("shape: control-net, file: punch.step, face: punch.5", "", path("scene.yaml")),
              HasSubstr("found a face that does not lie in the plane z = 0"));
}

TEST_F(Cad, FacesThatMakeNoProfileAreNamed) {
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 4.0, 4.0, 1.0).Solid();
  const TopoDS_Shape hole =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(2, 2, -1), gp_Dir(0, 0, 1)), 1.0, 3.0).Solid();
  step("plate.step", BRepAlgoAPI_Cut(plate, hole).Shape());
  const auto errorWith = [&](const std::string& profile, const std::string& rest = "") {
    return errorOfScene("shape: extrusion, vector: [0, 0, 1], profile: {" + profile + "}", rest,
                        path("scene.yaml"));
  };
  int trimmed = 0;
  for (int face = 1; face <= 7; ++face)
    trimmed += errorWith(fmt::format("file: plate.step, face: {}", face))
                   .find("geometry.profile.face: " + path("plate.step") +
                         ": found a face that is trimmed by curves on its surface") != std::string::npos;
  EXPECT_EQ(trimmed, 2) << "above and below; the others are whole";
  EXPECT_THAT(
      errorWith("file: plate.step"),
      HasSubstr(
          "plate.step: missing, in a file of 7 faces; required: the name of one, or its number from 1 to 7."));
  EXPECT_THAT(errorWith("file: plate.step, face: 8"), HasSubstr("geometry.profile.face: "));
  EXPECT_THAT(errorWith("file: none.step"),
              HasSubstr("geometry.profile.file: " + path("none.step") + ": there is no"));
  EXPECT_THAT(errorWith("file: plate.step, face: 1, entry: 0"),
              HasSubstr("geometry.profile.entry: found beside a CAD file; allowed: face"));
  EXPECT_THAT(errorWith("file: plate.step, face: 1, unit: fathom"),
              HasSubstr("geometry.profile.unit: found \"fathom\"; allowed: nm, um"));
  EXPECT_THAT(
      errorWith("file: plate.step, face: 1", "units: {length: fathom}\n"),
      HasSubstr(
          "units.length: found \"fathom\", into which the lengths of the CAD file of geometry.profile"));
  EXPECT_THAT(
      errorWith("file: line.g2, face: 1"),
      HasSubstr("geometry.profile.face: found face beside line.g2; allowed: with a file that ends in .step"));
  EXPECT_THAT(errorWith("degrees: [1], points: [[0, 0], [1, 0]], face: 1"),
              HasSubstr("geometry.profile.face: found without file; allowed: beside a CAD file."));
  EXPECT_THAT(
      errorOfScene(kBox, "tools: [{name: wall, shape: nurbs, file: plate.step}]\n", path("scene.yaml")),
      HasSubstr("tools[0].file: found a CAD file; allowed: shape: cad"));
}

}  // namespace
}  // namespace burnish

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESBasic_Name.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPConstruct.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TransferBRep.hxx>
#include <TransferBRep_ShapeMapper.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/cad/cad_file.h"
#include "engine/cad/occt/units.h"
#include "engine/core/error.h"

namespace burnish::inline cad {
namespace {

/// All digits of a number: OpenCASCADE would write twelve of them to STEP, nine to IGES.
constexpr const char* kNumber = "%.16E";

/// Knots counted once, and how often each stands.
struct KnotTable {
  explicit KnotTable(const std::vector<double>& all) {
    for (const double knot : all) {
      if (knots.empty() || knots.back() != knot) {
        knots.push_back(knot);
        counts.push_back(0);
      }
      ++counts.back();
    }
  }

  TColStd_Array1OfReal knotArray() const { return {knots.front(), 1, static_cast<int>(knots.size())}; }
  TColStd_Array1OfInteger countArray() const { return {counts.front(), 1, static_cast<int>(counts.size())}; }

  std::vector<double> knots;
  std::vector<int> counts;
};

TopoDS_Face faceOf(const CadFace& face, double scale) {
  constexpr double kTolerance = 1e-7;  // of vertices, in millimetres, as CAD programs have it
  const int n = static_cast<int>(face.knots[0].size()) - face.degrees[0] - 1;
  const int m = static_cast<int>(face.knots[1].size()) - face.degrees[1] - 1;
  TColgp_Array2OfPnt poles(1, n, 1, m);
  TColStd_Array2OfReal weights(1, n, 1, m);
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d p = scale * face.points.col(i + n * j);
      poles(i + 1, j + 1) = gp_Pnt(p.x(), p.y(), p.z());
      weights(i + 1, j + 1) = face.weights(i + n * j);
    }
  const KnotTable u(face.knots[0]), v(face.knots[1]);
  const Handle(Geom_BSplineSurface) surface =
      new Geom_BSplineSurface(poles, weights, u.knotArray(), v.knotArray(), u.countArray(), v.countArray(),
                              face.degrees[0], face.degrees[1]);
  BRepBuilderAPI_MakeFace made(surface, kTolerance);
  if (!made.IsDone()) throw Error(fmt::format("the face {} cannot be written", face.name));
  return made.Face();
}

/// Instead of OpenCASCADE's names for a model and an author that it does not know; to IGES it would write who is logged in.
constexpr const char *kSystem = "burnish", *kModel = "NURBS surfaces", *kUnknown = "";

opencascade::handle<TCollection_HAsciiString> ascii(const std::string& text) {
  return new TCollection_HAsciiString(text.c_str());
}

/// The time that files are to be from, in UTC, where SOURCE_DATE_EPOCH says one (reproducible-builds.org): files of the same faces are
/// the same then.
std::optional<std::tm> givenTime() {
  const char* given = std::getenv("SOURCE_DATE_EPOCH");
  if (given == nullptr || *given == '\0') return std::nullopt;
  const std::string text = given;
  std::time_t seconds = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  std::tm time{};
  if (fault != std::errc() || end != text.data() + text.size() || seconds < 0 ||
      ::gmtime_r(&seconds, &time) == nullptr)
    throw Error(
        fmt::format("SOURCE_DATE_EPOCH: found \"{}\"; allowed: seconds since 1970, a whole number", text));
  return time;
}

void sayWhoWrote(const opencascade::handle<StepData_StepModel>& model) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(ascii(kModel));
  header.SetDescriptionValue(1, ascii(kModel));
  header.SetAuthorValue(1, ascii(kUnknown));
  header.SetOrganizationValue(1, ascii(kUnknown));
  header.SetOriginatingSystem(ascii(kSystem));
  header.SetAuthorisation(ascii(kUnknown));
  if (const auto time = givenTime()) header.SetTimeStamp(ascii(fmt::format("{:%Y-%m-%dT%H:%M:%S}", *time)));
}

void sayWhoWrote(const opencascade::handle<IGESData_IGESModel>& model) {
  IGESData_GlobalSection header = model->GlobalSection();
  header.SetSendName(ascii(kModel));
  header.SetFileName(ascii(kModel));
  header.SetSystemId(ascii(kSystem));
  header.SetAuthorName(ascii(kUnknown));
  if (const auto time = givenTime()) {
    const auto text = ascii(fmt::format("{:%Y%m%d.%H%M%S}", *time));
    header.SetDate(text);
    header.SetLastChangeDate(text);
  }
  model->SetGlobalSection(header);
}

/// The faces of a body as they are made of one, and together as what is written.
struct MadeBody {
  const CadBody* body = nullptr;
  std::vector<TopoDS_Face> faces{};  ///< in the order of the body
  TopoDS_Shape whole{};              ///< in STEP
};

double volumeIn(const TopoDS_Shell& shell) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shell, properties);
  return properties.Mass();
}

TopoDS_Solid solidOf(const TopoDS_Shell& shell) {
  TopoDS_Solid solid;
  BRep_Builder builder;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

/// Solids of closed shells; those that bound a void are parts of the solid around them.
std::vector<TopoDS_Solid> solidsOf(const std::vector<TopoDS_Shell>& shells) {
  std::vector<TopoDS_Solid> solids;
  if (shells.size() == 1) return {solidOf(shells.front())};
  std::vector<TopoDS_Shell> voids;
  for (const TopoDS_Shell& shell : shells)
    volumeIn(shell) > 0.0 ? solids.push_back(solidOf(shell)) : voids.push_back(shell);
  const std::vector<TopoDS_Solid> outer = solids;
  for (const TopoDS_Shell& shell : voids) {
    const TopoDS_Vertex corner = TopoDS::Vertex(TopExp_Explorer(shell, TopAbs_VERTEX).Current());
    for (std::size_t k = 0; k < outer.size(); ++k)
      if (BRepClass3d_SolidClassifier(outer[k], BRep_Tool::Pnt(corner), BRep_Tool::Tolerance(corner))
              .State() == TopAbs_IN)
        BRep_Builder().Add(solids[k], shell);
  }
  return solids;
}

/// Joins the faces where their edges lie on one another: to solids where they close.
void sew(MadeBody& made) {
  constexpr double kClose = 1e-6;  // of the body's extent
  Bnd_Box box;
  for (const TopoDS_Face& face : made.faces) BRepBndLib::Add(face, box);
  BRepBuilderAPI_Sewing sewing(std::max(1e-7, kClose * std::sqrt(box.SquareExtent())));
  for (const TopoDS_Face& face : made.faces) sewing.Add(face);
  sewing.Perform();
  TopoDS_Compound loose;
  BRep_Builder builder;
  builder.MakeCompound(loose);
  std::vector<TopoDS_Shape> parts;
  std::vector<TopoDS_Shell> closed;
  for (TopoDS_Face& face : made.faces) {
    const bool wasReversed = face.Orientation() == TopAbs_REVERSED;
    if (sewing.IsModifiedSubShape(face)) face = TopoDS::Face(sewing.ModifiedSubShape(face));
    face.Orientation(wasReversed ? TopAbs_REVERSED : TopAbs_FORWARD);
  }
  const auto isTurned = [&](const TopoDS_Shell& shell) {
    const TopoDS_Face first = TopoDS::Face(TopExp_Explorer(shell, TopAbs_FACE).Current());
    for (const TopoDS_Face& face : made.faces)
      if (face.IsSame(first)) return face.Orientation() != first.Orientation();
    return false;
  };
  for (TopExp_Explorer at(sewing.SewedShape(), TopAbs_SHELL); at.More(); at.Next()) {
    TopoDS_Shell shell = TopoDS::Shell(at.Current());
    if (isTurned(shell)) shell.Reverse();
    BRep_Tool::IsClosed(shell) ? closed.push_back(shell) : parts.push_back(shell);
  }
  for (TopExp_Explorer at(sewing.SewedShape(), TopAbs_FACE, TopAbs_SHELL); at.More(); at.Next())
    parts.push_back(at.Current());
  if (!closed.empty())
    for (const TopoDS_Solid& solid : solidsOf(closed)) parts.push_back(solid);
  if (parts.size() == 1) {
    made.whole = parts.front();
    return;
  }
  for (const TopoDS_Shape& part : parts) builder.Add(loose, part);
  made.whole = loose;
}

void writeStep(std::vector<MadeBody>& bodies, const std::string& file) {
  STEPControl_Writer writer;
  Interface_Static::SetIVal("write.step.assembly", 0);
  for (MadeBody& made : bodies) {
    sew(made);
    if (writer.Transfer(made.whole, STEPControl_AsIs) != IFSelect_RetDone)
      throw Error(fmt::format("the body {} cannot be written as STEP", made.body->name));
  }
  const Handle(Transfer_FinderProcess) finder = writer.WS()->TransferWriter()->FinderProcess();
  const auto name = [&finder](const TopoDS_Shape& shape, const std::string& text) {
    if (const auto item = STEPConstruct::FindEntity(finder, shape); !item.IsNull())
      item->SetName(ascii(text));
  };
  for (const MadeBody& made : bodies) {
    for (std::size_t k = 0; k < made.faces.size(); ++k) name(made.faces[k], made.body->faces[k].name);
    for (const TopAbs_ShapeEnum kind : {TopAbs_SHELL, TopAbs_SOLID})
      for (TopExp_Explorer at(made.whole, kind); at.More(); at.Next()) name(at.Current(), made.body->name);
  }
  auto made = bodies.begin();  // products are in the order in which bodies were transferred, one each
  for (int k = 1; k <= writer.Model()->NbEntities() && made != bodies.end(); ++k)
    if (const auto product = Handle(StepBasic_Product)::DownCast(writer.Model()->Value(k));
        !product.IsNull()) {
      product->SetId(ascii(made->body->name));
      product->SetName(ascii(made->body->name));
      ++made;
    }
  sayWhoWrote(writer.Model());
  StepData_StepWriter text(writer.Model());
  text.FloatWriter().SetFormat(kNumber);
  text.SendModel(opencascade::handle<StepData_Protocol>::DownCast(writer.WS()->Protocol()));
  std::ofstream out(file, std::ios::binary);
  if (!text.Print(out) || !out.flush()) throw Error("the file cannot be written");
}

/// Gives the entity of a face its name, as a property: labels have eight letters.
void nameFace(IGESControl_Writer& writer, const TopoDS_Face& face, const std::string& name) {
  const Handle(Transfer_FinderProcess)& process = writer.TransferProcess();
  const auto entity =
      Handle(IGESData_IGESEntity)::DownCast(process->FindTransient(TransferBRep::ShapeMapper(process, face)));
  if (entity.IsNull()) return;
  const Handle(IGESBasic_Name) property = new IGESBasic_Name;
  property->Init(1, ascii(name));
  entity->AddProperty(property);
  writer.Model()->AddEntity(property);
}

void writeIges(const std::vector<MadeBody>& bodies, const std::string& file) {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  for (const MadeBody& made : bodies)
    for (const TopoDS_Face& face : made.faces) builder.Add(all, face);
  IGESControl_Controller::Init();
  IGESControl_Writer writer("MM", 0);
  if (!writer.AddShape(all)) throw Error("the faces cannot be written as IGES");
  writer.ComputeModel();
  for (const MadeBody& made : bodies)
    for (std::size_t k = 0; k < made.faces.size(); ++k)
      nameFace(writer, made.faces[k], made.body->faces[k].name);
  sayWhoWrote(writer.Model());
  IGESData_IGESWriter text(writer.Model());
  text.FloatWriter().SetFormat(kNumber);
  text.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
  std::ofstream out(file, std::ios::binary);
  if (!text.Print(out) || !out.flush()) throw Error("the file cannot be written");
}

void writeBodies(const std::vector<CadBody>& bodies, LengthUnit unit, CadFormat format,
                 const std::string& file) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  takeMillimetres();
  std::vector<MadeBody> all;
  for (const CadBody& body : bodies) {
    MadeBody& made = all.emplace_back(MadeBody{.body = &body});
    for (const CadFace& face : body.faces) {
      made.faces.push_back(faceOf(face, millimetresOf(unit)));
      if (face.reversed) made.faces.back().Reverse();
    }
  }
  format == CadFormat::Step ? writeStep(all, file) : writeIges(all, file);
}

}  // namespace
}  // namespace burnish::inline cad

extern "C" void burnishWriteCad(const std::vector<burnish::CadBody>& bodies, burnish::LengthUnit unit,
                                burnish::CadFormat format, const std::string& file,
                                burnish::CadProblem& problem) {
  try {
    burnish::writeBodies(bodies, unit, format, file);
  } catch (const Standard_Failure& failure) {
    problem.text = fmt::format("OpenCASCADE cannot write it ({})", failure.GetMessageString());
  } catch (const std::exception& failure) {
    problem.text = failure.what();
  }
}

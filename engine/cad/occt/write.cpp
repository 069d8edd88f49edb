#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPConstruct.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <vector>

#include "engine/cad/cad_file.h"
#include "engine/cad/occt/units.h"
#include "engine/core/error.h"

namespace burnish {
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

opencascade::handle<TCollection_HAsciiString> ascii(const char* text) {
  return new TCollection_HAsciiString(text);
}

void sayWhoWrote(const opencascade::handle<StepData_StepModel>& model) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(ascii(kModel));
  header.SetDescriptionValue(1, ascii(kModel));
  header.SetAuthorValue(1, ascii(kUnknown));
  header.SetOrganizationValue(1, ascii(kUnknown));
  header.SetOriginatingSystem(ascii(kSystem));
  header.SetAuthorisation(ascii(kUnknown));
}

void sayWhoWrote(const opencascade::handle<IGESData_IGESModel>& model) {
  IGESData_GlobalSection header = model->GlobalSection();
  header.SetSendName(ascii(kModel));
  header.SetFileName(ascii(kModel));
  header.SetSystemId(ascii(kSystem));
  header.SetAuthorName(ascii(kUnknown));
  model->SetGlobalSection(header);
}

void writeStep(const TopoDS_Compound& all, const std::vector<TopoDS_Face>& made,
               const std::vector<CadFace>& faces, const std::string& file) {
  STEPControl_Writer writer;
  if (writer.Transfer(all, STEPControl_AsIs) != IFSelect_RetDone)
    throw Error("the faces cannot be written as STEP");
  const Handle(Transfer_FinderProcess) finder = writer.WS()->TransferWriter()->FinderProcess();
  for (std::size_t k = 0; k < made.size(); ++k)
    if (const auto item = STEPConstruct::FindEntity(finder, made[k]); !item.IsNull())
      item->SetName(new TCollection_HAsciiString(faces[k].name.c_str()));
  sayWhoWrote(writer.Model());
  StepData_StepWriter text(writer.Model());
  text.FloatWriter().SetFormat(kNumber);
  text.SendModel(opencascade::handle<StepData_Protocol>::DownCast(writer.WS()->Protocol()));
  std::ofstream out(file, std::ios::binary);
  if (!text.Print(out) || !out.flush()) throw Error("the file cannot be written");
}

void writeIges(const TopoDS_Compound& all, const std::string& file) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer("MM", 0);
  if (!writer.AddShape(all)) throw Error("the faces cannot be written as IGES");
  writer.ComputeModel();
  sayWhoWrote(writer.Model());
  IGESData_IGESWriter text(writer.Model());
  text.FloatWriter().SetFormat(kNumber);
  text.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
  std::ofstream out(file, std::ios::binary);
  if (!text.Print(out) || !out.flush()) throw Error("the file cannot be written");
}

void writeFaces(const std::vector<CadFace>& faces, LengthUnit unit, CadFormat format,
                const std::string& file) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  takeMillimetres();
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  std::vector<TopoDS_Face> made;
  for (const CadFace& face : faces) {
    made.push_back(faceOf(face, millimetresOf(unit)));
    if (face.reversed) made.back().Reverse();
    builder.Add(all, made.back());
  }
  format == CadFormat::Step ? writeStep(all, made, faces, file) : writeIges(all, file);
}

}  // namespace
}  // namespace burnish

extern "C" void burnishWriteCad(const std::vector<burnish::CadFace>& faces, burnish::LengthUnit unit,
                                burnish::CadFormat format, const std::string& file, std::string& problem) {
  try {
    burnish::writeFaces(faces, unit, format, file);
  } catch (const Standard_Failure& failure) {
    problem = fmt::format("OpenCASCADE cannot write it ({})", failure.GetMessageString());
  } catch (const std::exception& failure) {
    problem = failure.what();
  }
}

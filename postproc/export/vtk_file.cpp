#include "postproc/export/vtk_file.h"

#include <fmt/format.h>
#include <vtkAbstractArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "postproc/export/curved_grid_writer.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/text/page.h"
#include "postproc/text/plain_time.h"

namespace burnish {
namespace {

/// Gives all arrays of a data set names that can stand in XML, which VTK 9.1 writes as they are; its readers
/// give the names back. For the life of the object.
class EscapedNames {
 public:
  explicit EscapedNames(vtkDataObject& data) {
    for (const int kind : {vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD})
      if (vtkFieldData* fields = data.GetAttributesAsFieldData(kind))
        for (int k = 0; k < fields->GetNumberOfArrays(); ++k) escape(*fields->GetAbstractArray(k));
  }
  ~EscapedNames() {
    for (const auto& [array, name] : before_) array->SetName(name.c_str());
  }
  EscapedNames(const EscapedNames&) = delete;
  EscapedNames& operator=(const EscapedNames&) = delete;

 private:
  void escape(vtkAbstractArray& array) {
    const std::string name = array.GetName();
    if (escaped(name) == name) return;
    before_.emplace_back(&array, name);
    array.SetName(escaped(name).c_str());
  }

  std::vector<std::pair<vtkAbstractArray*, std::string>> before_;
};

template <class Writer>
void write(vtkDataObject& data, double time, const std::filesystem::path& file) {
  data.GetFieldData()->AddArray(makeArray("TimeValue", Eigen::MatrixXd::Constant(1, 1, plainTime(time)), {}));
  const EscapedNames names(data);
  vtkNew<Writer> writer;
  writer->SetInputData(&data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();
  writer->SetCompressorTypeToZLib();
  writeFileAtomically(file, [&](const std::filesystem::path& partial) {
    writer->SetFileName(partial.c_str());
    if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError)
      throw Error(fmt::format("cannot write {}: {}", file.string(),
                              writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError
                                  ? "No space left on device"
                                  : vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())));
  });
}

std::string arrayElement(vtkDataArray& array) {
  std::string element = fmt::format("<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"",
                                    array.GetDataType() == VTK_DOUBLE ? "Float64" : "Int32",
                                    escaped(array.GetName()), array.GetNumberOfComponents());
  for (int c = 0; c < array.GetNumberOfComponents(); ++c)
    if (const char* name = array.GetComponentName(c))
      element += fmt::format(" ComponentName{}=\"{}\"", c, escaped(name));
  return element + "/>";
}

/// Arrays of a kind, those with a meaning for VTK named once more.
std::string arraysElement(const char* kind, vtkDataSetAttributes& arrays) {
  std::string meanings, elements;
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
    if (vtkDataArray* array = arrays.GetAttribute(type))
      meanings += fmt::format(" {}=\"{}\"", vtkDataSetAttributes::GetAttributeTypeAsString(type),
                              escaped(array->GetName()));
  for (int k = 0; k < arrays.GetNumberOfArrays(); ++k)
    elements += fmt::format("      {}\n", arrayElement(*arrays.GetArray(k)));
  return fmt::format("    <{}{}>\n{}    </{}>\n", kind, meanings, elements, kind);
}

}  // namespace

std::string layoutOf(vtkUnstructuredGrid& grid) {
  return arraysElement("PPointData", *grid.GetPointData()) + arraysElement("PCellData", *grid.GetCellData()) +
         "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" "
         "NumberOfComponents=\"3\"/>\n    </PPoints>\n";
}

void writePvtuFile(const std::string& layout, const std::vector<std::filesystem::path>& pieces,
                   const std::filesystem::path& pvtu) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"2.2\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  xml += layout;
  for (const auto& piece : pieces)
    xml += fmt::format("    <Piece Source=\"{}\"/>\n", piece.filename().string());
  xml += "  </PUnstructuredGrid>\n</VTKFile>\n";
  writeFileAtomically(pvtu, std::as_bytes(std::span(xml)));
}

void writeVtkFile(vtkUnstructuredGrid& grid, double time, const std::filesystem::path& vtu) {
  if (grid.GetCellData()->GetHigherOrderDegrees() != nullptr)
    write<CurvedGridWriter>(grid, time, vtu);
  else
    write<vtkXMLUnstructuredGridWriter>(grid, time, vtu);
}

void writeVtkFile(vtkPolyData& data, double time, const std::filesystem::path& vtp) {
  write<vtkXMLPolyDataWriter>(data, time, vtp);
}

}  // namespace burnish

#pragma once
#include <vtkXMLUnstructuredGridWriter.h>

namespace burnish {

/// Marks files of curved hexahedra as of version 2.2: those of earlier versions are read with two points
/// exchanged, because VTK had another order of points once. Other cells are of version 1.0, which more
/// programs take; VTK 9.1 itself writes version 0.1.
class CurvedGridWriter : public vtkXMLUnstructuredGridWriter {
 public:
  static CurvedGridWriter* New();

 protected:
  int GetDataSetMajorVersion() override;
  int GetDataSetMinorVersion() override;

 private:
  bool isOfVolumes();
};

}  // namespace burnish

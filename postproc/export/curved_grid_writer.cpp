#include "postproc/export/curved_grid_writer.h"

#include <vtkCell.h>
#include <vtkDataSet.h>
#include <vtkObjectFactory.h>

namespace burnish {

vtkStandardNewMacro(CurvedGridWriter);

int CurvedGridWriter::GetDataSetMajorVersion() {
  return isOfVolumes() ? 2 : 1;
}

int CurvedGridWriter::GetDataSetMinorVersion() {
  return isOfVolumes() ? 2 : 0;
}

bool CurvedGridWriter::isOfVolumes() {
  vtkDataSet* data = GetInputAsDataSet();
  return data->GetNumberOfCells() > 0 && data->GetCell(0)->GetCellDimension() == 3;
}

}  // namespace burnish

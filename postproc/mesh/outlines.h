#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>

#include "engine/results/result.h"
#include "postproc/mesh/subdivision.h"

class vtkPolyData;

namespace burnish {

/// The edges of the body (of a single patch the 4 of a surface or the 12 of a volume; not those at which it
/// is joined to others, see `PatchBorders`) as polylines with `subdivision` segments per knot span.
/// displacement: dim x nodes; empty for the undeformed body. coefficients: components x nodes of a field whose values
/// are the point data `kValuesAlong`; null: none.
vtkSmartPointer<vtkPolyData> bodyOutline(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                                         const Subdivision& subdivision,
                                         const Eigen::MatrixXd* coefficients = nullptr);
inline constexpr const char* kValuesAlong = "along";

/// The lines between knot spans and between patches, without those of `bodyOutline`; of a volume, those on
/// its surface.
vtkSmartPointer<vtkPolyData> knotLines(const MeshRecord& mesh, const Eigen::MatrixXd& displacement,
                                       const Subdivision& subdivision,
                                       const Eigen::MatrixXd* coefficients = nullptr);

}  // namespace burnish

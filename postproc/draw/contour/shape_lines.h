#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>

class vtkPolyData;

/// Lines that show the shape of a surface in space.
namespace burnish {

/// The surface with one point where several coincide.
vtkSmartPointer<vtkPolyData> withoutSeams(vtkPolyData& surface);

/// The surface with normals at its points, for smooth shading and `silhouetteOf`; edges stay sharp.
vtkSmartPointer<vtkPolyData> withNormals(vtkPolyData& surface);

/// Where a surface with normals turns away from the eye.
vtkSmartPointer<vtkPolyData> silhouetteOf(vtkPolyData& surface, const Eigen::Vector3d& towardsEye);

/// The border of a surface and its sharp edges.
vtkSmartPointer<vtkPolyData> edgesOf(vtkPolyData& surface);

}  // namespace burnish

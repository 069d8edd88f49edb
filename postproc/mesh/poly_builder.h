#pragma once
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <Eigen/Dense>
#include <vector>

class vtkCellArray;
class vtkPoints;
class vtkPolyData;

namespace burnish {

/// Puts polylines and polygons together one by one, in double precision.
class PolyBuilder {
 public:
  PolyBuilder();
  ~PolyBuilder();
  PolyBuilder(const PolyBuilder&) = delete;
  PolyBuilder& operator=(const PolyBuilder&) = delete;

  /// Adds points (2 or 3 coordinates x points) and returns their numbers.
  std::vector<vtkIdType> addPoints(const Eigen::MatrixXd& positions);

  void addLine(const std::vector<vtkIdType>& points);
  void addPolygon(const std::vector<vtkIdType>& points);

  vtkSmartPointer<vtkPolyData> finish() const;

 private:
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkCellArray> lines_;
  vtkSmartPointer<vtkCellArray> polygons_;
};

}  // namespace burnish

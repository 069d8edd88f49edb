#include "postproc/mesh/same_points.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace burnish {

std::vector<vtkIdType> firstOfSame(vtkPoints& points, double distance) {
  if (points.GetNumberOfPoints() == 0) return {};
  vtkNew<vtkPolyData> data;
  data->SetPoints(&points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  std::vector<vtkIdType> first(static_cast<std::size_t>(points.GetNumberOfPoints()));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, first.size(), 1024), [&](const auto& range) {
    vtkNew<vtkIdList> near;
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      first[k] = static_cast<vtkIdType>(k);
      std::array<double, 3> x{};
      points.GetPoint(first[k], x.data());
      locator->FindPointsWithinRadius(distance, x.data(), near);
      for (vtkIdType other = 0; other < near->GetNumberOfIds(); ++other)
        first[k] = std::min(first[k], near->GetId(other));
    }
  });
  return first;
}

}  // namespace burnish

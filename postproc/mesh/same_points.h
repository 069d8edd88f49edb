#pragma once

#include <vtkPoints.h>

#include <vector>

namespace burnish {

/// Of each point the first that is at most a distance away, that point itself if none comes before it, which may have another
/// first one where points lie in a chain. The same at every call:
/// vtkStaticPointLocator::MergePoints and what is built on it let threads race for which points become one.
std::vector<vtkIdType> firstOfSame(vtkPoints& points, double distance);

}  // namespace burnish

#pragma once
#include <json/value.h>

#include <Eigen/Geometry>
#include <vector>

#include "engine/results/result.h"

class vtkPolyData;

namespace burnish {

/// Points relative to the origin with `triangles`, `segments` and, where there are any, `normals` and the scalars of
/// points as `values`; null without points.
Json::Value partJson(vtkPolyData* part, const Eigen::Vector3d& origin);

/// Tools in so many dimensions at their reference positions, cut off where they reach beyond the box: points about the
/// `origin`, `triangles` and `segments` of them, in space `normals`; and the `pivot` and the `axis` about which
/// each turns. turns: whether the tools turn at any time.
Json::Value viewTools(const std::vector<ToolRecord>& tools, int dim, const Eigen::AlignedBox3d& box,
                      const Eigen::Vector3d& origin, bool turns);

/// What moves each tool of a frame: displacement of the pivot and turn, 4 numbers per tool.
Eigen::MatrixXd toolMotion(const ModelRecord& model, const FrameRecord& frame, double warp);

}  // namespace burnish

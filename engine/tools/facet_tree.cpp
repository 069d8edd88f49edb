#include "engine/tools/facet_tree.h"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <optional>
#include <vector>

namespace burnish::inline tools {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Segments = std::vector<Kernel::Segment_3>;
using Triangles = std::vector<Kernel::Triangle_3>;
template <class Primitive>
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using SegmentTree = Tree<CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator>>;
using TriangleTree = Tree<CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>;

template <class Facets, class AnyTree>
FacetTree::Hit nearestOf(const Facets& facets, const AnyTree& tree, const Point& x) {
  const auto [point, facet] = tree.closest_point_and_primitive(x);
  return {static_cast<int>(facet - facets.begin()), {point.x(), point.y(), point.z()}};
}

}  // namespace

struct FacetTree::Impl {
  Segments segments;
  Triangles triangles;
  SegmentTree segmentTree;
  TriangleTree triangleTree;
};

FacetTree::FacetTree(const Eigen::Matrix3Xd& points, const Eigen::MatrixXi& cells) {
  const auto impl = std::make_shared<Impl>();
  const auto corner = [&](Eigen::Index k, Eigen::Index cell) {
    const Eigen::Vector3d p = points.col(cells(k, cell));
    return Point(p.x(), p.y(), p.z());
  };
  for (Eigen::Index c = 0; c < cells.cols(); ++c) {
    if (cells.rows() == 2)
      impl->segments.emplace_back(corner(0, c), corner(1, c));
    else
      impl->triangles.emplace_back(corner(0, c), corner(1, c), corner(2, c));
  }
  impl->segmentTree.insert(impl->segments.cbegin(), impl->segments.cend());
  impl->triangleTree.insert(impl->triangles.cbegin(), impl->triangles.cend());
  impl_ = impl;
}

FacetTree::Hit FacetTree::nearest(const Eigen::Vector3d& x) const {
  const Point point(x.x(), x.y(), x.z());
  if (!impl_->segments.empty()) return nearestOf(impl_->segments, impl_->segmentTree, point);
  return nearestOf(impl_->triangles, impl_->triangleTree, point);
}

}  // namespace burnish::inline tools

#include "engine/contact/box_tree.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <iterator>

namespace burnish::inline contact {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Box = Kernel::Iso_cuboid_3;
using Boxes = std::vector<Box>;

/// What CGAL's tree wants to know of a box (its concept AABBPrimitive).
class BoxPrimitive {
 public:
  using Id = Boxes::const_iterator;
  using Point = Kernel::Point_3;
  using Datum = Box;
  using Point_reference = Point;
  using Datum_reference = const Datum&;

  explicit BoxPrimitive(Id box) : box_(box) {}
  Datum_reference datum() const { return *box_; }
  Id id() const { return box_; }
  Point_reference reference_point() const { return box_->min(); }

 private:
  Id box_;
};

using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, BoxPrimitive>>;

Box boxOf(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return {Kernel::Point_3(low.x(), low.y(), low.z()), Kernel::Point_3(high.x(), high.y(), high.z())};
}

}  // namespace

struct BoxTree::Impl {
  Boxes boxes;
  Tree tree;
};

BoxTree::BoxTree(const Eigen::Matrix3Xd& low, const Eigen::Matrix3Xd& high) {
  if (low.cols() == 0) return;
  const auto impl = std::make_shared<Impl>();
  for (Eigen::Index k = 0; k < low.cols(); ++k) impl->boxes.push_back(boxOf(low.col(k), high.col(k)));
  impl->tree.insert(impl->boxes.cbegin(), impl->boxes.cend());
  impl->tree.build();
  impl_ = impl;
}

std::vector<int> BoxTree::meeting(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
  std::vector<int> numbers;
  if (!impl_) return numbers;
  std::vector<Boxes::const_iterator> found;
  impl_->tree.all_intersected_primitives(boxOf(low, high), std::back_inserter(found));
  for (const auto box : found) numbers.push_back(static_cast<int>(box - impl_->boxes.cbegin()));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace burnish::inline contact

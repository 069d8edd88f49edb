#pragma once
#include <Eigen/Dense>

#include "engine/analysis/model.h"

namespace burnish::inline analysis {

/// Share of a pair's normal force, summed over the points in touch, that presses on the face from the side of
/// the body: where the tool's normal and the face's outward normal point to the same side, so that gap and
/// force contradict one another. In the state x that the pair has been evaluated at; 0 without touch.
template <int Dim>
double forceFromInside(const Body<Dim>& body, const ContactPair<Dim>& pair, const Eigen::VectorXd& x);

}  // namespace burnish::inline analysis

#pragma once
#include <memory>
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/fields/measure.h"
#include "engine/fields/projection.h"
#include "engine/results/result.h"

namespace burnish::inline analysis {

/// The measures of a scene: columns of its history.
template <int Dim>
class Measures {
 public:
  /// Model and projections (one per body) must outlive the object. Throws `Error` with the place in the scene for points
  /// outside the body and ellipses of pairs that are no contact.
  Measures(const Scene& scene, const Model<Dim>& model, const std::vector<Projection<Dim>>& projections);

  /// NAME.ux, ...
  std::vector<std::string> columns() const;
  std::vector<double> values(const MeasuredState& state);

 private:
  struct Named {
    std::string name;
    std::unique_ptr<Measure> measure;
  };

  std::unique_ptr<Measure> make(const PointMeasureSpec& spec);
  std::unique_ptr<Measure> make(const FaceMeasureSpec& spec);
  std::unique_ptr<Measure> make(const ErrorMeasureSpec& spec);
  std::unique_ptr<Measure> make(const EllipseMeasureSpec& spec);
  std::unique_ptr<Measure> make(const ExtentMeasureSpec& spec);
  std::unique_ptr<Measure> make(const PercentileMeasureSpec& spec);

  /// Of a body; projected once per state, and only if a measure asks.
  const std::map<std::string, FieldRecord>& fields(std::size_t body);

  const Scene& scene_;
  const Model<Dim>& model_;
  const std::vector<Projection<Dim>>& projections_;
  std::vector<std::map<std::string, FieldRecord>> fields_;  ///< one per body; empty before they are asked for
  std::vector<Named> measures_;
};

}  // namespace burnish::inline analysis

#include "postproc/probe/foreign_probe.h"

#include <fmt/format.h>
#include <vtkBoundingBox.h>
#include <vtkCell.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/draw/foreign/foreign_picture.h"
#include "postproc/draw/foreign/foreign_surface.h"
#include "postproc/probe/body_locator.h"
#include "postproc/probe/path_samples.h"
#include "postproc/probe/path_text.h"

namespace burnish {
namespace {

constexpr const char* kFirstCells = "a cell of the first instant";

/// A place in a cell of a block: its value is that of the points times the weights.
struct CellPlace {
  std::size_t block = 0;
  vtkIdType cell = 0;
  std::vector<vtkIdType> points;
  std::vector<double> weights;
};

void refuse(bool isGiven, const char* key, const char* why, const ForeignFile& file,
            const char* instead = "a line or a point") {
  if (isGiven)
    throw Error(fmt::format("{}: {}, and {} is of another program; give {}", key, why, file.file().string(),
                            instead));
}

void requireForeign(const ProbeSpec& spec, const ForeignFile& file) {
  refuse(!spec.face.empty(), "face", "only runs of burnish have faces with names", file);
  refuse(!spec.depth.empty(), "depth", "only runs of burnish have faces with names", file);
  refuse(!spec.patch.empty(), "patch", "only runs of burnish have patches", file);
  refuse(spec.window && !spec.point.empty(), "window",
         "only runs of burnish know the material around a point", file, "a point alone, or a line");
  refuse(spec.reference, "reference", "only runs of burnish know the undeformed body", file);
}

double timeOf(const ForeignFile& file, int instant) {
  return file.times().empty() ? 0.0 : file.times()[static_cast<std::size_t>(instant)];
}

/// Of fields that an instant does not have.
enum class Absent { Refused, Unknown };

/// The file at an instant: where its cells are, and what they hold.
class ForeignCells {
 public:
  ForeignCells(const ForeignFile& file, int instant, const ProbeSpec& spec, Absent absent)
      : file_(file), blocks_(chosenBlocks(file.blocks(static_cast<std::size_t>(instant)), spec.bodies)) {
    const std::vector<ForeignField> known = foreignFieldsOf(blocks_);
    const std::string where = file.times().size() < 2 ? file.file().string()
                                                      : fmt::format("{} at t = {:.6g}", file.file().string(),
                                                                    timeOf(file, instant));
    if (known.empty() && absent == Absent::Refused)
      throw Error(fmt::format("{}: there are no fields in it, and so no values", where));
    std::vector<std::string> names = spec.fields;
    if (names.empty()) names.push_back(foreignFieldToShow(known));
    for (const std::string& name : names) {
      const auto found = findForeignField(known, name);
      if (!found && absent == Absent::Unknown) {
        fields_.emplace_back();
        values_.push_back({false, std::vector<Eigen::MatrixXd>(blocks_.size())});
        continue;
      }
      const ForeignChoice choice = chooseForeignField(known, name, where);
      fields_.push_back(wordsOf(choice));
      std::vector<Eigen::MatrixXd> ofBlocks;
      for (const ForeignBlock& block : blocks_) ofBlocks.push_back(choice.partsOf(block));
      values_.push_back({choice.field.ofCells, std::move(ofBlocks)});
    }
    isFlat_ = std::ranges::all_of(blocks_, [](const ForeignBlock& block) { return isPlane(*block.grid); });
    for (const ForeignBlock& block : blocks_) {
      if (block.grid->GetNumberOfPoints() > 0) box_.AddBox(vtkBoundingBox(block.grid->GetBounds()));
      vtkNew<vtkStaticCellLocator> locator;
      locator->SetDataSet(block.grid);
      locator->BuildLocator();
      locators_.emplace_back(locator);
    }
    if (!box_.IsValid())
      throw Error(fmt::format("{}: there are no cells in it to be looked at", file.file().string()));
  }

  int dim() const { return isFlat_ ? 2 : 3; }

  /// Those that are absent have no name.
  const std::vector<FieldChoice>& fields() const { return fields_; }

  /// The place at a position: in the block of the place before if that has it, and of cells that meet there in that place's
  /// cell or the nearest one, so that a line along a border stays on one side.
  std::optional<CellPlace> find(const Eigen::VectorXd& position,
                                const std::optional<CellPlace>& before = {}) const {
    const std::size_t first = before ? before->block : 0;
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      if (auto place = findIn((first + k) % blocks_.size(), position, before)) return place;
    return std::nullopt;
  }

  /// Whether the cells are those of another instant.
  bool hasCellsOf(const ForeignCells& other) const {
    return std::ranges::equal(blocks_, other.blocks_, [](const ForeignBlock& one, const ForeignBlock& two) {
      return one.grid->GetNumberOfCells() == two.grid->GetNumberOfCells() &&
             one.grid->GetNumberOfPoints() == two.grid->GetNumberOfPoints();
    });
  }

  ProbePoint at(double along, const CellPlace& place) const {
    vtkUnstructuredGrid& grid = *blocks_[place.block].grid;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < place.points.size(); ++k)
      position += place.weights[k] * Eigen::Map<const Eigen::Vector3d>(grid.GetPoint(place.points[k]));
    ProbePoint point{along, static_cast<int>(place.block), position.head(dim()), unknown(),
                     Eigen::VectorXd::Constant(std::ssize(values_), ProbePoint::kNone)};
    for (std::size_t f = 0; f < values_.size(); ++f) {
      const auto& [ofCells, ofBlocks] = values_[f];
      const Eigen::MatrixXd& own = ofBlocks[place.block];
      if (own.size() == 0) continue;
      Eigen::VectorXd parts = Eigen::VectorXd::Zero(own.rows());
      if (ofCells) parts = own.col(place.cell);
      for (std::size_t k = 0; !ofCells && k < place.points.size(); ++k)
        parts += place.weights[k] * own.col(place.points[k]);
      point.values(static_cast<Eigen::Index>(f)) = parts.size() == 1 ? parts(0) : parts.norm();
    }
    return point;
  }

  ProbePoint outside(double along, const Eigen::VectorXd& position) const {
    return {along, ProbePoint::kOutside, position, unknown(),
            Eigen::VectorXd::Constant(std::ssize(values_), ProbePoint::kNone)};
  }

  /// The straight line as a function of the distance from its begin.
  std::pair<PathProbe, double> along(const LinePath& line) const {
    const double length = (line.end - line.begin).stableNorm();
    if (!(length > 0.0))
      throw Error(fmt::format("line: found {} twice; expected two points", pointText(line.begin)));
    requireNotTooLong("line", length);
    const Eigen::VectorXd direction = (line.end - line.begin) / length;
    return {
        [this, begin = line.begin, direction, before = std::optional<CellPlace>()](double distance) mutable {
          const Eigen::VectorXd position = begin + distance * direction;
          auto place = find(position, before);
          if (!place) return outside(distance, position);
          before = std::move(place);
          return at(distance, *before);
        },
        length};
  }

  /// Of longer paths the borders of cells would be blurred.
  void requireNotTooLong(const char* what, double length) const {
    constexpr double kLongest = 1000.0;
    if (!(length <= kLongest * box_.GetMaxLength()))
      throw Error(
          fmt::format("{}: found a length of {:.6g}; expected at most {} times the size of the cells, {:.6g}",
                      what, length, kLongest, box_.GetMaxLength()));
  }

  /// "between (0, 0) and (2, 1)"
  std::string extent() const {
    Eigen::Vector3d low, high;
    box_.GetBounds(low(0), high(0), low(1), high(1), low(2), high(2));
    return fmt::format("between {} and {}", pointText(low.head(dim())), pointText(high.head(dim())));
  }

  std::string name() const { return file_.file().string(); }

 private:
  struct Values {
    bool ofCells;
    std::vector<Eigen::MatrixXd> ofBlocks;  ///< see `ForeignChoice::partsOf`
  };

  Eigen::VectorXd unknown() const { return Eigen::VectorXd::Constant(dim(), ProbePoint::kNone); }

  /// The parameters of a curved cell at a position, by Newton's method from those that VTK finds in straight parts of it;
  /// with the point there and the weights of the cell's points. False if it does not arrive.
  static bool invert(vtkCell& cell, const Eigen::Vector3d& x, Eigen::Vector3d& parameters,
                     Eigen::Vector3d& nearest, std::vector<double>& weights) {
    constexpr int kMostSteps = 20;
    constexpr double kStep = 1e-6, kArrived = 1e-12;
    int part = 0;
    const auto at = [&](Eigen::Vector3d place) {
      Eigen::Vector3d position;
      cell.EvaluateLocation(part, place.data(), position.data(), weights.data());
      return position;
    };
    const Eigen::Index dim = cell.GetCellDimension();
    for (int step = 0; step < kMostSteps; ++step) {
      Eigen::MatrixXd slopes(3, dim);
      for (Eigen::Index d = 0; d < dim; ++d)
        slopes.col(d) = (at(parameters + kStep * Eigen::Vector3d::Unit(d)) -
                         at(parameters - kStep * Eigen::Vector3d::Unit(d))) /
                        (2.0 * kStep);
      nearest = at(parameters);
      const Eigen::VectorXd change = slopes.colPivHouseholderQr().solve(x - nearest);
      if (!change.allFinite()) return false;
      if (change.norm() <= kArrived) return true;
      parameters.head(dim) += change;
    }
    return false;
  }

  static Eigen::Vector3d middleOf(vtkUnstructuredGrid& grid, vtkIdType cell) {
    Eigen::Matrix<double, 3, 2, Eigen::RowMajor> bounds;
    grid.GetCellBounds(cell, bounds.data());
    return bounds.rowwise().mean();
  }

  /// VTK's cells reach a thousandth beyond their faces, which is too far.
  std::optional<CellPlace> findIn(std::size_t number, const Eigen::VectorXd& position,
                                  const std::optional<CellPlace>& before) const {
    constexpr double kOutside = 1e-9;  // of the size: numbers of a position are rounded
    vtkUnstructuredGrid& grid = *blocks_[number].grid;
    if (grid.GetNumberOfCells() == 0) return std::nullopt;
    Eigen::Vector3d x(0.0, 0.0, isFlat_ ? grid.GetBounds()[4] : 0.0);
    x.head(position.size()) = position;
    const double tolerance = kOutside * box_.GetMaxLength();
    Eigen::Matrix<double, 3, 2, Eigen::RowMajor> around;
    around << x.array() - tolerance, x.array() + tolerance;
    vtkNew<vtkIdList> candidates;
    locators_[number]->FindCellsWithinBounds(around.data(), candidates);
    std::vector<double> weights(static_cast<std::size_t>(grid.GetMaxCellSize()));
    vtkNew<vtkGenericCell> cell;
    std::optional<CellPlace> best;
    double least = 0.0;
    for (const vtkIdType candidate : *candidates) {
      grid.GetCell(candidate, cell);
      Eigen::Vector3d nearest, parameters;
      int part = 0;
      double square = 0.0;
      if (cell->EvaluatePosition(x.data(), nearest.data(), part, parameters.data(), square, weights.data()) !=
          1)
        continue;
      if (!cell->IsLinear() && !invert(*cell, x, parameters, nearest, weights)) continue;
      if (cell->GetParametricDistance(parameters.data()) > kOutside ||
          (nearest - x).norm() > 10.0 * tolerance)
        continue;
      const double away = before && before->block == number
                              ? (middleOf(grid, candidate) - middleOf(grid, before->cell)).norm()
                              : static_cast<double>(candidate);
      if (best && away >= least) continue;
      least = away;
      vtkIdList& ids = *cell->GetPointIds();
      best = CellPlace{number, candidate, {ids.begin(), ids.end()}, weights};
    }
    return best;
  }

  const ForeignFile& file_;
  std::vector<ForeignBlock> blocks_;
  std::vector<FieldChoice> fields_;
  std::vector<Values> values_;  ///< of each field
  std::vector<vtkSmartPointer<vtkStaticCellLocator>> locators_;
  vtkBoundingBox box_;
  bool isFlat_ = true;
};

LinePath lineOf(const ProbeSpec& spec, int dim) {
  return std::get<LinePath>(pathOf(spec, dim));
}

bool isOutside(const ProbePoint& point) {
  return point.body == ProbePoint::kOutside;
}

}  // namespace

ProbedRun probedInstant(const ForeignFile& file, int instant, const ProbeSpec& spec) {
  requireForeign(spec, file);
  const ForeignCells cells(file, instant, spec, Absent::Refused);
  const auto [probe, length] = cells.along(lineOf(spec, cells.dim()));
  cells.requireNotTooLong("window", spec.window.value_or(0.0));
  std::vector<ProbePoint> points = samplesAlong(probe, 0.0, length, spec.points);
  if (std::ranges::all_of(points, isOutside))
    throw Error(
        fmt::format("line: no point of it is in a cell of {}, which lies {}", cells.name(), cells.extent()));
  if (spec.window)
    points = windowAverages(probe, std::move(points), *spec.window, -0.5 * *spec.window,
                            length + 0.5 * *spec.window);
  return {"", cells.dim(), "", cells.fields(), std::move(points), true};
}

ProbedRun probedHistory(const ForeignFile& file, const std::vector<int>& instants, const ProbeSpec& spec) {
  requireForeign(spec, file);
  ProbeSpec asked = spec;
  for (auto instant = instants.begin(); asked.fields.empty() && instant != instants.end(); ++instant)
    if (const std::string field =
            foreignFieldToShow(foreignFieldsOf(file.blocks(static_cast<std::size_t>(*instant))));
        !field.empty())
      asked.fields = {field};
  ProbedRun run;
  run.isForeign = true;
  const ForeignCells first(file, instants.front(), asked, Absent::Unknown);
  run.dim = first.dim();
  std::optional<CellPlace> place;
  if (!asked.point.empty()) {
    place = first.find(pointOf(asked, run.dim, kFirstCells));
    if (!place)
      throw Error(fmt::format("point: {} is in no cell of {}, which lies {}", asked.point, first.name(),
                              first.extent()));
  }
  std::vector<bool> isKnown(std::max<std::size_t>(1, asked.fields.size()), false);
  run.fields.resize(isKnown.size());
  for (const int instant : instants) {
    throwIfInterrupted();
    const ForeignCells cells(file, instant, asked, Absent::Unknown);
    for (std::size_t f = 0; f < isKnown.size(); ++f)
      if (!isKnown[f] && !cells.fields()[f].name.empty()) {
        run.fields[f] = cells.fields()[f];
        isKnown[f] = true;
      }
    const double time = timeOf(file, instant);
    if (asked.point.empty()) {
      const auto [probe, length] = cells.along(lineOf(asked, cells.dim()));
      ProbePoint mean = cells.outside(time, Eigen::VectorXd::Constant(cells.dim(), ProbePoint::kNone));
      mean.values = meanAlong(probe, samplesAlong(probe, 0.0, length, asked.points));
      run.points.push_back(std::move(mean));
      continue;
    }
    const Eigen::VectorXd position = pointOf(asked, cells.dim(), kFirstCells);
    const auto here = cells.hasCellsOf(first) ? place : cells.find(position);
    run.points.push_back(here ? cells.at(time, *here) : cells.outside(time, position));
  }
  if (std::ranges::count(isKnown, false) > 0)  // says what there is
    const ForeignCells refused(file, instants.back(), asked, Absent::Refused);
  return run;
}

}  // namespace burnish

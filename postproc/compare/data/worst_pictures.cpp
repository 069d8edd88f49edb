#include "postproc/compare/data/worst_pictures.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/lower_case.h"
#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/chart/chart.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/draw/foreign/foreign_picture.h"
#include "postproc/export/scratch_directory.h"
#include "postproc/foreign/foreign_file.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr std::array kPictureSize{720, 420};
constexpr double kTextSize = 17.0;  // three of them stand side by side on a page
constexpr const char *kHistory = "history.", *kQuadrature = "quadrature.", *kCells = "cells.",
                     *kPoints = "points";

/// The bytes of a file that `draw` makes; empty if what it is asked for cannot be drawn.
std::string drawnBytes(const std::function<void(const fs::path&)>& draw) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "drawn.png";
  try {
    draw(file);
  } catch (const Error&) {
    return "";
  }
  return readText(file);
}

/// The instant that is nearest to a time; the only one without times.
int instantAt(const std::vector<double>& times, const std::optional<double>& time) {
  if (!time || times.empty()) return 0;
  const auto nearest = std::ranges::min_element(times, {}, [&](double t) { return std::abs(t - *time); });
  return static_cast<int>(nearest - times.begin());
}

std::string withComponent(const std::string& field, const std::string& component) {
  return component.empty() ? field : field + "." + component;
}

std::string differenceOf(const std::string& drawn) {
  return "difference of " + drawn;
}

/// The component that differs most.
std::string differenceOf(const FieldComparison& field) {
  return differenceOf(withComponent(field.array, field.worst->component));
}

template <class Options>
Options optionsAt(const std::string& field, const WorstPlace& worst) {
  Options options;
  options.field = field;
  options.size = kPictureSize;
  options.textSize = kTextSize;
  options.title = "";
  if (worst.position.size() > 0 && worst.position.allFinite()) {
    options.mark = Eigen::Vector3d::Zero();
    options.mark->head(worst.position.size()) = worst.position;
  }
  return options;
}

/// Of a picture of a difference, in which red is more than the baseline has.
std::array<double, 2> aboutZero(const std::array<double, 2>& range) {
  const double most = std::max(std::abs(range[0]), std::abs(range[1]));
  return {-most, most};
}

/// Fields of places come before columns of histories, which may be all noise about zero.
std::pair<bool, double> urgency(const FieldComparison& field) {
  return {field.worst->position.size() > 0, field.allowed > 0.0 ? field.worst->difference / field.allowed
                                                                : std::numeric_limits<double>::infinity()};
}

}  // namespace

std::vector<WorstField> worstFields(const std::vector<ResultComparison>& comparisons, std::size_t most) {
  std::vector<WorstField> fields;
  for (const auto& [pair, own] : comparisons)
    for (const FieldComparison& field : own)
      if (field.worst && field.verdict != FieldVerdict::Equal) fields.push_back({&pair, &field});
  std::ranges::stable_sort(fields, std::greater{},
                           [](const WorstField& each) { return urgency(*each.field); });
  fields.resize(std::min(fields.size(), most));
  return fields;
}

/// Draws the fields of a pair.
class WorstPictures::PairDrawing {
 public:
  virtual ~PairDrawing() = default;
  virtual FieldPictures draw(const FieldComparison& field) const = 0;
};

class WorstPictures::RunDrawing : public PairDrawing {
 public:
  explicit RunDrawing(const DataPair& pair) : actual_(pair.actual), baseline_(pair.baseline) {}

  FieldPictures draw(const FieldComparison& field) const override {
    if (field.array.starts_with(kHistory)) return charts(field.array.substr(std::string(kHistory).size()));
    const FrameRecord actual = frameAt(actual_, field), baseline = frameAt(baseline_, field);
    const std::string name = drawable(field, baseline);
    if (name.empty()) return {};
    ContourOptions options = optionsAt<ContourOptions>(name, *field.worst);
    try {
      shareView(options, {0, 1}, {0, 1}, [&](int k, bool, bool) {
        const ModelRecord& model = k == 0 ? baseline_.model() : actual_.model();
        const FrameRecord& frame = k == 0 ? baseline : actual;
        return FrameView{shownRanges(model, frame, options).shown, contentOf(model, frame, options)};
      });
    } catch (const Error&) {
      return {};  // values that are not finite
    }
    FieldPictures pictures;
    pictures.baseline =
        drawnBytes([&](const fs::path& file) { drawContour(baseline_.model(), baseline, options, file); });
    pictures.actual =
        drawnBytes([&](const fs::path& file) { drawContour(actual_.model(), actual, options, file); });
    if (const auto difference = differenceFrame(field, actual, baseline))
      pictures.difference = drawnBytes([&](const fs::path& file) {
        options.field = differenceOf(field);
        options.range.reset();
        options.range = aboutZero(shownRanges(baseline_.model(), *difference, options).shown);
        options.colormap = "coolwarm";
        drawContour(baseline_.model(), *difference, options, file);
      });
    return pictures;
  }

 private:
  static FrameRecord frameAt(const ResultReader& result, const FieldComparison& field) {
    return result.frame(instantAt(result.times(), field.worst->time));
  }

  /// The field of pictures that shows these values, or the one nearest to them; empty if there is none.
  static std::string drawable(const FieldComparison& field, const FrameRecord& frame) {
    static const std::map<std::string, std::string> ofContact{
        {"contact.pressure", "contact_pressure"},
        {"contact.quadrature_pressure", "contact_pressure"},
        {"contact.quadrature_friction", "friction_traction"},
        {"contact.quadrature_slip", "slip"},
        {"contact.quadrature_slipped", "slipped"},
        {"contact.quadrature_sliding", "sliding"}};
    std::string array = field.array;
    if (array.starts_with(kQuadrature)) array.erase(0, std::string(kQuadrature).size());
    const auto contact = ofContact.find(array);
    const std::string name =
        contact == ofContact.end() ? withComponent(array, field.worst->component) : contact->second;
    const std::vector<std::string> names = fieldNames(frame);
    return std::ranges::count(names, name) > 0 ? name : "";
  }

  /// The baseline with the difference of the component as a field; nothing for what has no coefficients.
  static std::optional<FrameRecord> differenceFrame(const FieldComparison& field, const FrameRecord& actual,
                                                    const FrameRecord& baseline) {
    const auto valuesOf = [&](const FrameRecord& frame) -> std::optional<FieldRecord> {
      if (field.array == "displacement") return FieldRecord{{"x", "y", "z"}, "", frame.displacement};
      const auto found = frame.fields.find(field.array);
      return found == frame.fields.end() ? std::nullopt : std::optional(found->second);
    };
    const auto ours = valuesOf(actual), theirs = valuesOf(baseline);
    if (!ours || !theirs) return std::nullopt;
    const auto component = std::ranges::find(theirs->components, field.worst->component);
    const Eigen::Index row =
        field.worst->component.empty() ? 0 : std::distance(theirs->components.begin(), component);
    FrameRecord frame = baseline;
    FieldRecord difference = *theirs;
    difference.components.clear();
    difference.values = ours->values.row(row) - theirs->values.row(row);
    frame.fields[differenceOf(field)] = difference;
    return frame;
  }

  FieldPictures charts(const std::string& column) const {
    const HistoryTable actual = tableOf(actual_), baseline = tableOf(baseline_);
    const auto chartOf = [&](const std::string& title) {
      Chart chart;
      chart.x.title = "time";
      chart.y.title = title;
      chart.size = kPictureSize;
      return chart;
    };
    const auto curveOf = [&](const HistoryTable& table, const std::string& label, int dash) {
      return ChartCurve{label, table.column("time"), table.column(column), CurveStyle{dash, dash, -1}, false};
    };
    FieldPictures pictures;
    Chart both = chartOf(column);
    both.curves = {curveOf(baseline, "baseline", 0), curveOf(actual, "actual", 1)};
    pictures.actual = drawnBytes([&](const fs::path& file) { drawChart(both, file); });
    both.curves.resize(1);
    pictures.baseline = drawnBytes([&](const fs::path& file) { drawChart(both, file); });
    if (actual.column("time") == baseline.column("time")) {
      Chart difference = chartOf(differenceOf(column));
      difference.curves = {curveOf(actual, "", 0)};
      for (std::size_t k = 0; k < difference.curves.front().y.size(); ++k)
        difference.curves.front().y[k] -= baseline.column(column)[k];
      pictures.difference = drawnBytes([&](const fs::path& file) { drawChart(difference, file); });
    }
    return pictures;
  }

  static HistoryTable tableOf(const ResultReader& result) {
    return readHistory(result.file().parent_path() / "history.csv");
  }

  ResultReader actual_, baseline_;
};

class WorstPictures::FileDrawing : public PairDrawing {
 public:
  explicit FileDrawing(const DataPair& pair) : actual_(pair.actual), baseline_(pair.baseline) {}

  FieldPictures draw(const FieldComparison& field) const override {
    const std::array instants{instantAt(baseline_.times(), field.worst->time),
                              instantAt(actual_.times(), field.worst->time)};
    const std::array<const ForeignFile*, 2> files{&baseline_, &actual_};
    FieldPictures pictures;
    try {
      ForeignOptions options = optionsAt<ForeignOptions>(drawable(field, instants[0]), *field.worst);
      // A side without a finite value has no picture, and the other one has its own colours.
      std::array<std::optional<FrameView>, 2> views;
      std::vector<int> drawn;
      for (const int k : {0, 1}) {
        const auto side = static_cast<std::size_t>(k);
        try {
          views[side] = foreignView(*files[side], instants[side], options);
          drawn.push_back(k);
        } catch (const Error&) {
        }
      }
      shareView(options, drawn, drawn,
                [&](int k, bool, bool) { return *views[static_cast<std::size_t>(k)]; });
      for (const std::size_t side : {0U, 1U})
        if (views[side])
          (side == 0 ? pictures.baseline : pictures.actual) = drawnBytes(
              [&](const fs::path& png) { drawForeign(*files[side], {instants[side]}, options, {png}); });
      pictures.difference = differenceOn(0, instants, field, options);
      if (pictures.difference.empty()) pictures.difference = differenceOn(1, instants, field, options);
    } catch (const Error&) {
    }
    return pictures;
  }

 private:
  /// Whether there is no finite difference somewhere, so that there are no colours for how large it is.
  static bool isOneSided(const FieldComparison& field) { return std::isinf(field.worst->difference); }

  static std::string differenceName(const FieldComparison& field) {
    return isOneSided(field) ? "not finite on one side" : differenceOf(field);
  }

  /// Actual values minus the baseline's, or 1 where there is no finite difference and 0 elsewhere.
  static Eigen::VectorXd differencesOf(const FieldComparison& field, const Eigen::VectorXd& actual,
                                       const Eigen::VectorXd& baseline) {
    return actual.binaryExpr(baseline, [oneSided = isOneSided(field)](double a, double b) {
      if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
      if (!oneSided) return a - b;
      return std::isfinite(a - b) ? 0.0 : 1.0;
    });
  }

  /// Empty for points, whose places alone are shown.
  std::string drawable(const FieldComparison& field, int instant) const {
    if (field.array == kPoints) return "";
    const auto fields = foreignFieldsOf(baseline_.blocks(static_cast<std::size_t>(instant)));
    std::string array = field.array;
    if (std::ranges::count(fields, array, &ForeignField::name) == 0 && array.starts_with(kCells))
      array.erase(0, std::string(kCells).size());
    return withComponent(array, inLowerCase(field.worst->component));
  }

  /// Drawn on the cells of the baseline (0) or of the actual file (1); empty for what is no field of these.
  std::string differenceOn(std::size_t side, const std::array<int, 2>& instants, const FieldComparison& field,
                           const ForeignOptions& options) const {
    const auto theirs = baseline_.blocks(static_cast<std::size_t>(instants[0])),
               ours = actual_.blocks(static_cast<std::size_t>(instants[1]));
    std::optional<ForeignChoice> choice;
    if (!options.field.empty()) choice = findForeignField(foreignFieldsOf(theirs), options.field);
    if (!choice && field.array != kPoints) return "";
    const auto valuesOf = [&](const ForeignBlock& block) {
      return choice ? choice->valuesOf(block) : coordinatesOf(block, field.worst->component);
    };
    const std::string name = differenceName(field);
    std::vector<ForeignBlock> blocks;
    std::array<double, 2> range{0.0, 0.0};
    for (std::size_t k = 0; k < std::min(ours.size(), theirs.size()); ++k) {
      const ForeignBlock& block = side == 0 ? theirs[k] : ours[k];
      const Eigen::VectorXd actual = valuesOf(ours[k]), baseline = valuesOf(theirs[k]);
      const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
      grid->ShallowCopy(block.grid);
      if (actual.size() == baseline.size() && actual.size() > 0) {
        const Eigen::VectorXd values = differencesOf(field, actual, baseline);
        range = {std::min(range[0], values.minCoeff()), std::max(range[1], values.maxCoeff())};
        vtkDataSetAttributes* data = grid->GetPointData();
        if (choice && choice->field.ofCells) data = grid->GetCellData();
        for (vtkDataSetAttributes* all : {static_cast<vtkDataSetAttributes*>(grid->GetPointData()),
                                          static_cast<vtkDataSetAttributes*>(grid->GetCellData())})
          all->RemoveArray(name.c_str());
        data->AddArray(makeArray(name, values.transpose(), {}));
      }
      blocks.push_back({block.name, grid});
    }
    ForeignOptions own = options;
    own.field = name;
    own.note = isOneSided(field) ? field.name : "";
    own.colormap = "coolwarm";
    own.range = aboutZero(isOneSided(field) ? std::array{0.0, 1.0} : range);
    return drawnBytes([&](const fs::path& png) {
      drawBlocks(side == 0 ? baseline_ : actual_, instants[side], blocks, own, png);
    });
  }

  static Eigen::VectorXd coordinatesOf(const ForeignBlock& block, const std::string& axis) {
    const int component = static_cast<int>(std::string("xyz").find(axis));
    Eigen::VectorXd values(block.grid->GetNumberOfPoints());
    for (Eigen::Index k = 0; k < values.size(); ++k) values(k) = block.grid->GetPoint(k)[component];
    return values;
  }

  ForeignFile actual_, baseline_;
};

WorstPictures::WorstPictures(const std::vector<WorstField>& fields) {
  for (const WorstField& each : fields) {
    std::unique_ptr<PairDrawing>& drawing = drawings_[each.pair];
    if (drawing) continue;
    if (each.pair->kind == ComparedKind::Result)
      drawing = std::make_unique<RunDrawing>(*each.pair);
    else
      drawing = std::make_unique<FileDrawing>(*each.pair);
  }
}

WorstPictures::~WorstPictures() = default;

FieldPictures WorstPictures::draw(const WorstField& field) const {
  return drawings_.at(field.pair)->draw(*field.field);
}

}  // namespace burnish

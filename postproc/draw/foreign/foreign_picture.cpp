#include "postproc/draw/foreign/foreign_picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkThreshold.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/core/nearest.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/contour_subject.h"
#include "postproc/draw/contour/contour_view.h"
#include "postproc/draw/contour/gaps.h"
#include "postproc/draw/contour/shape_lines.h"
#include "postproc/draw/contour/value_parts.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/draw/foreign/foreign_percentiles.h"
#include "postproc/draw/foreign/foreign_surface.h"
#include "postproc/draw/foreign/linear_parts.h"
#include "postproc/draw/page/picture_warnings.h"
#include "postproc/draw/page/print_file.h"
#include "postproc/mesh/middle_triangles.h"
#include "postproc/mesh/plane_section.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;
using Faces = vtkSmartPointer<vtkPolyData>;

/// Throws `Error` for options that say something of a run alone.
void requireForeign(const ForeignOptions& options, const std::filesystem::path& file) {
  const auto refuse = [&](bool isGiven, const char* key, const char* why) {
    if (isGiven) throw Error(fmt::format("{}: {}; draw {} without it", key, why, file.string()));
  };
  refuse(options.controlNet, "control_net", "only bodies of burnish have control points");
  refuse(options.subdivision.has_value(), "subdivision", "only bodies of burnish have knot spans");
  refuse(options.arrows == ArrowField::Traction, "vectors", "only runs of burnish have contact tractions");
  refuse(options.threshold && !options.threshold->field.empty(), "threshold",
         "files of other programs are parted by the field that is drawn alone: leave its name out");
  refuse(options.clip && options.field.empty(), "clip", "no field is drawn, whose colours it would end");
  if (options.clip) checkPercentile(*options.clip);
  const std::string surfacesOf = options.isosurfaces ? options.isosurfaces->field : "";
  if (!surfacesOf.empty() && surfacesOf != options.field)
    throw Error(fmt::format(
        "isosurfaces: found {}; of files of other programs they are those of the field that is drawn, {}",
        surfacesOf, options.field));
}

/// The cells of a block with nothing but what is drawn, and what shapes curved cells.
Grid bareGrid(const ForeignBlock& block) {
  const auto grid = Grid::New();
  grid->CopyStructure(block.grid);
  if (vtkDataArray* degrees = block.grid->GetCellData()->GetHigherOrderDegrees())
    grid->GetCellData()->SetHigherOrderDegrees(degrees);
  if (vtkDataArray* weights = block.grid->GetPointData()->GetRationalWeights())
    grid->GetPointData()->SetRationalWeights(weights);
  if (vtkDataArray* ghosts = block.grid->GetCellData()->GetArray("vtkGhostType"))
    grid->GetCellData()->AddArray(ghosts);
  return grid;
}

/// No number where a value is not finite. vectors: whose lengths the values are, to be kept beside them; none if empty.
void setDrawn(vtkUnstructuredGrid& grid, const Eigen::VectorXd& values, bool ofCells,
              const Eigen::MatrixXd& vectors) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  vtkDataSetAttributes* data = grid.GetPointData();
  if (ofCells) data = grid.GetCellData();
  const Eigen::VectorXd drawn = values.array().isFinite().select(values, kNone);
  data->AddArray(makeArray("drawn", drawn.transpose(), {}));
  if (vectors.size() == 0) return;
  Eigen::MatrixXd kept = inSpace(vectors);
  for (Eigen::Index k = 0; k < kept.cols(); ++k)
    if (std::isnan(drawn(k))) kept.col(k).setConstant(kNone);
  data->AddArray(makeArray("drawn_vector", kept, {}));
}

/// Moves points by the displacements that the block has.
void warp(vtkUnstructuredGrid& grid, const ForeignBlock& block, const ForeignField& field, double factor) {
  vtkDataArray* array = block.grid->GetPointData()->GetArray(field.array.c_str());
  if (!array) return;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(grid.GetNumberOfPoints());
  for (vtkIdType k = 0; k < grid.GetNumberOfPoints(); ++k) {
    Eigen::Vector3d point;
    grid.GetPoint(k, point.data());
    for (int d = 0; d < std::min(3, array->GetNumberOfComponents()); ++d)
      point(d) += factor * array->GetComponent(k, d);
    points->SetPoint(k, point.data());
  }
  grid.SetPoints(points);
}

/// What is drawn of an instant: cells with the field, and cells without.
struct Cells {
  Grid with, without, undeformed;
};

/// Those of the first instant from a number on that has any.
std::vector<ForeignField> fieldsFrom(const ForeignFile& file, std::size_t first) {
  const std::size_t count = instantsOf(file).size();
  std::vector<ForeignField> fields;
  for (std::size_t k = first; k < count && fields.empty(); ++k) fields = foreignFieldsOf(file.blocks(k));
  return fields;
}

/// Parts of curved cells inside of bodies, where their values are looked at.
constexpr vtkIdType kMostInside = 100'000;

class SubjectMaker {
 public:
  SubjectMaker(const ForeignFile& file, int instant, const std::vector<ForeignBlock>& blocks,
               const ForeignOptions& options)
      : file_(file),
        options_(options),
        instant_(instant),
        blocks_(chosenBlocks(blocks, options.bodies)),
        fields_(foreignFieldsOf(blocks_)) {
    requireForeign(options, file.file());
  }

  /// Whether the instant has a field that is drawn.
  bool hasField() const { return choice_.has_value(); }

  /// Keeps for a warning at how many places of the file the field has no finite value.
  void noteGaps() const {
    if (numGaps_ == 0) return;
    const bool isOne = file_.times().size() < 2;
    burnish::noteGaps({fmt::format("{} of {}", options_.field, file_.file().string()),
                       choice_->field.ofCells ? "cells" : "points"},
                      {numGaps_, numPlaces_, isOne ? std::nullopt : std::optional(instant_)});
  }

  ContourSubject make() {
    ContourSubject subject;
    subject.title = file_.file().filename().string();
    if (!file_.times().empty()) subject.time = file_.times()[static_cast<std::size_t>(instant_)];
    if (options_.addedWarp != 0.0)
      subject.note = fmt::format("displacements × {:.6g} added", options_.addedWarp);
    if (!options_.field.empty()) choose(subject.field);
    chooseArrows();
    const Cells cells = collect(subject);
    if (cells.with->GetNumberOfCells() + cells.without->GetNumberOfCells() == 0)
      throw Error(
          fmt::format("{}: there are no faces or volumes in it, and so nothing that a picture can show",
                      file_.file().string()));
    if (choice_ && cells.with->GetNumberOfCells() == 0)
      throw Error(fmt::format("field: {} of {} is on no faces or volumes; a picture cannot show it",
                              options_.field, file_.file().string()));
    requireExtent({cells.with, cells.without});
    const bool isFlat = (cells.with->GetNumberOfCells() == 0 || isPlane(*cells.with)) &&
                        (cells.without->GetNumberOfCells() == 0 || isPlane(*cells.without));
    subject.dim = isFlat ? 2 : 3;
    // As `conflictsIn` does, but before lines are computed.
    if (options_.arrows == ArrowField::Streamlines && !isFlat && !options_.slice)
      throw Error(fmt::format(
          "vectors: found streamlines, which are drawn in a plane, and {} is a body in space: add slice",
          file_.file().string()));
    const ValuePlaces places = placesOf(*cells.with);
    subject.ranges.whole = subject.ranges.shown = rangeOf(places);
    if (options_.clip && choice_) subject.ranges.shown = clipped(cells.with, subject.ranges.whole);
    if (!choice_ && !options_.field.empty()) {
      subject.note = "no values";
      if (options_.range) {  // beside the scale of frames with values
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        subject.ranges = {{kNone, kNone}, *options_.range};
      }
    }
    const bool isBare = !choice_ && !options_.field.empty();  // a mesh, before what was computed on it
    subject.parts = options_.threshold && !isBare ? chosenParts(cells, subject) : partsOf(cells, subject);
    if (options_.isosurfaces && !isBare) chooseSurfaces(cells, subject);
    if ((options_.threshold || options_.isosurfaces) && !isBare)
      subject.chosenRange = [whole = subject.ranges.whole] { return whole; };
    subject.parts.mark = options_.mark;
    if (options_.markExtremes && choice_) {
      subject.parts.extremes = extremesOf(places, subject.dim);
      if (subject.parts.extremes)
        moveToSeen(*subject.parts.extremes, symmetriesOf(*choice_),
                   [&](const Eigen::Vector3d& place) { return isSeen(subject.parts, options_, place); });
    }
    return subject;
  }

 private:
  void choose(FieldChoice& words) {
    const std::vector<double>& times = file_.times();
    if (fields_.empty() && times.size() > 1) {  // a mesh, before what was computed on it
      words = wordsOf(chooseForeignField(fieldsFrom(file_, 0), options_.field));
      return;
    }
    choice_ = chooseForeignField(fields_, options_.field,
                                 times.size() < 2 ? "the file"
                                                  : fmt::format("frame {} (t = {:.6g})", instant_,
                                                                times[static_cast<std::size_t>(instant_)]));
    const ForeignField& field = choice_->field;
    if (field.ofCells && options_.isolines > 0)
      throw Error(fmt::format(
          "isolines: {} has one value per cell, between which there are no lines; draw it without",
          field.name));
    words = wordsOf(*choice_);
  }

  /// The field that arrows show; none of a mesh before what was computed on it.
  void chooseArrows() {
    if (options_.arrows == ArrowField::None || (fields_.empty() && file_.times().size() > 1)) return;
    const std::string file = file_.file().string();
    const bool isPrincipal = options_.arrows == ArrowField::Principal;
    if (choice_ && options_.arrows != ArrowField::Displacement &&
        (isPrincipal ? choice_->field.isTensor() : choice_->field.isVector())) {
      arrows_ = choice_->field;
      arrowName_ = arrows_->name;
      return;
    }
    if (options_.arrows == ArrowField::Field)
      throw Error(fmt::format(
          "vectors: found field, and {} of {}; draw one, or give displacement, principal or streamlines",
          options_.field.empty() ? "no field is drawn" : options_.field + " is no vector", file));
    const ForeignField* usual = isPrincipal ? stressAmong(fields_) : displacementAmong(fields_);
    if (!usual && isPrincipal)
      throw Error(fmt::format(
          "vectors: {} has no tensor with components xx, yy, ... called stress, cauchy_stress, stresses, s or "
          "sigma; draw a component of the tensor whose principal values are meant",
          file));
    if (!usual)
      throw Error(
          fmt::format("vectors: {} has no vector called displacement, displacements, disp, displ or u "
                      "at its points; {} along the vector that is drawn",
                      file, options_.arrows == ArrowField::Streamlines ? "streamlines go" : "field goes"));
    arrows_ = *usual;
    arrowName_ = isPrincipal ? "stress" : "displacement";
  }

  /// Gives the points of a grid what arrows show there.
  void setVectors(vtkUnstructuredGrid& grid, const ForeignBlock& block) const {
    if (!arrows_) return;
    const bool isPrincipal = options_.arrows == ArrowField::Principal;
    grid.GetPointData()->AddArray(isPrincipal ? makeArray("stress", tensorsAt(block, *arrows_), {})
                                              : makeArray("vectors", vectorsAt(block, *arrows_), {}));
  }

  Cells collect(ContourSubject& subject) {
    const ForeignField* displacement = displacementAmong(fields_);
    if (options_.addedWarp != 0.0 && displacement == nullptr && choice_)
      throw Error(fmt::format(
          "warp: {} has no vector called displacement, displacements, disp, displ or u at its points",
          file_.file().string()));
    std::vector<Grid> with, without, undeformed;
    const bool keepsVectors =
        choice_ && !choice_->field.ofCells && choice_->component < 0 && choice_->field.isVector() &&
        std::ranges::any_of(blocks_, [](const ForeignBlock& block) { return hasCurved(*block.grid); });
    for (const ForeignBlock& block : blocks_) {
      const Grid grid = bareGrid(block);
      if (options_.addedWarp != 0.0) {
        if (options_.undeformed) undeformed.push_back(bareGrid(block));
        if (displacement != nullptr) warp(*grid, block, *displacement, options_.addedWarp);
      }
      setVectors(*grid, block);
      const Eigen::VectorXd values = choice_ ? choice_->valuesOf(block) : Eigen::VectorXd();
      if (values.size() > 0) {
        numPlaces_ += values.size();
        numGaps_ += values.size() - values.array().isFinite().count();
        setDrawn(*grid, values, choice_->field.ofCells,
                 keepsVectors ? choice_->partsOf(block) : Eigen::MatrixXd());
        with.push_back(grid);
      } else {
        without.push_back(grid);
        if (choice_) subject.without.push_back(block.name);
      }
    }
    const Cells cells{shownCells(with), shownCells(without), shownCells(undeformed)};
    for (const MirrorPlane& plane : options_.mirror) requireEnd(plane, {cells.with, cells.without});
    return {mirrored(cells.with), mirrored(cells.without), cells.undeformed};
  }

  /// Throws `Error` for a plane in which what is shown does not end. A plane body on one side of x = 0 may be half of
  /// an axisymmetric one.
  void requireEnd(const MirrorPlane& plane, const std::vector<Grid>& grids) const {
    constexpr double kRounding = 1e-5;  // coordinates may have single precision, displacements added
    Eigen::AlignedBox3d box;
    bool isFlat = true;
    for (const Grid& grid : grids) {
      if (grid->GetNumberOfCells() == 0) continue;
      const double* b = grid->GetBounds();
      box.extend(Eigen::Vector3d(b[0], b[2], b[4])).extend(Eigen::Vector3d(b[1], b[3], b[5]));
      isFlat = isFlat && isPlane(*grid);
    }
    if (box.isEmpty()) return;
    const double low = box.min()(plane.axis), high = box.max()(plane.axis),
                 rounding = kRounding * box.diagonal().norm();
    const bool mayBeAxis = isFlat && plane.axis == 0 && plane.at == 0.0 && low >= -rounding;
    if (mayBeAxis || std::abs(low - plane.at) <= rounding || std::abs(high - plane.at) <= rounding) return;
    throw Error(fmt::format(
        "mirror: found the plane {0} = {1:.6g}; {2} goes from {0} = {3:.6g} to {0} = {4:.6g}; expected one of "
        "these ends",
        "xyz"[plane.axis], plane.at, file_.file().string(), low, high));
  }

  void requireExtent(const std::vector<Grid>& grids) const {
    double length = 0.0;
    for (const Grid& grid : grids) {
      for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k)
        if (!Eigen::Map<const Eigen::Vector3d>(grid->GetPoint(k)).allFinite())
          throw Error(fmt::format("{}: some of its points are not finite; it cannot be drawn",
                                  file_.file().string()));
      if (grid->GetNumberOfPoints() > 0) length = std::max(length, grid->GetLength());
    }
    if (length == 0.0)
      throw Error(fmt::format("{}: all its points are at one place; a picture cannot show it",
                              file_.file().string()));
  }

  Grid mirrored(Grid cells) const {
    for (const MirrorPlane& plane : options_.mirror)
      cells = shownCells(
          {cells, mirroredCells(*cells, plane, choice_ ? choice_->signInMirror(plane.axis) : 1.0)});
    return cells;
  }

  using ValuePlaces = std::vector<vtkSmartPointer<vtkPointSet>>;

  /// What has the values: the cells, and of curved ones the parts that are drawn. Where points have coefficients, parts
  /// inside take their place.
  static ValuePlaces placesOf(vtkUnstructuredGrid& cells) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (!hasCurved(cells)) return {&cells};
    const Faces faces = outerFaces(cells);
    if (!hasBezier(cells)) return {faces, &cells};
    if (isPlane(cells)) return {faces};
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(cells.GetNumberOfPoints());
    return {faces, linearParts(cells, nothing, {-kInfinite, kInfinite}, kMostInside)};
  }

  /// What is drawn at points or, if these have nothing, of cells; null without a field.
  static vtkDataArray* drawnOf(vtkPointSet& places) {
    vtkDataArray* ofPoints = places.GetPointData()->GetArray("drawn");
    return ofPoints ? ofPoints : places.GetCellData()->GetArray("drawn");
  }

  /// Of the finite values.
  std::array<double, 2> rangeOf(const ValuePlaces& places) const {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (places.front()->GetNumberOfCells() == 0) return {0.0, 1.0};
    std::array range{kInfinite, -kInfinite};
    for (const auto& some : places) {
      vtkDataArray* drawn = drawnOf(*some);
      for (vtkIdType k = 0; k < drawn->GetNumberOfTuples(); ++k) {
        const double value = drawn->GetComponent(k, 0);
        if (std::isfinite(value)) range = {std::min(range[0], value), std::max(range[1], value)};
      }
    }
    if (range[0] > range[1])
      throw Error(fmt::format("field {} of {} has no finite value{}; it cannot be drawn", options_.field,
                              file_.file().string(),
                              file_.times().size() < 2 ? "" : fmt::format(" in frame {}", instant_)));
    return range;
  }

  /// The range between the percentiles of `clip`, unless the field is constant but for a spot.
  std::array<double, 2> clipped(Grid cells, const std::array<double, 2>& whole) const {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (*options_.clip == 100.0 || cells->GetNumberOfCells() == 0) return whole;
    if (hasCurved(*cells))
      cells = linearParts(*cells, Eigen::VectorXd::Zero(cells->GetNumberOfPoints()), {-kInfinite, kInfinite},
                          kMostInside);
    vtkDataArray& drawn = *drawnOf(*cells);
    const Eigen::VectorXd sizes = sizesIn(*cells, choice_->field.ofCells);
    std::vector<double> values, weights;
    for (Eigen::Index k = 0; k < sizes.size(); ++k) {
      const double value = drawn.GetComponent(k, 0);
      if (sizes(k) == 0.0 || !std::isfinite(value)) continue;
      values.push_back(value);
      weights.push_back(sizes(k));
    }
    if (values.empty()) return whole;
    const auto asVector = [](const std::vector<double>& numbers) {
      return Eigen::Map<const Eigen::VectorXd>(numbers.data(), std::ssize(numbers));
    };
    const std::array<double, 2> range = percentiles(asVector(values), asVector(weights), *options_.clip);
    return range[0] < range[1] ? range : whole;
  }

  static Eigen::Vector3d middleOf(vtkCell& cell) {
    const double* bounds = cell.GetBounds();
    return 0.5 * Eigen::Vector3d(bounds[0] + bounds[1], bounds[2] + bounds[3], bounds[4] + bounds[5]);
  }

  /// Points, or middles of cells.
  static Eigen::Vector3d placeOf(vtkPointSet& places, vtkIdType tuple) {
    const bool ofCells = places.GetPointData()->GetArray("drawn") == nullptr;
    if (ofCells) return middleOf(*places.GetCell(tuple));
    return Eigen::Map<const Eigen::Vector3d>(places.GetPoint(tuple));
  }

  static std::optional<ExtremePlaces> extremesOf(const ValuePlaces& places, int dim) {
    ExtremePlaces result;
    std::optional<std::array<double, 2>> range;
    for (const auto& some : places) {
      vtkDataArray* drawn = drawnOf(*some);
      const auto tuples = drawn ? extremeTuples(*drawn) : std::nullopt;
      if (!tuples) continue;
      const bool isFirst = !range;
      if (isFirst) range.emplace();
      for (std::size_t end = 0; end < 2; ++end) {
        const double value = drawn->GetComponent((*tuples)[end], 0);
        const bool isMore = end == 0 ? value < (*range)[end] : value > (*range)[end];
        if (!isFirst && !isMore) continue;
        (*range)[end] = value;
        result.positions[end] = placeOf(*some, (*tuples)[end]);
        if (dim == 2) result.positions[end].z() = 0.0;
        result.drawn[end] = result.positions[end];
      }
    }
    if (!range) return std::nullopt;
    return result;
  }

  /// The mirrors in which the field is its own image.
  std::vector<MirrorPlane> symmetriesOf(const ForeignChoice& choice) const {
    std::vector<MirrorPlane> planes = options_.mirror;
    std::erase_if(planes, [&](const MirrorPlane& plane) { return choice.signInMirror(plane.axis) < 0.0; });
    return planes;
  }

  ContourParts partsOf(const Cells& cells, const ContourSubject& subject) const {
    ContourParts parts;
    const bool alongNormal = options_.slice && options_.view.name == "auto";
    parts.axes = alongNormal ? viewFrom(options_.slice->normal) : viewAxes(options_.view, subject.dim);
    const Faces faces = facesOf(*cells.with, subject.dim), plain = facesOf(*cells.without, subject.dim);
    const bool hasPlain = plain->GetNumberOfCells() > 0;
    parts.outline = edgesOf(*faces);
    if (hasPlain) parts.outline = together(*parts.outline, *edgesOf(*plain));
    if (options_.knots) {
      parts.knots = cellEdges(*faces);
      if (hasPlain) parts.knots = together(*parts.knots, *cellEdges(*plain));
    }
    if (cells.undeformed->GetNumberOfCells() > 0)
      parts.undeformed = edgesOf(*facesOf(*cells.undeformed, subject.dim));
    parts.body = trianglesAboutMiddles(*withDrawnScalars(*shaded(faces, subject.dim)));
    if (hasPlain) parts.plain = shaded(plain, subject.dim);
    for (const Faces& part : {faces, plain})
      if (part->GetNumberOfPoints() > 0) parts.box.extend(boxOf(*part));
    parts.eye = eyeOf(options_, parts, subject.dim);
    const Faces all = hasPlain ? together(*faces, *plain) : faces;
    if (options_.cut || options_.slice) cut(parts, cells, *all);
    if (arrows_) addArrowsTo(parts, *all, subject.dim);
    return parts;
  }

  /// faces: all that are seen before a cut.
  void addArrowsTo(ContourParts& parts, vtkPolyData& faces, int dim) const {
    Faces ground = shaded(&faces, dim);
    if (options_.slice) ground = parts.plain ? together(*parts.body, *parts.plain) : parts.body;
    if (options_.cut) {
      ground = behind(*ground, *parts.plane);
      for (const Faces& section : {parts.section, parts.plainSection})
        if (section) ground = together(*ground, *section);
    }
    if (vtkDataArray* vectors = ground->GetPointData()->GetArray("vectors"); vectors && dim == 2)
      vectors->FillComponent(2, 0.0);
    addArrows(parts,
              {.dim = dim, .surface = ground, .isOneSided = false, .name = arrowName_, .unit = arrows_->unit},
              *ground, options_);
  }

  /// Those of the cells where the drawn field lies between the ends of the threshold: cells are cut where points have
  /// the values, and left out whole where cells have them.
  ContourParts chosenParts(const Cells& cells, ContourSubject& subject) const {
    if (!choice_) throw Error("threshold: no field is drawn, whose values would choose; add field");
    const std::array<double, 2>& ends = options_.threshold->ends;
    subject.note = bandNote(*options_.threshold, subject.field.words, subject.field.unit);
    const ContourParts whole = partsOf(cells, subject);
    Cells chosen = cells;
    chosen.without = Grid::New();
    if (choice_->field.ofCells) {
      chosen.with = cellsBetween(*cells.with, ends);
    } else {
      if (numGaps_ > 0) chosen.with = cellsOfValues(*cells.with);
      if (hasCurved(*chosen.with)) chosen.with = partsBetween(*chosen.with, ends);
      chosen.with = cutAt(chosen.with, ends[0], false);
      chosen.with = cutAt(chosen.with, ends[1], true);
    }
    ContourParts parts = partsOf(chosen, subject);
    parts.box = whole.box;
    parts.eye = whole.eye;
    parts.plane = whole.plane;
    parts.undeformed = whole.undeformed;
    parts.ghost = whole.plain ? together(*whole.body, *whole.plain) : whole.body;
    parts.ghostOutline = whole.outline;
    return parts;
  }

  /// Surfaces on which the drawn field has one value, instead of the body. Only where points have values do these lie
  /// between cells.
  void chooseSurfaces(const Cells& cells, ContourSubject& subject) const {
    const std::string file = file_.file().string();
    if (!choice_) throw Error("isosurfaces: no field is drawn, which could have them; add field");
    if (choice_->field.ofCells)
      throw Error(fmt::format(
          "isosurfaces: {} has one value per cell, between which there are no surfaces; draw it without",
          choice_->field.name));
    if (options_.knots)
      throw Error(
          "knots: edges of cells are on the outside of a body, whose place isosurfaces take; draw without");
    int highest = 0;
    for (vtkIdType k = 0; k < cells.with->GetNumberOfCells(); ++k)
      highest = std::max(highest, cells.with->GetCell(k)->GetCellDimension());
    if (highest < 3)
      throw Error(fmt::format("isosurfaces: {} has no volumes with {}, in which they could be; take isolines",
                              file, choice_->field.name));
    const auto valuesOf = [this, whole = subject.ranges.whole](const std::array<double, 2>& range) {
      return options_.isosurfaces->of(isOneValue(whole) ? std::nullopt : std::optional(range));
    };
    subject.choiceNote = [valuesOf, words = subject.field.words,
                          unit = subject.field.unit](const std::array<double, 2>& range) {
      const std::vector<double> values = valuesOf(range);
      return values.empty() ? "" : surfacesNote(values, words, unit);
    };
    subject.choose = [this, valuesOf, volumes = cells.with](ContourParts& parts,
                                                            const std::array<double, 2>& range) {
      const auto left = [&](const Faces& part) { return options_.cut ? behind(*part, *parts.plane) : part; };
      parts.ghost = parts.plain ? together(*parts.body, *parts.plain) : parts.body;
      parts.ghostOutline = parts.outline;
      parts.plain = parts.section = parts.plainSection = parts.knots = nullptr;
      parts.body = left(shaded(surfacesIn(volumes, valuesOf(range)), 3));
      parts.outline = rimOf(*parts.body);
    };
  }

  /// Linear parts of cells, also of curved ones, where the drawn field may lie between two values.
  static Grid partsBetween(vtkUnstructuredGrid& cells, const std::array<double, 2>& ends) {
    vtkDataArray& drawn = *cells.GetPointData()->GetArray("drawn");
    Eigen::VectorXd values(drawn.GetNumberOfTuples());
    for (vtkIdType k = 0; k < values.size(); ++k) values(k) = drawn.GetComponent(k, 0);
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    // Lengths may be beyond those at all points of a cell.
    const bool areLengths = cells.GetPointData()->GetArray("drawn_vector") != nullptr;
    return linearParts(cells, values, areLengths ? std::array{-kInfinite, kInfinite} : ends);
  }

  /// Where the drawn field has these values.
  Faces surfacesIn(Grid volumes, const std::vector<double>& values) const {
    if (values.empty()) return Faces::New();
    if (numGaps_ > 0) volumes = cellsOfValues(*volumes);
    if (hasCurved(*volumes)) volumes = partsBetween(*volumes, {values.front(), values.back()});
    const Faces surfaces = levelsOf(*volumes, "drawn", values);
    surfaces->SetLines(nullptr);  // on faces that are no faces of volumes
    return surfaces;
  }

  static Grid cellsBetween(vtkUnstructuredGrid& cells, const std::array<double, 2>& ends) {
    return cellsBetween(cells, ends, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  }

  /// Those with a value at all their points.
  static Grid cellsOfValues(vtkUnstructuredGrid& cells) {
    constexpr double kMost = std::numeric_limits<double>::max();
    return cellsBetween(cells, {-kMost, kMost}, vtkDataObject::FIELD_ASSOCIATION_POINTS);
  }

  static Grid cellsBetween(vtkUnstructuredGrid& cells, const std::array<double, 2>& ends, int association) {
    vtkNew<vtkThreshold> threshold;
    threshold->SetInputData(&cells);
    threshold->SetInputArrayToProcess(0, 0, 0, association, "drawn");
    threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_BETWEEN);
    threshold->SetLowerThreshold(ends[0]);
    threshold->SetUpperThreshold(ends[1]);
    threshold->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    threshold->Update();
    return threshold->GetOutput();
  }

  /// What lies above a value, or below.
  static Grid cutAt(const Grid& cells, double value, bool below) {
    if (std::isinf(value) || cells->GetNumberOfCells() == 0) return cells;
    vtkNew<vtkTableBasedClipDataSet> clip;
    clip->SetInputData(cells);
    clip->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "drawn");
    clip->SetValue(value);
    clip->SetInsideOut(below);
    clip->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    clip->Update();
    return clip->GetOutput();
  }

  /// Of a plane mesh in the plane z = 0.
  static Faces facesOf(vtkUnstructuredGrid& cells, int dim) {
    const Faces faces = outerFaces(cells);
    if (dim == 3 || faces->GetNumberOfPoints() == 0) return faces;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->DeepCopy(faces->GetPoints());
    for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k) {
      const double* point = points->GetPoint(k);
      points->SetPoint(k, point[0], point[1], 0.0);
    }
    faces->SetPoints(points);
    return faces;
  }

  /// With normals in space, also where there is nothing.
  static Faces shaded(const Faces& faces, int dim) {
    if (dim == 2) return faces;
    if (faces->GetNumberOfCells() > 0) return withNormals(*faces);
    const auto nothing = Faces::New();
    nothing->SetPoints(vtkNew<vtkPoints>());
    nothing->GetPointData()->SetNormals(makeArray("normals", Eigen::MatrixXd(3, 0), {}));
    nothing->GetPointData()->SetScalars(makeArray("drawn", Eigen::MatrixXd(1, 0), {}));
    return nothing;
  }

  void cut(ContourParts& parts, const Cells& cells, vtkPolyData& faces) const {
    parts.plane = shownPlane(options_, parts);
    const Faces section = sectionWith(*cells.with, *parts.plane);
    const Faces plainSection = sectionWith(*cells.without, *parts.plane);
    const Faces border = sectionOf(faces, *parts.plane);
    if (border->GetNumberOfCells() == 0 && !options_.threshold) throw planeMisses(options_, parts, instant_);
    if (options_.slice) {
      if (section->GetNumberOfPolys() + plainSection->GetNumberOfPolys() == 0 && !options_.threshold)
        throw Error(fmt::format("slice: {} has no volumes to slice; take cut", file_.file().string()));
      parts.body = section;
      parts.plain = plainSection->GetNumberOfPolys() > 0 ? plainSection : nullptr;
      parts.outline = border;
      parts.knots = nullptr;
      parts.undeformed = nullptr;
      return;
    }
    if (options_.cutFace == CutFace::Hatch && !options_.threshold &&
        section->GetNumberOfPolys() + plainSection->GetNumberOfPolys() == 0)
      throw Error(fmt::format("cut_face: {} has no volumes, whose section could be hatched; draw it without",
                              file_.file().string()));
    if (parts.body->GetNumberOfPoints() > 0) parts.body = behind(*parts.body, *parts.plane);
    if (parts.plain) parts.plain = behind(*parts.plain, *parts.plane);
    if (section->GetNumberOfPolys() > 0) parts.section = section;
    if (plainSection->GetNumberOfPolys() > 0) parts.plainSection = plainSection;
    parts.outline = together(*behind(*parts.outline, *parts.plane), *border);
    for (Faces* lines : {&parts.knots, &parts.undeformed})
      if (*lines) *lines = behind(**lines, *parts.plane);
  }

  static Grid linearPartsAt(vtkUnstructuredGrid& cells, const CutPlane& plane) {
    Eigen::VectorXd heights(cells.GetNumberOfPoints());
    for (vtkIdType k = 0; k < heights.size(); ++k)
      heights(k) = plane.normal.dot(Eigen::Map<const Eigen::Vector3d>(cells.GetPoint(k)) - plane.point);
    return linearParts(cells, heights, {0.0, 0.0});
  }

  static Faces sectionWith(vtkUnstructuredGrid& cells, const CutPlane& plane) {
    const auto polygons = Faces::New();
    if (cells.GetNumberOfCells() == 0) return polygons;
    const Faces section =
        hasCurved(cells) ? sectionOf(*linearPartsAt(cells, plane), plane) : sectionOf(cells, plane);
    if (section->GetNumberOfPolys() == 0) return polygons;
    const Faces drawn = trianglesAboutMiddles(*withDrawnScalars(*section));
    polygons->SetPoints(drawn->GetPoints());
    polygons->SetPolys(drawn->GetPolys());
    polygons->GetPointData()->ShallowCopy(drawn->GetPointData());
    polygons->GetPointData()->SetNormals(
        makeArray("normals", plane.normal.replicate(1, drawn->GetNumberOfPoints()), {}));
    return polygons;
  }

  const ForeignFile& file_;
  const ForeignOptions& options_;
  int instant_;
  std::vector<ForeignBlock> blocks_;
  std::vector<ForeignField> fields_;
  std::optional<ForeignChoice> choice_;
  std::optional<ForeignField> arrows_;        ///< what arrows show
  std::string arrowName_;                     ///< what they call it
  Eigen::Index numGaps_ = 0, numPlaces_ = 0;  ///< points or cells without a finite value, and all
};

std::vector<ForeignBlock> blocksAt(const ForeignFile& file, int instant) {
  return file.blocks(static_cast<std::size_t>(instant));
}

/// Calls draw with the subject, and with what is left of the options for it, as its parts have what is added to its displacements.
template <class Draw>
auto drawn(const ForeignFile& file, int instant, const std::vector<ForeignBlock>& blocks,
           const ForeignOptions& options, const Draw& draw) {
  SubjectMaker maker(file, instant, blocks, options);
  const ContourSubject subject = maker.make();
  maker.noteGaps();
  ContourOptions own = options;
  own.warp = 1.0;
  own.markExtremes = options.markExtremes && maker.hasField();
  own.colorScale = options.colorScale && !options.field.empty() && (maker.hasField() || options.range);
  return draw(subject, own);
}

}  // namespace

std::vector<double> instantsOf(const ForeignFile& file) {
  return file.times().empty() ? std::vector<double>{0.0} : file.times();
}

std::string foreignFieldToShow(const ForeignFile& file, int first) {
  return foreignFieldToShow(fieldsFrom(file, static_cast<std::size_t>(first)));
}

void requireForeignFields(const ForeignFile& file, const std::vector<int>& instants,
                          const std::string& asked) {
  for (const int k : instants)
    if (!foreignFieldsOf(file.blocks(static_cast<std::size_t>(k))).empty()) return;
  chooseForeignField(
      {}, asked,
      instants.size() == 1 ? fmt::format("frame {}", instants.front()) : "what is drawn of the file");
}

FrameView foreignView(const ForeignFile& file, int instant, const ForeignOptions& options) {
  SubjectMaker maker(file, instant, blocksAt(file, instant), options);
  const ContourSubject subject = maker.make();
  FrameView view{.content = {}};
  if (maker.hasField()) {
    view.shown = subject.ranges.shown;
    view.extremes = subject.ranges.whole;
    view.passed = endsPassed(options.range.value_or(subject.ranges.shown), subject.ranges.whole);
  }
  view.hasNote = mayHaveNote(options) || !subject.without.empty() || !subject.note.empty();
  view.hasGaps = hasGaps(subject.parts);
  view.unit = subject.field.unit;
  view.show(subject.parts, subject.dim, options.eye);
  return view;
}

ForeignOptions withCommonView(ForeignOptions options, const ForeignFile& file,
                              const std::vector<int>& ofRange, const std::vector<int>& ofWindow) {
  shareView(options, ofRange, ofWindow,
            [&](int k, bool /*inRange*/, bool /*inWindow*/) { return foreignView(file, k, options); });
  return options;
}

ContourImage foreignImage(const ForeignFile& file, int instant, const ForeignOptions& options) {
  return drawn(
      file, instant, blocksAt(file, instant), options,
      [](const ContourSubject& subject, const ContourOptions& own) { return contourImage(subject, own); });
}

PrintPage foreignPage(const ForeignFile& file, int instant, const ForeignOptions& options) {
  return drawn(
      file, instant, blocksAt(file, instant), options,
      [](const ContourSubject& subject, const ContourOptions& own) { return contourPage(subject, own); });
}

void drawBlocks(const ForeignFile& file, int instant, const std::vector<ForeignBlock>& blocks,
                const ForeignOptions& options, const std::filesystem::path& name) {
  drawn(file, instant, blocks, options, [&](const ContourSubject& subject, const ContourOptions& own) {
    return drawContour(subject, own, name);
  });
}

void drawForeign(const ForeignFile& file, const std::vector<int>& instants, const ForeignOptions& options,
                 const std::vector<std::filesystem::path>& names) {
  if (isPrintFile(names.front())) {
    for (std::size_t k = 0; k < names.size(); ++k)
      writePrint(foreignPage(file, instants[k], options), names[k]);
    return;
  }
  drawInTurn(names, [&](std::size_t k) {
    throwIfInterrupted();
    return foreignImage(file, instants[k], options);
  });
}

}  // namespace burnish

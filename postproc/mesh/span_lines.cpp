#include "postproc/mesh/span_lines.h"

#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <vector>

#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

using Line = std::vector<vtkIdType>;

/// A place on a lattice: a span of every direction, and the steps into it.
struct LatticePlace {
  IndexBox::Index span{0, 0, 0}, local{0, 0, 0};

  /// Goes to the beginning of a span, or to the end of the last one.
  void goTo(std::size_t direction, int border, const PatchLattice& lattice) {
    const bool isEnd = border == lattice.spans.extent[direction];
    span[direction] = isEnd ? border - 1 : border;
    local[direction] = isEnd ? lattice.steps[direction] : 0;
  }
};

/// Calls `act` with the points of every line of a patch, span by span.
template <class Act>
void forEachLine(const PatchLattice& lattice, int dim, const Act& act) {
  for (std::size_t along = 0; along < static_cast<std::size_t>(dim); ++along) {
    const std::size_t a = (along + 1) % static_cast<std::size_t>(dim), b = dim == 3 ? (along + 2) % 3 : 2;
    const int ends = dim == 3 ? lattice.spans.extent[b] : 0;
    for (int i = 0; i <= lattice.spans.extent[a]; ++i)
      for (int j = 0; j <= ends; ++j) {
        const bool isInside = i > 0 && i < lattice.spans.extent[a] && j > 0 && j < ends;
        if (isInside) continue;
        LatticePlace place;
        place.goTo(a, i, lattice);
        if (dim == 3) place.goTo(b, j, lattice);
        std::vector<Line> spans;
        for (place.span[along] = 0; place.span[along] < lattice.spans.extent[along]; ++place.span[along]) {
          Line& span = spans.emplace_back();
          for (place.local[along] = 0; place.local[along] <= lattice.steps[along]; ++place.local[along])
            span.push_back(lattice.point(place.span, place.local));
        }
        act(spans);
      }
  }
}

/// The spans of a line as one.
Line joined(const std::vector<Line>& spans) {
  Line line{spans.front().front()};
  for (const Line& span : spans) line.insert(line.end(), span.begin() + 1, span.end());
  return line;
}

/// In VTK's order of a curve's points: the ends first.
Line endsFirst(const Line& span) {
  Line line{span.front(), span.back()};
  line.insert(line.end(), span.begin() + 1, span.end() - 1);
  return line;
}

/// The tuples of an array at these points.
vtkSmartPointer<vtkDataArray> tuplesOf(vtkDataArray& all, vtkIdList& points) {
  const auto chosen = vtk::TakeSmartPointer(all.NewInstance());
  chosen->SetName(all.GetName());
  chosen->SetNumberOfComponents(all.GetNumberOfComponents());
  for (int c = 0; c < all.GetNumberOfComponents(); ++c)
    if (const char* name = all.GetComponentName(c)) chosen->SetComponentName(c, name);
  chosen->SetNumberOfTuples(points.GetNumberOfIds());
  all.GetTuples(&points, chosen);
  return chosen;
}

/// Gathers lines and the points that they need.
class LineGrid {
 public:
  explicit LineGrid(const SpanPoints& points) : number_(static_cast<std::size_t>(points.size()), -1) {}

  void add(int type, Line line) {
    for (vtkIdType& point : line) {
      vtkIdType& number = number_[static_cast<std::size_t>(point)];
      if (number < 0) number = used_->InsertNextId(point);
      point = number;
    }
    grid_->InsertNextCell(type, static_cast<vtkIdType>(line.size()), line.data());
  }

  /// all: with the points and what they hold.
  vtkSmartPointer<vtkUnstructuredGrid> finish(vtkUnstructuredGrid& all) const {
    vtkNew<vtkPoints> points;
    points->SetData(tuplesOf(*all.GetPoints()->GetData(), *used_));
    grid_->SetPoints(points);
    vtkPointData& data = *all.GetPointData();
    for (int k = 0; k < data.GetNumberOfArrays(); ++k)
      grid_->GetPointData()->AddArray(tuplesOf(*data.GetArray(k), *used_));
    if (data.GetRationalWeights() != nullptr)
      grid_->GetPointData()->SetRationalWeights(tuplesOf(*data.GetRationalWeights(), *used_));
    return grid_;
  }

 private:
  std::vector<vtkIdType> number_;  ///< of each point of the body
  vtkNew<vtkIdList> used_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_ = vtkSmartPointer<vtkUnstructuredGrid>::New();
};

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> makeSpanLines(const SpanPoints& points, LineCells cells,
                                                   const FrameRecord& frame, const std::string& lengthUnit) {
  LineGrid lines(points);
  for (const PatchLattice& lattice : points.patches())
    forEachLine(lattice, points.dim(), [&](const std::vector<Line>& spans) {
      if (cells == LineCells::Polylines) return lines.add(VTK_POLY_LINE, joined(spans));
      for (const Line& span : spans) lines.add(VTK_BEZIER_CURVE, endsFirst(span));
    });
  vtkNew<vtkUnstructuredGrid> all;
  setPoints(*all, points, frame, true, lengthUnit);
  if (cells == LineCells::Bezier)
    all->GetPointData()->SetRationalWeights(makeArray("RationalWeights", points.weights().transpose(), {}));
  return lines.finish(*all);
}

}  // namespace burnish

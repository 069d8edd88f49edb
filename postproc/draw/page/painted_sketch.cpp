#include "postproc/draw/page/painted_sketch.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>
#include <vtkTexturedActor2D.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <variant>
#include <vector>

#include "postproc/draw/page/glyph_picture.h"
#include "postproc/draw/page/page_sketch.h"

namespace burnish {
namespace {

class SketchPainter {
 public:
  SketchPainter(vtkRenderer& renderer, int scale) : renderer_(renderer), scale_(scale) {}

  void operator()(const PageLines& lines) const {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    for (const PagePoints& line : lines.lines) addCell(line, *points, *cells);
    vtkNew<vtkPolyData> shape;
    shape->SetPoints(points);
    shape->SetLines(cells);
    add(*shape, lines.width, lines.color);
  }

  void operator()(const PageArea& area) const {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    addCell(area.corners, *points, *cells);
    vtkNew<vtkPolyData> shape;
    shape->SetPoints(points);
    shape->SetPolys(cells);
    add(*shape, 1.0, area.color);
  }

  void operator()(const PageStripes& stripes) const {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkUnsignedCharArray> cellColors;
    cellColors->SetNumberOfComponents(3);
    const PixelRect& rect = stripes.rect;
    const auto count = static_cast<vtkIdType>(stripes.colors.size());
    for (vtkIdType k = 0; k <= count; ++k) {
      const double part = static_cast<double>(k) / static_cast<double>(count);
      const bool right = stripes.direction == TextDirection::Right;
      const double x = scale_ * (rect.x + (right ? part * rect.width : 0.0));
      const double y = scale_ * (rect.y + (right ? 0.0 : part * rect.height));
      points->InsertNextPoint(x, y, 0.0);
      points->InsertNextPoint(right ? x : scale_ * rect.right(), right ? scale_ * rect.top() : y, 0.0);
    }
    for (vtkIdType k = 0; k < count; ++k) {
      cells->InsertNextCell({2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2});
      cellColors->InsertNextTypedTuple(stripes.colors[static_cast<std::size_t>(k)].data());
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(cells);
    data->GetCellData()->SetScalars(cellColors);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(data);
    mapper->SetScalarModeToUseCellData();
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    renderer_.AddActor2D(actor);
  }

  void operator()(const PageText& text) const {
    const Eigen::Vector2d along = unitAlong(text.direction), upwards(-along.y(), along.x());
    Eigen::Vector2d pen = text.at - shareBefore(text.anchor) * textWidth(text.text, text.style) * along;
    for (const TextPiece& piece : textPieces(text.text, text.style)) {
      if (isShaped(piece.piece))
        addGlyphs(piece, pen + piece.lift * upwards, text);
      else
        addPiece(piece, pen + piece.lift * upwards, text);
      pen += advance(piece) * along;
    }
  }

  /// Fields are of files for print: as images, whose pixels are not those of the picture, or as regions.
  void operator()(const PageImage& /*image*/) const {}
  void operator()(const PageRegion& /*region*/) const {}

 private:
  /// A cell that has all of these points.
  void addCell(const PagePoints& line, vtkPoints& points, vtkCellArray& cells) const {
    std::vector<vtkIdType> corners(line.size());
    std::iota(corners.begin(), corners.end(), points.GetNumberOfPoints());
    for (const Eigen::Vector2d& p : line) points.InsertNextPoint(scale_ * p.x(), scale_ * p.y(), 0.0);
    cells.InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  }

  void add(vtkPolyData& shape, double width, const Color& color) const {
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(&shape);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetLineWidth(static_cast<float>(scale_ * width));
    actor->GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
    renderer_.AddActor2D(actor);
  }

  void addPiece(const TextPiece& piece, const Eigen::Vector2d& baseline, const PageText& text) const {
    vtkNew<vtkTextActor> actor;
    actor->SetInput(piece.piece.text.c_str());
    vtkTextProperty& property = *actor->GetTextProperty();
    property.SetFontFamily(VTK_FONT_FILE);
    property.SetFontFile(piece.piece.font->file.c_str());
    property.SetFontSize(fontSize(piece.size, scale_));
    const Color& color = text.style.color;
    property.SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
    property.SetJustificationToLeft();
    property.SetVerticalJustificationToBottom();
    const double descent = piece.piece.font->descent * piece.size;
    const bool up = text.direction == TextDirection::Up;
    if (up) property.SetOrientation(90.0);
    actor->SetPosition(std::round(scale_ * (baseline.x() + (up ? descent : 0.0))),
                       std::round(scale_ * (baseline.y() - (up ? 0.0 : descent))));
    renderer_.AddActor2D(actor);
  }

  void addGlyphs(const TextPiece& piece, const Eigen::Vector2d& baseline, const PageText& text) const {
    const auto [pixels, corner] =
        glyphPicture(piece.piece.shaped, piece.piece.font->file, fontSize(piece.size, scale_),
                     text.style.color, text.direction == TextDirection::Up);
    const int* size = pixels->GetDimensions();
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkFloatArray> places;
    places->SetNumberOfComponents(2);
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      points->InsertNextPoint(x * size[0], y * size[1], 0.0);
      places->InsertNextTuple2(x, y);
    }
    cells->InsertNextCell({0, 1, 2, 3});
    vtkNew<vtkPolyData> shape;
    shape->SetPoints(points);
    shape->SetPolys(cells);
    shape->GetPointData()->SetTCoords(places);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(shape);
    vtkNew<vtkTexture> texture;
    texture->SetInputData(pixels);
    texture->InterpolateOff();
    vtkNew<vtkTexturedActor2D> actor;
    actor->SetMapper(mapper);
    actor->SetTexture(texture);
    actor->SetPosition(std::round(scale_ * baseline.x()) + corner.x(),
                       std::round(scale_ * baseline.y()) + corner.y());
    renderer_.AddActor2D(actor);
  }

  vtkRenderer& renderer_;
  int scale_;
};

}  // namespace

void paint(const PageSketch& sketch, vtkRenderer& renderer, int scale) {
  const SketchPainter painter(renderer, scale);
  for (const PageSketch::Shape& shape : sketch.shapes) std::visit(painter, shape);
}

}  // namespace burnish

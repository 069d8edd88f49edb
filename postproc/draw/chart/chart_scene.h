#pragma once
#include <vtkContextActor.h>
#include <vtkContextItem.h>

#include <functional>
#include <utility>

namespace burnish {

/// Paints in a scene of VTK, whatever that becomes: pixels or SVG.
class PaintedItem : public vtkContextItem {
 public:
  using Painting = std::function<void(vtkContext2D&)>;

  static PaintedItem* New();

  void paintWith(Painting painting) { painting_ = std::move(painting); }

  bool Paint(vtkContext2D* painter) override;

 private:
  Painting painting_;
};

/// Paints on the device of an exporter: the actor that VTK's factory gives needs an OpenGL context even then.
class ExportActor : public vtkContextActor {
 public:
  static ExportActor* New();

 private:
  void Initialize(vtkViewport* viewport) override;
};

}  // namespace burnish

#pragma once
#include <array>
#include <string>
#include <variant>

#include "postproc/scene/scene_document.h"
#include "postproc/study/figures/animation_figure.h"
#include "postproc/study/figures/composite_figure.h"
#include "postproc/study/figures/history_figure.h"
#include "postproc/study/figures/probe_figure.h"
#include "postproc/study/figures/refinement_figure.h"
#include "postproc/study/figures/roughness_figure.h"
#include "postproc/study/figures/setup_figure.h"
#include "postproc/study/figures/sheet_figure.h"
#include "postproc/study/figures/surface_figure.h"

namespace burnish {

/// The kinds of figures; what each has to say stands in figure.h.
using FigureKind = std::variant<HistoryFigure,     //
                                SurfaceFigure,     //
                                ProbeFigure,       //
                                RoughnessFigure,   //
                                RefinementFigure,  //
                                SheetFigure,       //
                                SetupFigure,       //
                                CompositeFigure,   //
                                AnimationFigure>;

struct FigureSpec {
  std::string name;     ///< of the file, and for --only
  std::string caption;  ///< in the document
  FigureKind what;
  PictureFormat format = PictureFormat::Png;  ///< that it has too
  PrintOptions print{};

  bool isForPrint() const { return format != PictureFormat::Png; }
};

template <class... Kinds>
std::array<Alternative, sizeof...(Kinds)> aboutKinds(const std::variant<Kinds...>&) {
  return {Kinds::about()...};
}

template <class Visitor>
void describe(Visitor& v, FigureSpec& s) {
  v.field("name", s.name, {.required = true, .identifier = true}, "Name of the file, and for --only.");
  v.field("caption", s.caption, {}, "Below the figure in the document.");
  v.field("format", s.format, {},
          "pdf or svg: a page for print beside the PNG, with vectors and text, 80 mm a panel or chart.");
  describe(v, s.print);
  v.alternatives("kind", s.what, aboutKinds(s.what), "What the figure shows.");
}

}  // namespace burnish

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <vtkImageData.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "postproc/draw/page/print_file.h"

namespace burnish {
namespace {

template <class T, void (*Free)(T*)>
struct CairoDeleter {
  void operator()(T* object) const { Free(object); }
};
template <class T, void (*Free)(T*)>
using CairoPtr = std::unique_ptr<T, CairoDeleter<T, Free>>;
using SurfacePtr = CairoPtr<cairo_surface_t, cairo_surface_destroy>;
using ContextPtr = CairoPtr<cairo_t, cairo_destroy>;
using FacePtrOfCairo = CairoPtr<cairo_font_face_t, cairo_font_face_destroy>;
using FontOptionsPtr = CairoPtr<cairo_font_options_t, cairo_font_options_destroy>;

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(fmt::format("cairo cannot make the PDF: {}", cairo_status_to_string(status)));
}

/// The pixels as cairo has them: the highest row first, colours times opacity in a number of 32 bits.
std::vector<std::uint32_t> premultiplied(vtkImageData& picture) {
  const int* size = picture.GetDimensions();
  const int channels = picture.GetNumberOfScalarComponents();
  std::vector<std::uint32_t> pixels;
  pixels.reserve(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]));
  for (int row = size[1] - 1; row >= 0; --row) {
    const auto* from = static_cast<const unsigned char*>(picture.GetScalarPointer(0, row, 0));
    for (int k = 0; k < size[0]; ++k, from += channels) {
      const std::uint32_t alpha = channels == 4 ? from[3] : 255;
      std::uint32_t pixel = alpha;
      for (int c = 0; c < 3; ++c) pixel = pixel << 8U | (from[c] * alpha + 127) / 255;
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

/// Paints a sketch on a page of cairo, whose y goes down.
class PdfPainter {
 public:
  PdfPainter(cairo_t& page, double height) : page_(page), height_(height) {
    const FontOptionsPtr options(cairo_font_options_create());
    // Letters stand where they belong on paper, not at whole pixels.
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(&page_, options.get());
  }

  void operator()(const PageLines& lines) {
    const Saved saved(page_);
    clip(lines.within);
    for (const PagePoints& line : lines.lines) addPath(line);
    setColor(lines.color, lines.opacity);
    cairo_set_line_width(&page_, lines.width);
    cairo_set_line_cap(&page_, lines.round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(&page_, lines.round ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
    cairo_stroke(&page_);
  }

  void operator()(const PageArea& area) {
    const Saved saved(page_);
    clip(area.within);
    addPath(area.corners);
    setColor(area.color);
    cairo_fill(&page_);
  }

  void operator()(const PageRegion& region) {
    const Saved saved(page_);
    clip(region.within);
    for (const PagePoints& loop : region.loops) {
      addPath(loop);
      cairo_close_path(&page_);
    }
    cairo_set_fill_rule(&page_, CAIRO_FILL_RULE_EVEN_ODD);
    setColor(region.color);
    cairo_fill(&page_);
  }

  void operator()(const PageStripes& stripes) {
    for (const auto& [rect, color] : overlapping(stripes)) {
      addPath({{rect.x, rect.y}, {rect.right(), rect.y}, {rect.right(), rect.top()}, {rect.x, rect.top()}});
      setColor(color);
      cairo_fill(&page_);
    }
  }

  void operator()(const PageText& text) {
    const std::vector<TextPiece> pieces = textPieces(text.text, text.style);
    double width = 0.0;
    for (const TextPiece& piece : pieces) width += choose(piece);
    const Saved saved(page_);
    cairo_translate(&page_, text.at.x(), height_ - text.at.y());
    if (text.direction == TextDirection::Up) cairo_rotate(&page_, -std::numbers::pi / 2);
    setColor(text.style.color);
    double pen = -shareBefore(text.anchor) * width;
    for (const TextPiece& piece : pieces) {
      const double length = choose(piece);
      cairo_move_to(&page_, pen, -piece.lift);
      cairo_show_text(&page_, piece.piece.text.c_str());
      pen += length;
    }
  }

  void operator()(const PageImage& image) {
    const int* size = image.pixels->GetDimensions();
    std::vector<std::uint32_t> pixels = premultiplied(*image.pixels);
    const bool opaque = image.pixels->GetNumberOfScalarComponents() == 3;
    const SurfacePtr surface(cairo_image_surface_create_for_data(
        reinterpret_cast<unsigned char*>(pixels.data()), opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32,
        size[0], size[1], 4 * size[0]));
    require(cairo_surface_status(surface.get()));
    const Saved saved(page_);
    cairo_translate(&page_, image.rect.x, height_ - image.rect.top());
    cairo_scale(&page_, image.rect.width / size[0], image.rect.height / size[1]);
    cairo_set_source_surface(&page_, surface.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(&page_), CAIRO_FILTER_NEAREST);
    cairo_paint(&page_);
    cairo_surface_finish(surface.get());  // a page that keeps it has copied the pixels
    require(cairo_status(&page_));
  }

 private:
  /// Undoes what is set on the page.
  class Saved {
   public:
    explicit Saved(cairo_t& page) : page_(page) { cairo_save(&page_); }
    ~Saved() { cairo_restore(&page_); }
    Saved(const Saved&) = delete;
    Saved& operator=(const Saved&) = delete;

   private:
    cairo_t& page_;
  };

  void addPath(const PagePoints& points) {
    for (std::size_t k = 0; k < points.size(); ++k)
      (k == 0 ? cairo_move_to : cairo_line_to)(&page_, points[k].x(), height_ - points[k].y());
    if (points.size() > 2 && points.front() == points.back()) cairo_close_path(&page_);
  }

  void clip(const std::optional<PixelRect>& within) {
    if (!within) return;
    cairo_rectangle(&page_, within->x, height_ - within->top(), within->width, within->height);
    cairo_clip(&page_);
  }

  void setColor(const Color& color, double opacity = 1.0) {
    cairo_set_source_rgba(&page_, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0, opacity);
  }

  /// Takes the font of a piece and returns the piece's length.
  double choose(const TextPiece& piece) {
    cairo_set_font_face(&page_, faceOf(*piece.piece.font));
    cairo_set_font_size(&page_, piece.size);
    cairo_text_extents_t extents{};
    cairo_text_extents(&page_, piece.piece.text.c_str(), &extents);
    return extents.x_advance;
  }

  cairo_font_face_t* faceOf(const Font& font) {
    FacePtrOfCairo& face = faces_[font.file];
    if (!face) {
      FcPattern* pattern = FcPatternBuild(nullptr, FC_FILE, FcTypeString, font.file.c_str(), nullptr);
      face.reset(cairo_ft_font_face_create_for_pattern(pattern));
      FcPatternDestroy(pattern);
      require(cairo_font_face_status(face.get()));
    }
    return face.get();
  }

  cairo_t& page_;
  double height_;
  std::map<std::string, FacePtrOfCairo> faces_;
};

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string pdfText(const PrintPage& page) {
  std::string text;
  const double scale = page.pointsPerPixel;
  const SurfacePtr surface(
      cairo_pdf_surface_create_for_stream(append, &text, scale * page.size[0], scale * page.size[1]));
  // No date: the same page has the same bytes.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, page.title.c_str());
  const ContextPtr context(cairo_create(surface.get()));
  cairo_scale(context.get(), scale, scale);
  PdfPainter painter(*context, page.size[1]);
  for (const PageSketch::Shape& shape : page.sketch.shapes) std::visit(painter, shape);
  require(cairo_status(context.get()));
  cairo_surface_finish(surface.get());
  require(cairo_surface_status(surface.get()));
  return text;
}

}  // namespace burnish

#include <cairo-pdf.h>
#include <vtkImageData.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "postproc/draw/page/cairo_handles.h"
#include "postproc/draw/page/print_file.h"

namespace burnish {
namespace {

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
  PdfPainter(cairo_t& page, double height) : page_(page), height_(height) { placeLettersExactly(page_); }

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
      if (isShaped(piece.piece)) {
        showGlyphs(piece, pen);
      } else if (!piece.piece.meant.empty()) {
        showLetters(piece, pen);
      } else {
        cairo_move_to(&page_, pen, -piece.lift);
        cairo_show_text(&page_, piece.piece.text.c_str());
      }
      pen += length;
    }
  }

  void operator()(const PageImage& image) {
    const int* size = image.pixels->GetDimensions();
    std::vector<std::uint32_t> pixels = premultiplied(*image.pixels);
    const bool opaque = image.pixels->GetNumberOfScalarComponents() == 3;
    const CairoSurface surface(cairo_image_surface_create_for_data(
        reinterpret_cast<unsigned char*>(pixels.data()), opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32,
        size[0], size[1], 4 * size[0]));
    requireCairo(cairo_surface_status(surface.get()));
    const Saved saved(page_);
    cairo_translate(&page_, image.rect.x, height_ - image.rect.top());
    cairo_scale(&page_, image.rect.width / size[0], image.rect.height / size[1]);
    cairo_set_source_surface(&page_, surface.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(&page_), CAIRO_FILTER_NEAREST);
    cairo_paint(&page_);
    cairo_surface_finish(surface.get());  // a page that keeps it has copied the pixels
    requireCairo(cairo_status(&page_));
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
    if (isShaped(piece.piece)) return piece.size * piece.piece.shaped.length;
    cairo_text_extents_t extents{};
    cairo_text_extents(&page_, piece.piece.text.c_str(), &extents);
    return extents.x_advance;
  }

  /// With the letters that they stand for, which can be searched.
  void showGlyphs(const TextPiece& piece, double pen) {
    const std::string& text = piece.piece.text;
    std::vector<cairo_glyph_t> glyphs;
    std::vector<cairo_text_cluster_t> clusters;
    const auto& shaped = piece.piece.shaped.glyphs;
    for (std::size_t k = 0; k < shaped.size(); ++k) {
      glyphs.push_back({shaped[k].index, pen + piece.size * shaped[k].at.x(),
                        -piece.lift - piece.size * shaped[k].at.y()});
      if (k == 0 || shaped[k].letter != shaped[k - 1].letter) clusters.push_back({0, 0});
      ++clusters.back().num_glyphs;
      const std::size_t next = k + 1 < shaped.size() ? shaped[k + 1].letter : text.size();
      clusters.back().num_bytes += static_cast<int>(next - shaped[k].letter);
    }
    cairo_show_text_glyphs(&page_, text.data(), static_cast<int>(text.size()), glyphs.data(),
                           static_cast<int>(glyphs.size()), clusters.data(),
                           static_cast<int>(clusters.size()), cairo_text_cluster_flags_t{});
  }

  /// With those that were written in place of the forms that are drawn.
  void showLetters(const TextPiece& piece, double pen) {
    const std::string& drawn = piece.piece.text;
    cairo_glyph_t* glyphs = nullptr;
    cairo_text_cluster_t* letters = nullptr;
    int numGlyphs = 0, numLetters = 0;
    cairo_text_cluster_flags_t flags{};
    requireCairo(cairo_scaled_font_text_to_glyphs(cairo_get_scaled_font(&page_), pen, -piece.lift,
                                                  drawn.data(), static_cast<int>(drawn.size()), &glyphs,
                                                  &numGlyphs, &letters, &numLetters, &flags));
    std::string meant;
    for (int k = 0; k < numLetters; ++k) {
      const std::string& written = piece.piece.meant[static_cast<std::size_t>(k)];
      letters[k].num_bytes = static_cast<int>(written.size());
      meant += written;
    }
    cairo_show_text_glyphs(&page_, meant.data(), static_cast<int>(meant.size()), glyphs, numGlyphs, letters,
                           numLetters, flags);
    cairo_glyph_free(glyphs);
    cairo_text_cluster_free(letters);
  }

  cairo_font_face_t* faceOf(const Font& font) {
    CairoFace& face = faces_[font.file];
    if (!face) face = cairoFace(font.file);
    return face.get();
  }

  cairo_t& page_;
  double height_;
  std::map<std::string, CairoFace> faces_;
};

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string pdfText(const PrintPage& page) {
  std::string text;
  const double scale = page.pointsPerPixel;
  const CairoSurface surface(
      cairo_pdf_surface_create_for_stream(append, &text, scale * page.size[0], scale * page.size[1]));
  // No date: the same page has the same bytes.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, page.title.c_str());
  const CairoContext context(cairo_create(surface.get()));
  cairo_scale(context.get(), scale, scale);
  PdfPainter painter(*context, page.size[1]);
  for (const PageSketch::Shape& shape : page.sketch.shapes) std::visit(painter, shape);
  requireCairo(cairo_status(context.get()));
  cairo_surface_finish(surface.get());
  requireCairo(cairo_surface_status(surface.get()));
  return text;
}

}  // namespace burnish

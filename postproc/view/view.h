#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/result_reader.h"
#include "postproc/draw/contour/picture_options.h"
#include "postproc/text/page.h"

namespace burnish {

/// What a page shows at first, and from where; the person in front of it changes most of it.
struct ViewOptions : PictureOptions {
  std::optional<ChosenTheme> pageTheme;  ///< light or dark as the browser is set when left out
  CutFace pageCutFace = CutFace::Field;  ///< what sections show
  double maxSize = 15.0;                 ///< of the page, in MB (10^6 bytes)
};

template <class Visitor>
void describe(Visitor& v, ViewOptions& s) {
  describeRange(v, s);
  describeBodies(v, s);
  describeMotion(v, s);
  describeEye(v, s);
  describeMirror(v, s);
  v.field(
      "theme", s.pageTheme, {},
      "Look of the page: paper, dark, slide, complas, or a YAML file with one of your own; light or dark as "
      "the browser is set when left out.");
  if constexpr (Fills<Visitor>)
    if (s.pageTheme) {
      s.theme = *s.pageTheme;
      static_cast<PictureDefaults&>(s) = s.theme.picture;
    }
  describe(v, static_cast<PictureDefaults&>(s));
  v.field("title", s.title, {.longest = kLongestShownText},
          "Title of the page, empty for none; that of the scene when left out.");
  v.field("cut_face", s.pageCutFace, {},
          "What the section of a cut shows: the field, or a hatch, which makes the page smaller (3D).");
  v.field("max_size", s.maxSize, {.above = 0, .atMost = 1000}, "Largest size of the page, in MB.");
}

/// A page that shows the bodies of these frames (ascending, at least one) with these fields, drawn from
/// their control coefficients by the reader's graphics card; without one it has a picture of the last frame. It
/// is one file that asks nothing of the network. fields: names as `PictureOptions::field` has them, the first
/// is shown at first; without any, those that are there of plastic strain, von Mises stress and displacement.
/// Colours of a field go over all of these frames. Throws `Error` for an unknown
/// field, warped or clipped ones of contact, values that are not finite, and a page above `maxSize`. html: the file of which such an
/// error tells.
HtmlPage viewPage(const ResultReader& result, const std::vector<int>& frames,
                  const std::vector<std::string>& fields, const ViewOptions& options,
                  const std::filesystem::path& html);

/// Writes this page. Returns the size in bytes. Throws `Error` as above, and for a file that cannot be written.
std::size_t writeView(const ResultReader& result, const std::vector<int>& frames,
                      const std::vector<std::string>& fields, const ViewOptions& options,
                      const std::filesystem::path& html);

}  // namespace burnish

#pragma once
#include <array>
#include <filesystem>
#include <string>

#include "postproc/draw/page/page_sketch.h"

namespace burnish {

/// A page for print.
struct PrintPage {
  std::array<double, 2> size{};  ///< width and height in pixels of the sketch
  std::string title;             ///< of the document; may be empty
  PageSketch sketch;
  double pointsPerPixel = 1.0;  ///< of the paper: a point is 1/72 inch
};

/// Whether a file is one for print: its name ends in .pdf or .svg.
bool isPrintFile(const std::filesystem::path& file);

/// Writes a page as PDF or SVG, by the ending of the name, under which the file appears only when it is
/// complete. Lines and areas are vectors, texts are texts: in a PDF their fonts are embedded; an SVG names them,
/// and what its reader has stands in for one that is missing. The same page has the same bytes. Throws `Error`
/// naming the file.
void writePrint(const PrintPage& page, const std::filesystem::path& file);

/// The contents of both.
std::string pdfText(const PrintPage& page);
std::string svgText(const PrintPage& page);

}  // namespace burnish

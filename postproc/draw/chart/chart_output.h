#pragma once
#include <filesystem>

#include "postproc/draw/chart/chart_sketch.h"
#include "postproc/draw/page/print_file.h"

namespace burnish {

/// Paints a sketch into a file that ends in .png, .svg or .pdf and appears under its name only when it is
/// complete. Throws `Error` for other endings and for a file that cannot be written.
void writeSketch(const ChartSketch& sketch, const std::filesystem::path& file);

/// The sketch as a page for print.
PrintPage pageOf(const ChartSketch& sketch);

}  // namespace burnish

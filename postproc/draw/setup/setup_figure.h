#pragma once
#include <array>
#include <filesystem>

#include "engine/results/result.h"
#include "postproc/draw/page/print_file.h"

namespace burnish {

/// Draws what the scene of a result says, as journals do: the undeformed body with its measures, supports
/// (hatching; rollers where one component is held), loads (of one that varies, the value in the middle), the
/// axis of an axisymmetric body, and the tools with their radius or name, what they carry, how far they turn,
/// and their motion, phase by phase; dashes show where they end. Black on white; text is 8 pt high when
/// `size` (pixels) is printed 80 mm wide. knots: with the lines between knot spans. Throws `Error` for a
/// model that is not 2D, a size out of range, and a file that cannot be written.
void drawSetup(const ModelRecord& model, const std::array<int, 2>& size, const std::filesystem::path& png,
               bool knots = false);

/// The same as a page for print, all of it vectors and text. Throws `Error` as `drawSetup` does.
PrintPage setupPage(const ModelRecord& model, const std::array<int, 2>& size, bool knots = false);

}  // namespace burnish

#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/draw/page/theme.h"

namespace burnish {

/// A picture of a sheet and what stands under it.
struct SheetPanel {
  std::filesystem::path picture;  ///< PNG
  std::string caption;            ///< may be empty
};

/// Lays pictures out in a grid, row by row, each with its caption below: the pictures of a column keep their
/// proportions and get the column's width. `width`: of the whole sheet in pixels; caption text is sized for a
/// column that is printed 80 mm wide, times that of the theme. below: PNG that stands below all of them, see
/// `sheetInnerWidth`; empty: none. Throws `Error` for unreadable pictures, no
/// panel, fewer than one column, and a file that cannot be written.
void drawSheet(const std::vector<SheetPanel>& panels, int columns, int width,
               const std::filesystem::path& png, const Theme& theme = {},
               const std::filesystem::path& below = {});

/// Width in pixels that a panel of such a sheet has: a picture of this width is copied as it is, any other is
/// resized. Throws `Error` for fewer than one column and a width that leaves no room.
int sheetPanelWidth(int columns, int width);

/// Width in pixels that a picture below all panels of such a sheet has. Throws as `sheetPanelWidth`.
int sheetInnerWidth(int columns, int width);

/// Text size in pixels that makes text of so many points in a panel of this width, printed 80 mm wide.
double sheetTextSize(int panelWidth, double points = 8.0);

}  // namespace burnish

#pragma once
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "postproc/draw/page/print_file.h"
#include "postproc/draw/page/theme.h"

class vtkImageData;

namespace burnish {

/// A picture of a sheet and what stands under it.
struct SheetPanel {
  std::variant<std::filesystem::path, vtkSmartPointer<vtkImageData>> picture;  ///< PNG, or its pixels
  std::string caption;                                                         ///< may be empty
};

/// The same of a sheet for print.
struct PrintPanel {
  PrintPage page;
  std::string caption;
};

/// Lays pictures out in a grid, row by row, each with its caption below: the pictures of a column keep their
/// proportions and get the column's width. `width`: of the whole sheet in pixels; caption text is sized for a
/// column that is printed 80 mm wide, times that of the theme. below: PNG that stands below all of them, see
/// `sheetInnerWidth`; empty: none. Throws `Error` for unreadable pictures, no
/// panel, fewer than one column, and a file that cannot be written.
void drawSheet(const std::vector<SheetPanel>& panels, int columns, int width,
               const std::filesystem::path& png, const Theme& theme = {},
               const std::filesystem::path& below = {});

/// Lays pages out as `drawSheet` lays out pictures of as many pixels, on paper on which a panel is 80 mm wide.
/// below: stands below all of them; null: none. Throws `Error` as `drawSheet` does.
PrintPage printSheet(const std::vector<PrintPanel>& panels, int columns, int width, const Theme& theme = {},
                     const PrintPage* below = nullptr);

/// Points on paper of a pixel of a sheet whose panels are so wide.
double sheetPointsPerPixel(int panelWidth);

/// A PNG as a page that is an image of its pixels. Throws `Error` naming the file.
PrintPage pageOfPicture(const std::filesystem::path& png);

/// Width in pixels that a panel of such a sheet has: a picture of this width is copied as it is, any other is
/// resized. Throws `Error` for fewer than one column and a width that leaves no room.
int sheetPanelWidth(int columns, int width);

/// Width in pixels that a picture below all panels of such a sheet has. Throws as `sheetPanelWidth`.
int sheetInnerWidth(int columns, int width);

/// Text size in pixels that makes text of so many points in a panel of this width, printed 80 mm wide.
double sheetTextSize(int panelWidth, double points = 8.0);

}  // namespace burnish

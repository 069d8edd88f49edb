#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/contour/contour_series.h"
#include "postproc/foreign/foreign_file.h"

/// Pictures of files of other programs.
namespace burnish {

/// How such a file is drawn.
struct ForeignOptions : ContourOptions {
  explicit ForeignOptions(const PictureOptions& picture = {}) : ContourOptions(picture) { ofOthers = true; }

  double addedWarp =
      0.0;  ///< points are moved by the file's displacements times this; the values keep theirs
};

/// Times of the file's instants; 0 for one without a time.
std::vector<double> instantsOf(const ForeignFile& file);

/// The field that is drawn from an instant on unless one is asked for, of the first that has any; empty where none has,
/// whose shape alone is drawn.
std::string foreignFieldToShow(const ForeignFile& file, int first);

/// Throws `Error` if none of these instants has fields: then there is none to ask for.
void requireForeignFields(const ForeignFile& file, const std::vector<int>& instants,
                          const std::string& asked);

/// The options with a range of colours and a window for several instants, as `withCommonView` has them. Throws
/// `Error` as `drawForeign` does.
ForeignOptions withCommonView(ForeignOptions options, const ForeignFile& file,
                              const std::vector<int>& ofRange, const std::vector<int>& ofWindow);

/// What one instant needs of what several share.
FrameView foreignView(const ForeignFile& file, int instant, const ForeignOptions& options);

/// One instant as a picture in memory, or as a page for print. Throws `Error` as `drawForeign` does.
ContourImage foreignImage(const ForeignFile& file, int instant, const ForeignOptions& options);
PrintPage foreignPage(const ForeignFile& file, int instant, const ForeignOptions& options);

/// Draws an instant with these blocks instead of its own into a file, as `drawForeign` does.
void drawBlocks(const ForeignFile& file, int instant, const std::vector<ForeignBlock>& blocks,
                const ForeignOptions& options, const std::filesystem::path& name);

/// Draws these instants, each into its file, as `drawSeries` does. Throws `Error` naming the file for what cannot be
/// read or drawn, and for options that belong to runs alone.
void drawForeign(const ForeignFile& file, const std::vector<int>& instants, const ForeignOptions& options,
                 const std::vector<std::filesystem::path>& names);

}  // namespace burnish

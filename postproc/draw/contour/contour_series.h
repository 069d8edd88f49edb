#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "engine/results/result_reader.h"
#include "postproc/draw/contour/contour.h"

/// Pictures of several frames, and what they share so that they can be compared.
namespace burnish {

/// How this frame of a result is drawn: with a mark if the run doubts its results and the options have marks;
/// without a field, what one most probably wants to see.
ContourOptions contourOptions(const PictureOptions& picture, const ResultReader& result,
                              const FrameRecord& frame);

/// The largest magnitude of the field in the run, looked for only where the bodies have not moved: there it may be
/// rounding. 0 where it need not be known.
double largestInRun(const ResultReader& result, const FrameRecord& frame, const std::string& field);

/// The range of values and of colours of one frame that is drawn like this.
FieldRange shownRanges(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options);

struct ContourParts;

/// Whether a picture with these options may have a small text below the body, whatever it shows.
bool mayHaveNote(const ContourOptions& options);

/// What one of several frames needs of what they share.
struct FrameView {
  std::optional<std::array<double, 2>> shown{};  ///< its range of colours, if it shows a field
  Eigen::AlignedBox2d content;  ///< what must be seen of it, projected in parallel or as the eye sees it
  double nearest = 0.0;         ///< see `nearestOf`
  std::string unit{};           ///< of the range; may be empty
  std::optional<std::array<double, 2>> extremes{};  ///< its smallest and largest value, if it shows a field
  bool hasNote = false;                             ///< whether it may have a small text below the body
  bool hasGaps = false;                             ///< whether its field has no value somewhere
  std::array<bool, 2> passed{};  ///< whether values pass the lower or the upper end of its colours

  /// That these parts, of a body of `dim` dimensions, must be seen, in parallel or by an eye.
  void show(ContourParts parts, int dim, const std::optional<Eye>& eye);
};

FrameView frameView(const ModelRecord& model, const FrameRecord& frame, const ContourOptions& options,
                    bool inRange, bool inWindow);

/// Throws `Error` that begins with a key and ends with a remedy if two units are not the same. Units may be empty.
void requireSameUnit(const char* key, const std::string& one, const std::string& other, const char* remedy);

/// Gives options a range of colours and a window for several frames, unless they have one: those that hold all
/// of the frames `ofRange`, and of the frames `ofWindow`; and the room that texts of the latter take. look: called once for
/// each, tells what is asked for; once more for the window as soon as perspective options have an eye.
/// Throws `Interrupted`, and `Error` for ranges of different units.
void shareView(ContourOptions& options, const std::vector<int>& ofRange, const std::vector<int>& ofWindow,
               const std::function<FrameView(int frame, bool inRange, bool inWindow)>& look);

/// Draws pictures into their files, one after the other. A picture is written while the next one is drawn.
void drawInTurn(const std::vector<std::filesystem::path>& names,
                const std::function<ContourImage(std::size_t number)>& draw);

/// The options with a range of colours and a window for several frames, unless they have one. The range goes
/// from the smallest to the largest value that one of the frames `ofRange` shows, or that `clip` leaves of
/// it; in the window, all of the frames `ofWindow` are seen whole. Each frame is read once. Throws `Error` as
/// `drawContour` does.
ContourOptions withCommonView(ContourOptions options, const ResultReader& result,
                              const std::vector<int>& ofRange, const std::vector<int>& ofWindow);

/// Draws these frames as `drawContour` does, each into its file. names: one per frame. Throws `Error` as
/// `drawContour` does.
void drawSeries(const ResultReader& result, const std::vector<int>& frames, const ContourOptions& options,
                const std::vector<std::filesystem::path>& names);

}  // namespace burnish

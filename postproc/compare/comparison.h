#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/compare/metric.h"

namespace burnish {

/// What counts: the structure of the picture and its colours, or the colours alone.
enum class Metric { Ssim, DeltaE };

/// "ssim" or "delta-e".
std::string metricName(Metric metric);

/// When pictures count as equal.
struct PictureRule {
  Metric metric = Metric::Ssim;
  /// Largest value of the metric of equal pictures, [0, 1]; docs/image-regression.md justifies it.
  double threshold = 0.15;
};

/// The value of a metric, 0 for equal pictures. `delta-e`: the share of visibly different pixels in the
/// window that has the most of them. `ssim`: that or the dissimilarity of the least similar window, whichever
/// is larger, because each is blind to what the other sees: structure to slightly other colours, colours to
/// faint patterns.
double metricValue(Metric metric, const PictureDifference& difference);

enum class PictureVerdict { Equal, Different, SizesDiffer, Blank, NoBaseline, NoActual, Unusable };

/// "equal", "different", "sizes-differ", "blank", "no-baseline", "no-actual", "unusable".
std::string verdictName(PictureVerdict verdict);

/// What became of one pair of pictures.
struct Comparison {
  std::string name;  ///< of the file, in the directory that was given
  std::filesystem::path actual, baseline;
  PictureVerdict verdict = PictureVerdict::Unusable;
  PictureDifference difference;  ///< for Equal and Different
  std::string message;           ///< one line: what is wrong, where and how much
};

/// Whether there were two pictures of the same size.
bool isMeasured(const Comparison& comparison);

/// Whether the actual picture may become the baseline of a pair of this verdict.
bool isAcceptable(PictureVerdict verdict);

/// Compares two files; never throws for what is in them. A blank picture is never equal to anything.
Comparison compareFiles(const std::string& name, const std::filesystem::path& actual,
                        const std::filesystem::path& baseline, const PictureRule& rule);

/// Compares two PNG files, or all PNG files below two directories, which are paired by name and sorted.
/// Throws `Error` if there is nothing at `actual`, if one path is a directory and the other is a file, and if
/// there are no pictures.
std::vector<Comparison> comparePictures(const std::filesystem::path& actual,
                                        const std::filesystem::path& baseline, const PictureRule& rule);

/// Copies actual pictures over their baselines, for the pairs that are different, of other sizes or without a
/// baseline and whose names match a pattern of the shell (*, ?), and compares these pairs again. Returns
/// their names. Throws `Error` for a pattern that no pair has, and for files that cannot be written.
std::vector<std::string> acceptActual(std::vector<Comparison>& comparisons,
                                      const std::vector<std::string>& patterns, const PictureRule& rule);

}  // namespace burnish

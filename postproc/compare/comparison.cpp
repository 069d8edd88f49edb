#include "postproc/compare/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <system_error>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "postproc/compare/baseline_place.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

std::string place(const PictureDifference& difference) {
  const PixelBox& box = difference.box;
  const std::string area =
      fmt::format("{} x {} at ({}, {}) from the upper left", box.width, box.height, box.left, box.top);
  if (difference.share > 0.0)
    return fmt::format("{:.2g} % of the pixels differ visibly, within {}", 100.0 * difference.share, area);
  return fmt::format("no pixel differs visibly by itself; the patterns differ most in {}", area);
}

/// PictureVerdict and message of two pictures that show something.
void judge(Comparison& comparison, const Picture& actual, const Picture& baseline, const PictureRule& rule) {
  if (actual.width != baseline.width || actual.height != baseline.height) {
    comparison.verdict = PictureVerdict::SizesDiffer;
    comparison.message = fmt::format("sizes differ: found {} x {}, the baseline has {} x {}", actual.width,
                                     actual.height, baseline.width, baseline.height);
    return;
  }
  comparison.difference = differenceOf(actual, baseline);
  const double value = metricValue(rule.metric, comparison.difference);
  const bool equal = value <= rule.threshold;
  comparison.verdict = equal ? PictureVerdict::Equal : PictureVerdict::Different;
  const std::string measured =
      fmt::format("{} {:.3g}, threshold {:.3g}", metricName(rule.metric), value, rule.threshold);
  if (equal)
    comparison.message = fmt::format("equal ({})", measured);
  else
    comparison.message = fmt::format("different ({}): {}", measured, place(comparison.difference));
}

bool isPicture(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending == ".png";
}

/// Names of the pictures below a directory, relative to it; none if it does not exist.
std::vector<std::string> pictureNames(const fs::path& directory) {
  std::vector<std::string> names;
  std::error_code error;
  if (!fs::exists(directory, error)) return names;
  for (fs::recursive_directory_iterator file(directory, error), end; !error && file != end;
       file.increment(error))
    if (isPicture(file->path()) && !file->is_directory(error))
      names.push_back(file->path().lexically_relative(directory).generic_string());
  if (error) throw Error(fmt::format("{}: {}", directory.string(), error.message()));
  return names;
}

std::vector<Comparison> compareDirectories(const fs::path& actual, const fs::path& baseline,
                                           const PictureRule& rule) {
  std::vector<std::string> names = pictureNames(actual);
  const std::vector<std::string> wanted = pictureNames(baseline);
  names.insert(names.end(), wanted.begin(), wanted.end());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  if (names.empty())
    throw Error(
        fmt::format("{}, {}: found nothing to compare; expected results or PNG files in at least one of them",
                    actual.string(), baseline.string()));
  std::vector<Comparison> comparisons;
  for (const std::string& name : names)
    comparisons.push_back(compareFiles(name, actual / name, baseline / name, rule));
  return comparisons;
}

}  // namespace

std::string metricName(Metric metric) {
  return metric == Metric::Ssim ? "ssim" : "delta-e";
}

double metricValue(Metric metric, const PictureDifference& difference) {
  if (metric == Metric::DeltaE) return difference.windowShare;
  return std::max(difference.dissimilarity, difference.windowShare);
}

std::string verdictName(PictureVerdict verdict) {
  static const std::map<PictureVerdict, std::string> names{{PictureVerdict::Equal, "equal"},
                                                           {PictureVerdict::Different, "different"},
                                                           {PictureVerdict::SizesDiffer, "sizes-differ"},
                                                           {PictureVerdict::Blank, "blank"},
                                                           {PictureVerdict::NoBaseline, "no-baseline"},
                                                           {PictureVerdict::NoActual, "no-actual"},
                                                           {PictureVerdict::Unusable, "unusable"}};
  return names.at(verdict);
}

bool isMeasured(const Comparison& comparison) {
  return comparison.verdict == PictureVerdict::Equal || comparison.verdict == PictureVerdict::Different;
}

bool isAcceptable(PictureVerdict verdict) {
  return verdict == PictureVerdict::Different || verdict == PictureVerdict::SizesDiffer ||
         verdict == PictureVerdict::NoBaseline;
}

Comparison compareFiles(const std::string& name, const fs::path& actual, const fs::path& baseline,
                        const PictureRule& rule) {
  Comparison comparison{name, actual, baseline, PictureVerdict::Unusable, {}, {}};
  std::error_code status;
  if (!fs::exists(actual, status)) {
    comparison.verdict = PictureVerdict::NoActual;
    comparison.message = fmt::format("missing: there is a baseline, but no {}", actual.string());
    return comparison;
  }
  try {
    const Picture picture = readPicture(actual);
    if (isBlank(picture)) {
      comparison.verdict = PictureVerdict::Blank;
      comparison.message = "blank: fewer than 1 of 1000 pixels have another colour than the rest";
    } else if (!fs::exists(baseline, status)) {
      comparison.verdict = PictureVerdict::NoBaseline;
      comparison.message = fmt::format("no baseline: there is no {}", baseline.string());
    } else {
      judge(comparison, picture, readPicture(baseline), rule);
    }
  } catch (const Error& error) {
    comparison.message = error.what();
  }
  return comparison;
}

std::vector<Comparison> comparePictures(const fs::path& actual, const fs::path& baseline,
                                        const PictureRule& rule) {
  std::error_code status;
  if (!fs::exists(actual, status))
    throw Error(fmt::format("{}: there is no such picture or directory", actual.string()));
  const bool directory = fs::is_directory(actual, status);
  if (fs::exists(baseline, status) && fs::is_directory(baseline, status) != directory)
    throw Error(fmt::format("{}: found a {}; expected a {} like {}", baseline.string(),
                            directory ? "file" : "directory", directory ? "directory" : "file",
                            actual.string()));
  if (directory) return compareDirectories(actual, baseline, rule);
  return {compareFiles(actual.filename().string(), actual, baseline, rule)};
}

std::vector<std::string> acceptActual(std::vector<Comparison>& comparisons,
                                      const std::vector<std::string>& patterns, const PictureRule& rule) {
  const auto matches = [](const std::string& pattern, const Comparison& comparison) {
    return ::fnmatch(pattern.c_str(), comparison.name.c_str(), 0) == 0;
  };
  std::vector<std::string> names;
  for (const Comparison& comparison : comparisons) names.push_back(comparison.name);
  for (const std::string& pattern : patterns)
    if (std::none_of(comparisons.begin(), comparisons.end(),
                     [&](const Comparison& comparison) { return matches(pattern, comparison); }))
      throw Error(fmt::format("--accept: found no picture \"{}\"; expected one of {}.{}", pattern,
                              fmt::join(names, ", "), didYouMean(pattern, names)));

  std::vector<Comparison*> chosen;
  for (Comparison& comparison : comparisons)
    if (isAcceptable(comparison.verdict) &&
        std::any_of(patterns.begin(), patterns.end(),
                    [&](const std::string& pattern) { return matches(pattern, comparison); }))
      chosen.push_back(&comparison);
  for (const Comparison* comparison : chosen)
    requireInBaselines(comparison->name, comparison->baseline, comparison->baseline);
  std::vector<std::string> accepted;
  for (Comparison* each : chosen) {
    Comparison& comparison = *each;
    writeText(readText(comparison.actual), comparison.baseline);
    comparison = compareFiles(comparison.name, comparison.actual, comparison.baseline, rule);
    accepted.push_back(comparison.name);
  }
  return accepted;
}

}  // namespace burnish

#pragma once
#include <optional>
#include <string>
#include <vector>

#include "postproc/study/figures/figure.h"

namespace burnish {

/// Every frame of each run as a picture, and as a video if ffmpeg is there.
struct AnimationFigure {
  std::vector<std::string> runs;
  PictureOptions picture = picturesOfSize({960, 480});
  double framesPerSecond = 5.0;

  static Alternative about();
  void check(const std::string& path, const StudyReporter& reporter) const;
  void checkReferences(const std::string& path, const RunReporter& reporter) const;
  void checkOutlooks(const std::string& path, const OutlookReporter& reporter) const;
  std::optional<double> clipOfAll() const { return picture.clip; }
  Files draw(const FigureTask& task) const;
};

template <class Visitor>
void describe(Visitor& v, AnimationFigure& s) {
  describeRuns(v, s.runs);
  describeField(v, s.picture);
  describeRange(v, s.picture);
  describe(v, s.picture);
  v.field("frames_per_second", s.framesPerSecond, {.above = 0, .atMost = 100}, "Speed of the video.");
}

}  // namespace burnish

#pragma once
#include <map>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "postproc/study/study_reporter.h"

namespace burnish {

/// What is known of the results of a run before it is computed.
struct RunOutlook {
  int dim = 0;                                       ///< 0: nothing is known at all
  std::vector<std::string> bodies;                   ///< names; empty for one body without a name
  std::map<std::string, std::string> missingFields;  ///< fields that frames will not have, with what is wrong
  std::vector<double> frameTimes;                    ///< empty: not known
  std::vector<std::string> columns;                  ///< of the history; empty: not known
};

/// What the scene alone says: all but the times of frames and the columns.
RunOutlook outlookOf(const Scene& scene);

/// Reports what figures and measures of a study ask for that results will not have. Of each kind of mistake with a value the
/// first run that has it is named.
class OutlookReporter : public RunReporter {
 public:
  /// outlooks: one for each run of the study.
  OutlookReporter(const Study& study, const std::vector<RunOutlook>& outlooks, const YamlNode& root,
                  Diagnostics& errors)
      : RunReporter(study, root, errors), outlooks_(outlooks) {}

  /// A formula in columns of the histories.
  void requireColumns(const std::string& path, const std::string& formula, const Runs& runs) const;

  void requireField(const std::string& path, const std::string& field, const Runs& runs) const;

  /// A frame, or one at each of the times; `kEndOfRun` is one of each run.
  void requireFrame(const std::string& path, double time, const Runs& runs) const;
  void requireFrames(const std::string& path, const std::vector<double>& times, const Runs& runs) const;

  void requireBodies(const std::string& path, const std::vector<std::string>& bodies, const Runs& runs) const;

  /// what: what needs two dimensions.
  void requirePlane(const std::string& path, const char* what, const Runs& runs) const;

  /// Options of a picture.
  void requirePicture(const std::string& path, const PictureOptions& picture, const Runs& runs,
                      const char* sizeKey) const;

  void requireMeasure(const std::string& path, const MeasureSpec& measure, const Runs& runs) const;

 private:
  const RunOutlook& of(const StudyRun& run) const;

  /// The runs that a measure compares with these.
  Runs othersOf(const std::string& other, const Runs& runs) const;

  const std::vector<RunOutlook>& outlooks_;
};

}  // namespace burnish

#include "cli/commands/probe_source.h"

#include <memory>
#include <system_error>

#include "engine/core/error.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/draw/foreign/foreign_picture.h"
#include "postproc/probe/foreign_probe.h"

namespace burnish {

ProbeSource probeSource(const std::filesystem::path& result) {
  std::error_code status;
  if (!std::filesystem::is_directory(result, status) && !foreignKind(result).empty()) {
    const auto file = std::make_shared<const ForeignFile>(result);
    return {
        file->file(),
        instantsOf(*file),
        [file](int frame, const ProbeSpec& spec) {
          return withFormula(probedInstant(*file, frame, spec), spec);
        },
        [file](const std::vector<int>& frames, const ProbeSpec& spec) {
          return withFormula(probedHistory(*file, frames, spec), spec);
        },
        [](int, const ProbeSpec&) -> DepthNumbers {
          throw Error("--numbers: only runs of burnish have faces with names; expected a run");
        },
        [](int, const CutPlane&, const std::vector<std::string>&) -> SectionNumbers {
          throw Error("--section: stresses of other programs are not integrated; expected a run of burnish");
        },
        {},
        {},
        [file](int frame) { return foreignFieldsOf(file->blocks(static_cast<std::size_t>(frame))).empty(); }};
  }
  const auto run = std::make_shared<const ResultReader>(result);
  return {
      run->file(),
      run->times(),
      [run](int frame, const ProbeSpec& spec) { return probedFrame(run->model(), run->frame(frame), spec); },
      [run](const std::vector<int>& frames, const ProbeSpec& spec) {
        return probedHistory(*run, frames, spec);
      },
      [run](int frame, const ProbeSpec& spec) { return depthNumbers(run->model(), run->frame(frame), spec); },
      [run](int frame, const CutPlane& plane, const std::vector<std::string>& bodies) {
        return sectionNumbers(run->model(), run->frame(frame), plane, bodies);
      },
      derivedUnits(run->model()),
      run->model().stressUnit};
}

}  // namespace burnish

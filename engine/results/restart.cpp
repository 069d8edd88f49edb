#include "engine/results/restart.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/results/file_header.h"
#include "engine/results/result_files.h"

namespace burnish::inline results {
namespace {

namespace fs = std::filesystem;

void writeMark(const hdf5::OutputGroup& root, const std::string& table, const TableMark& mark) {
  root.attribute(table + "_bytes", static_cast<double>(mark.bytes));
  root.attribute(table + "_fingerprint", mark.fingerprint);
}

std::vector<std::byte> restartImage(const RestartRecord& record, const std::string& modelId) {
  hdf5::OutputImage image;
  {
    const hdf5::OutputGroup root = image.root();
    writeHeader(root, "restart", modelId);
    root.attribute("step", record.step);
    root.attribute("frames", record.frames);
    writeMark(root, "history", record.history);
    writeMark(root, "convergence", record.convergence);
    const hdf5::OutputGroup state = root.group("state");
    for (const auto& [name, values] : record.state) state.dataset(name, values);
  }
  return image.finish();
}

TableMark readMark(const hdf5::InputGroup& root, const std::string& table) {
  const double size = root.real(table + "_bytes");
  constexpr double exact = 9007199254740992.0;
  if (!(size >= 0.0 && size <= exact))
    throw Error(fmt::format("{}: {}_bytes is {}", root.place(), table, size));
  return {static_cast<std::uint64_t>(size), root.text(table + "_fingerprint")};
}

RestartRecord readRestart(const fs::path& path, const StoredModel& model) {
  const hdf5::InputFile file(path);
  const hdf5::InputGroup root = file.root();
  if (readHeader(root, "restart") != model.id)
    throw Error(fmt::format("{} belongs to another run than the result file beside it", root.place()));
  RestartRecord record{.step = root.integer("step"),
                       .frames = root.integer("frames"),
                       .history = readMark(root, "history"),
                       .convergence = readMark(root, "convergence"),
                       .state = {}};
  const hdf5::InputGroup state = root.group("state");
  for (const std::string& name : state.names()) record.state[name] = state.dataset(name).vector();
  return record;
}

}  // namespace

void writeRestart(const fs::path& modelFile, const RestartRecord& record, const std::string& modelId) {
  writeFileAtomically(restartFile(modelFile, record.step), restartImage(record, modelId));
}

RestartRecord readNewestRestart(const fs::path& modelFile, const StoredModel& model) {
  std::string reason;
  for (const fs::path& file : restartFiles(modelFile)) {
    try {
      RestartRecord record = readRestart(file, model);
      // A record is written before its frame.
      if (record.frames <= countFrames(modelFile)) return record;
      if (reason.empty()) reason = fmt::format("{} belongs to a frame that is not there", file.string());
    } catch (const Error& error) {
      if (reason.empty()) reason = error.what();
    }
  }
  if (reason.empty())
    reason = "there is no restart record: the run had not written its first frame, or it came to its end";
  throw Error(fmt::format("{}: the run cannot be resumed: {}; compute its scene again",
                          modelFile.parent_path().string(), reason));
}

void removeRestartsBefore(const fs::path& modelFile, int step) {
  const fs::path first = restartFile(modelFile, step);
  for (const fs::path& file : restartFiles(modelFile))
    if (file.filename() < first.filename()) deleteFile(file);
}

}  // namespace burnish::inline results

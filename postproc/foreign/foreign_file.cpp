#include "postproc/foreign/foreign_file.h"

#include <SMP/Common/vtkSMPToolsAPI.h>  // vtkSMPTools.h is no C++20

#include <cstdint>
#include <optional>

#include "engine/core/reading_process.h"
#include "postproc/foreign/grid_stream.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// The question for the times; others are the numbers of instants.
constexpr std::int64_t kTimes = -1;

/// What the process that reads keeps between two questions: the file that was opened by the first of them.
ReadingProcess::Answer answerFrom(const fs::path& file) {
  // Here, once for all processes: VTK by the first of its functions, and its readers.
  vtk::detail::smp::vtkSMPToolsAPI::GetInstance();
  loadReaders();
  const auto source = std::make_shared<std::unique_ptr<ForeignSource>>();
  return [file, source](std::int64_t question) -> ReadingProcess::Send {
    if (!*source) {
      // TBB's threads are not in this process, and the locks that they had when it began are never given back.
      vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend("Sequential");
      *source = openForeign(file);
    }
    if (question == kTimes) return [times = (*source)->times()](const TakeBytes& take) { send(times, take); };
    return [blocks = (*source)->blocks(static_cast<std::size_t>(question))](const TakeBytes& take) {
      send(blocks, take);
    };
  };
}

}  // namespace

class ForeignFile::Reader {
 public:
  explicit Reader(const fs::path& file) : process_(file, answerFrom(file)) {
    process_.ask(kTimes, [this](const FillBytes& fill) { times_ = receiveNumbers(fill); });
  }

  const fs::path& file() const { return process_.file(); }
  const std::vector<double>& times() const { return times_; }

  const std::vector<ForeignBlock>& blocks(std::size_t instant) {
    if (instant != last_) {
      last_.reset();
      process_.ask(static_cast<std::int64_t>(instant),
                   [this](const FillBytes& fill) { blocks_ = receiveBlocks(fill); });
      last_ = instant;
    }
    return blocks_;
  }

 private:
  ReadingProcess process_;
  std::vector<double> times_;
  std::optional<std::size_t> last_;  ///< the instant of the blocks
  std::vector<ForeignBlock> blocks_;
};

ForeignFile::ForeignFile(const fs::path& file) : reader_(std::make_unique<Reader>(file)) {}

ForeignFile::~ForeignFile() = default;

const fs::path& ForeignFile::file() const {
  return reader_->file();
}

const std::vector<double>& ForeignFile::times() const {
  return reader_->times();
}

std::vector<ForeignBlock> ForeignFile::blocks(std::size_t instant) const {
  return reader_->blocks(instant);
}

}  // namespace burnish

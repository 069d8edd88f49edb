#include "cli/watch/followed_run.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <string>
#include <system_error>

#include "engine/core/error.h"
#include "engine/results/result_reader.h"
#include "engine/results/summary_file.h"
#include "postproc/scene/scene_document.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

std::string signOf(const fs::path& file) {
  struct ::stat about = {};
  if (::stat(file.c_str(), &about) != 0) return "-";
  return fmt::format("{} {} {}.{}", about.st_ino, about.st_size, about.st_mtim.tv_sec, about.st_mtim.tv_nsec);
}

/// The picture that was written last.
fs::path newestPicture(const fs::path& directory) {
  fs::path newest;
  fs::file_time_type latest;
  std::error_code status;
  for (fs::directory_iterator entry(directory, status), end; !status && entry != end;
       entry.increment(status)) {
    const std::string ending = entry->path().extension().string();
    if (ending != ".png" && ending != ".svg" && ending != ".pdf") continue;
    std::error_code gone;
    const auto written = entry->last_write_time(gone);
    if (gone || (!newest.empty() && written < latest)) continue;
    newest = entry->path();
    latest = written;
  }
  return newest;
}

/// The fourth number of the last whole row of `convergence.csv`.
std::optional<double> lastResidual(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(0, std::ios::end);
  const std::streamoff size = in.tellg();
  if (!in || size <= 0) return std::nullopt;
  const std::streamoff length = std::min<std::streamoff>(size, 1024);
  in.seekg(size - length);
  std::string end(static_cast<std::size_t>(length), '\0');
  in.read(end.data(), length);
  end.erase(end.rfind('\n') == std::string::npos ? 0 : end.rfind('\n'));
  std::string row = end.substr(end.rfind('\n') + 1);
  for (int k = 0; k < 3; ++k) row.erase(0, row.find(',') + 1);
  double residual = 0.0;
  const auto [rest, problem] = std::from_chars(row.data(), row.data() + row.size(), residual);
  return problem == std::errc() ? std::optional(residual) : std::nullopt;
}

}  // namespace

bool FollowedRun::hasBegun() const {
  std::error_code status;
  return fs::exists(directory_ / "result.h5", status);
}

bool FollowedRun::isHeld() const {
  struct ::stat about = {};
  if (::stat(directory_.c_str(), &about) != 0) return false;
  // 1: FLOCK  ADVISORY  WRITE 1234 08:01:5678 0 EOF
  const std::string inode = fmt::format(":{} ", about.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);)
    if (line.find("FLOCK") != std::string::npos && line.find(inode) != std::string::npos) return true;
  return false;
}

bool FollowedRun::look() {
  std::string signs;
  for (const char* file :
       {"summary.yaml", "history.csv", "convergence.csv", "result.h5", "result", "pictures"})
    signs += signOf(directory_ / file) + ";";
  const bool isNew = signs != seen_, hadProblem = !problem_.empty();
  if (!isNew && !hadProblem) return false;
  seen_ = signs;
  problem_.clear();
  // The summary first: if there is one, what is read after it is the end.
  read([&] {
    state_.account.reset();
    std::error_code status;
    if (fs::exists(directory_ / "summary.yaml", status)) state_.account = readSummary(directory_);
  });
  read([&] {
    if (!state_.endTime && hasBegun())
      state_.endTime = readResultDocument(directory_).scene.steps.back().until;
  });
  read([&] { state_.frames = hasBegun() ? ResultReader(directory_).times() : std::vector<double>(); });
  read([&] { readHistoryFile(); });
  state_.residual = lastResidual(directory_ / "convergence.csv");
  state_.picture = newestPicture(directory_ / "pictures");
  return isNew || problem_.empty();
}

void FollowedRun::read(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    if (problem_.empty()) problem_ = error.what();
  }
}

void FollowedRun::readHistoryFile() {
  std::error_code status;
  if (!fs::exists(directory_ / "history.csv", status)) return;
  state_.history = readHistory(directory_ / "history.csv");
  if (state_.history.numRows() == 0) return;
  state_.step = static_cast<int>(state_.history.column("step").back());
  state_.time = state_.history.column("time").back();
}

}  // namespace burnish

#include "postproc/export/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "engine/core/error.h"
#include "engine/results/atomic_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr double kHighestRate = 240.0;
constexpr std::size_t kLastWords = 600;  // bytes of ffmpeg's messages that are shown

/// A directory that goes away with its contents.
class ScratchDirectory {
 public:
  ScratchDirectory() {
    std::string name = (fs::temp_directory_path() / "burnish_video_XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw Error(fmt::format("cannot create a directory in {}: {}", fs::temp_directory_path().string(),
                              std::generic_category().message(errno)));
    path_ = name;
  }
  ~ScratchDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

enum class Outcome { Fine, Failed, Missing };

/// Runs ffmpeg with nothing to read; all it says goes to `log`.
Outcome runFfmpeg(std::vector<std::string> arguments, const fs::path& log) {
  arguments.insert(arguments.begin(), {"ffmpeg", "-nostdin", "-hide_banner"});
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const int problem = ::posix_spawnp(&process, "ffmpeg", &files, nullptr, pointers.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  if (problem == ENOENT) return Outcome::Missing;
  if (problem != 0)
    throw Error(fmt::format("cannot start ffmpeg: {}", std::generic_category().message(problem)));

  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR) throw Error("lost sight of ffmpeg while it was running");
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? Outcome::Fine : Outcome::Failed;
}

void checkArguments(const std::vector<fs::path>& frames, double framesPerSecond) {
  if (frames.empty()) throw Error("video: found no picture; expected at least one");
  if (!(framesPerSecond > 0.0 && framesPerSecond <= kHighestRate))
    throw Error(fmt::format("video: found {} pictures per second; expected more than 0, up to {}",
                            framesPerSecond, kHighestRate));
  for (const fs::path& frame : frames)
    if (!fs::is_regular_file(frame)) throw Error(fmt::format("{}: there is no such picture", frame.string()));
}

/// Links to the pictures, named by their numbers.
void linkFrames(const std::vector<fs::path>& frames, const ScratchDirectory& scratch) {
  for (std::size_t k = 0; k < frames.size(); ++k)
    fs::create_symlink(fs::absolute(frames[k]), scratch / fmt::format("{:06}.png", k));
}

std::vector<std::string> encoding(bool hasH264) {
  if (hasH264) return {"-c:v", "libx264", "-crf", "18", "-preset", "medium"};
  return {"-c:v", "mpeg4", "-q:v", "2"};
}

}  // namespace

bool writeVideo(const std::vector<fs::path>& frames, double framesPerSecond, const fs::path& mp4) {
  checkArguments(frames, framesPerSecond);
  const ScratchDirectory scratch;
  const fs::path log = scratch / "log";
  if (runFfmpeg({"-encoders"}, log) == Outcome::Missing) return false;
  const bool hasH264 = textOf(log).find(" libx264 ") != std::string::npos;

  linkFrames(frames, scratch);
  const fs::path partial = partialName(mp4);
  std::vector<std::string> arguments{
      "-loglevel", "error", "-y", "-framerate", fmt::format("{}", framesPerSecond), "-i",
      (scratch / "%06d.png").string(),
      // 4:2:0 has a colour sample for every 2 x 2 pixels.
      "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:white,format=yuv420p", "-fflags", "+bitexact", "-flags:v",
      "+bitexact", "-movflags", "+faststart"};
  const std::vector<std::string> encoder = encoding(hasH264);
  arguments.insert(arguments.end(), encoder.begin(), encoder.end());
  arguments.insert(arguments.end(), {"-f", "mp4", "file:" + partial.string()});
  std::error_code problem;
  if (runFfmpeg(arguments, log) == Outcome::Fine) {
    fs::rename(partial, mp4, problem);
    if (!problem) return true;
  }
  std::error_code ignored;
  fs::remove(partial, ignored);
  const std::string words = problem ? problem.message() : textOf(log);
  throw Error(fmt::format("cannot write the video {}: {}", mp4.string(),
                          words.substr(words.size() - std::min(words.size(), kLastWords))));
}

}  // namespace burnish

#include "postproc/export/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "postproc/export/scratch_directory.h"
#include "postproc/export/video_frames.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr double kHighestRate = 240.0;
constexpr std::size_t kLastWords = 600;  // bytes of ffmpeg's messages that are shown

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
  bool isTold = false;
  while (true) {
    const pid_t ended = ::waitpid(process, &status, WNOHANG);
    if (ended == process) break;
    if (ended < 0 && errno != EINTR) throw Error("lost sight of ffmpeg while it was running");
    if (interruption() != 0 && !std::exchange(isTold, true)) ::kill(process, SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? Outcome::Fine : Outcome::Failed;
}

}  // namespace

void checkFrames(const std::vector<fs::path>& frames, double framesPerSecond) {
  if (frames.empty()) throw Error("video: found no picture; expected at least one");
  if (!(framesPerSecond > 0.0 && framesPerSecond <= kHighestRate))
    throw Error(fmt::format("video: found {} pictures per second; expected more than 0, up to {}",
                            framesPerSecond, kHighestRate));
  for (const fs::path& frame : frames)
    if (!fs::is_regular_file(frame)) throw Error(fmt::format("{}: there is no such picture", frame.string()));
}

namespace {

/// Links to the pictures, named by their numbers.
void linkFrames(const std::vector<fs::path>& frames, const ScratchDirectory& scratch) {
  for (std::size_t k = 0; k < frames.size(); ++k)
    fs::create_symlink(fs::absolute(frames[k]), scratch.path() / fmt::format("{:06}.png", k));
}

std::vector<std::string> encoding(bool hasH264) {
  if (hasH264) return {"-c:v", "libx264", "-crf", "18", "-preset", "medium"};
  return {"-c:v", "mpeg4", "-q:v", "2"};
}

/// The end of what ffmpeg said, in which the file has the name that was asked for.
std::string lastWords(std::string words, const std::string& target, const std::string& name) {
  for (std::size_t at = 0; (at = words.find(target, at)) != std::string::npos; at += name.size())
    words.replace(at, target.size(), name);
  words.erase(words.find_last_not_of(" \n\r") + 1);
  return words.substr(words.size() - std::min(words.size(), kLastWords));
}

/// Lets ffmpeg make a file of these pictures. `how`: its options between the pictures and the file.
void encode(const std::vector<fs::path>& frames, double framesPerSecond, const ScratchDirectory& scratch,
            const std::vector<std::string>& how, const fs::path& file) {
  linkFrames(frames, scratch);
  const fs::path partial = partialName(file), log = scratch.path() / "log";
  std::vector<std::string> arguments{"-loglevel",
                                     "error",
                                     "-y",
                                     "-framerate",
                                     fmt::format("{}", framesPerSecond),
                                     "-i",
                                     (scratch.path() / "%06d.png").string()};
  arguments.insert(arguments.end(), how.begin(), how.end());
  const std::string target = "file:" + partial.string();
  arguments.push_back(target);
  std::error_code problem;
  fs::remove(partial, problem);  // ffmpeg would write through a symbolic link
  if (runFfmpeg(arguments, log) == Outcome::Fine) {
    fs::rename(partial, file, problem);
    if (!problem) return;
  }
  std::error_code ignored;
  fs::remove(partial, ignored);
  throwIfInterrupted();
  throw Error(fmt::format("cannot write the video {}: {}", file.string(),
                          problem ? problem.message() : lastWords(textOf(log), target, file.string())));
}

}  // namespace

bool haveFfmpeg() {
  return runFfmpeg({"-version"}, "/dev/null") != Outcome::Missing;
}

bool writeVideo(const std::vector<fs::path>& frames, double framesPerSecond, const fs::path& mp4) {
  checkFrames(frames, framesPerSecond);
  const ScratchDirectory scratch;
  const fs::path log = scratch.path() / "log";
  if (runFfmpeg({"-encoders"}, log) == Outcome::Missing) return false;
  const bool hasH264 = textOf(log).find(" libx264 ") != std::string::npos;
  // 4:2:0 has a colour sample for every 2 x 2 pixels.
  std::vector<std::string> how{"-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:white,format=yuv420p",
                               "-fflags",   "+bitexact",
                               "-flags:v",  "+bitexact",
                               "-movflags", "+faststart"};
  const std::vector<std::string> encoder = encoding(hasH264);
  how.insert(how.end(), encoder.begin(), encoder.end());
  how.insert(how.end(), {"-f", "mp4"});
  encode(frames, framesPerSecond, scratch, how, mp4);
  return true;
}

bool writeGif(const std::vector<fs::path>& frames, double framesPerSecond, const fs::path& gif) {
  checkFrames(frames, framesPerSecond);
  if (!haveFfmpeg()) return false;
  const ScratchDirectory scratch;
  encode(frames, framesPerSecond, scratch,
         {"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none", "-fflags",
          "+bitexact", "-loop", "0", "-f", "gif"},
         gif);
  return true;
}

}  // namespace burnish

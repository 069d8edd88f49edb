#pragma once
#include <filesystem>
#include <vector>

namespace burnish {

/// Whether the program ffmpeg, which videos and GIFs need, is in PATH.
bool haveFfmpeg();

/// Makes a video (MP4: H.264 where ffmpeg has it, else MPEG-4) from pictures of one size, each shown for
/// 1/framesPerSecond seconds; sides of odd length get one more row or column of white pixels. The file
/// appears under its name only when it is complete. Returns false, and writes nothing, where the program
/// ffmpeg is not in PATH. Throws `Error` for no or missing pictures, a rate outside (0, 240], and with its
/// last words if ffmpeg fails.
bool writeVideo(const std::vector<std::filesystem::path>& frames, double framesPerSecond,
                const std::filesystem::path& mp4);

/// The same as an endless GIF with the 256 colours that suit the pictures best.
bool writeGif(const std::vector<std::filesystem::path>& frames, double framesPerSecond,
              const std::filesystem::path& gif);

/// The same as an endless animated PNG, whose colours are those of the pictures; needs no other program. Also
/// throws `Error` for pictures of different sizes or kinds.
void writeAnimatedPng(const std::vector<std::filesystem::path>& frames, double framesPerSecond,
                      const std::filesystem::path& png);

}  // namespace burnish

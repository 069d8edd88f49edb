#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "postproc/export/video.h"
#include "postproc/export/video_frames.h"

/// An animated PNG is a PNG with a chunk acTL (number of frames and of rounds) before the first frame, a
/// chunk fcTL (place, size, duration) before each, and all frames but the first in chunks fdAT, which are
/// IDAT with a running number in front: https://www.w3.org/TR/png-3/#apng-frame-based-animation.
namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t kAround = 12;  // length, type and check sum of a chunk

std::string bigEndian(std::uint32_t number, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    text += static_cast<char>((number >> shift) & 255U);
  return text;
}

std::uint32_t numberAt(std::string_view text, std::size_t at) {
  std::uint32_t number = 0;
  for (const char c : text.substr(at, 4)) number = number << 8U | static_cast<unsigned char>(c);
  return number;
}

std::string chunk(const std::string& typeAndData) {
  const auto sum =
      ::crc32(0, reinterpret_cast<const Bytef*>(typeAndData.data()), static_cast<uInt>(typeAndData.size()));
  return bigEndian(static_cast<std::uint32_t>(typeAndData.size() - 4), 4) + typeAndData +
         bigEndian(static_cast<std::uint32_t>(sum), 4);
}

/// What an animation needs of a picture.
struct Frame {
  std::string header;  ///< data of IHDR
  std::string data;    ///< of all chunks IDAT
};

Frame readFrame(const fs::path& file) {
  std::ostringstream stream;
  stream << std::ifstream(file, std::ios::binary).rdbuf();
  const std::string bytes = stream.str();
  Frame frame;
  std::size_t at = kSignature.size();
  while (bytes.starts_with(kSignature) && at + kAround <= bytes.size()) {
    const std::size_t length = numberAt(bytes, at);
    if (at + kAround + length > bytes.size()) break;
    const std::string type = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, length);
    if (type == "IHDR") frame.header = data;
    if (type == "IDAT") frame.data += data;
    if (type == "IEND" && !frame.data.empty() && frame.header.size() == 13) return frame;
    at += kAround + length;
  }
  throw Error(fmt::format("{}: the PNG picture is damaged", file.string()));
}

/// Seconds as a fraction of 16-bit numbers.
std::string duration(double framesPerSecond) {
  constexpr int perSecond = 1000;
  return bigEndian(
             static_cast<std::uint32_t>(std::clamp(std::lround(perSecond / framesPerSecond), 1L, 65535L)),
             2) +
         bigEndian(perSecond, 2);
}

}  // namespace

void writeAnimatedPng(const std::vector<fs::path>& frames, double framesPerSecond, const fs::path& png) {
  checkFrames(frames, framesPerSecond);
  const std::string header = readFrame(frames.front()).header;
  std::string bytes(kSignature);
  bytes += chunk("IHDR" + header);
  bytes += chunk("acTL" + bigEndian(static_cast<std::uint32_t>(frames.size()), 4) + bigEndian(0, 4));
  std::uint32_t number = 0;
  for (const fs::path& file : frames) {
    const Frame frame = readFrame(file);
    if (frame.header != header)
      throw Error(
          fmt::format("{}: found another size or kind of picture than {}; they cannot be animated together",
                      file.string(), frames.front().string()));
    const std::string place = header.substr(0, 8) + std::string(8, '\0');  // whole picture
    // Disposal and blending 0: a frame stays until the next one replaces all of it.
    bytes +=
        chunk("fcTL" + bigEndian(number++, 4) + place + duration(framesPerSecond) + std::string(2, '\0'));
    bytes += number == 1 ? chunk("IDAT" + frame.data) : chunk("fdAT" + bigEndian(number++, 4) + frame.data);
  }
  bytes += chunk("IEND");
  writeFileAtomically(png, std::as_bytes(std::span(bytes)));
}

}  // namespace burnish

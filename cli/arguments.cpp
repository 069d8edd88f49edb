#include "cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "engine/core/drawable_range.h"
#include "engine/core/same_time.h"
#include "engine/scene/end_of_run.h"
#include "postproc/draw/page/picture_size.h"
#include "postproc/text/plain_time.h"

namespace burnish {
namespace {

/// The whole text as a number, or nothing.
template <class Number>
std::optional<Number> numberFrom(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// As many numbers with commas between them, or nothing.
template <class Number, std::size_t Count>
std::optional<std::array<Number, Count>> listFrom(std::string_view text) {
  std::array<Number, Count> list{};
  for (std::size_t k = 0; k < Count; ++k) {
    const std::size_t comma = k + 1 < Count ? text.find(',') : text.size();
    if (comma == std::string_view::npos) return std::nullopt;
    const auto number = numberFrom<Number>(text.substr(0, comma));
    if (!number) return std::nullopt;
    list[k] = *number;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return list;
}

int frameAtTime(double time, const std::vector<double>& times) {
  const auto nearest = std::min_element(times.begin(), times.end(), [=](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  const auto index = static_cast<int>(nearest - times.begin());
  if (isSameTime(*nearest, time)) return index;
  throw Error(fmt::format("--frame: there is no frame at t = {}; the nearest is frame {} at t = {}", time,
                          index, plainTime(*nearest)));
}

/// others: what --frame may be besides one frame; words: all that it may be, for the nearest.
int frameIndexOf(const std::string& text, const std::vector<double>& times, const char* others,
                 const std::vector<std::string>& words) {
  if (times.empty()) throw Error("the result has no frames yet");
  const int last = static_cast<int>(times.size()) - 1;
  if (isEndOfRun(text)) return last;
  if (text.starts_with("time=")) {
    if (isEndOfRun(text.substr(5))) return last;
    const auto time = numberFrom<double>(std::string_view(text).substr(5));
    if (time && std::isfinite(*time)) return frameAtTime(*time, times);
  }
  const auto index = numberFrom<int>(text);
  if (!index) {
    const std::string word = text.substr(0, text.find_first_of("0123456789."));
    throw Error(fmt::format("--frame: found \"{}\"; expected a number, last or end, or time=T{}.{}", text,
                            others, didYouMean(word, words)));
  }
  if (*index < 0 || *index > last)
    throw Error(fmt::format("--frame: there is no frame {}; the result has frames 0 to {}", *index, last));
  return *index;
}

}  // namespace

int frameIndex(const std::string& text, const std::vector<double>& times) {
  return frameIndexOf(text, times, "", {"last", "end", "time="});
}

namespace {

/// One frame, or several that follow one another.
std::vector<int> framesInARow(const std::string& text, const std::vector<double>& times) {
  std::string first = text, last = text;
  const std::size_t dash = text.starts_with("time=") ? text.find("-time=") : text.find('-', 1);
  if (text == "all") {
    first = "0";
    last = "last";
  } else if (dash != std::string::npos) {
    first = text.substr(0, dash);
    last = text.substr(dash + 1);
  }
  const auto index = [&](const std::string& one) {
    return frameIndexOf(one, times, "; or for several A-B, all, or a list with commas",
                        {"last", "end", "all", "time="});
  };
  const int begin = index(first), end = index(last);
  if (begin > end) throw Error(fmt::format("--frame: found \"{}\"; expected the smaller number first", text));
  std::vector<int> indices(static_cast<std::size_t>(end - begin + 1));
  std::iota(indices.begin(), indices.end(), begin);
  return indices;
}

}  // namespace

std::vector<int> frameIndices(const std::string& text, const std::vector<double>& times) {
  std::vector<int> indices;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    for (const int index : framesInARow(text.substr(begin, end - begin), times)) {
      if (!indices.empty() && index <= indices.back())
        throw Error(fmt::format(
            "--frame: found \"{}\"; expected every frame once, in the order of their times", text));
      indices.push_back(index);
    }
    begin = end + 1;
  }
  return indices;
}

std::vector<std::filesystem::path> pictureNames(const std::string& pattern, const std::vector<int>& frames,
                                                const std::vector<double>& times) {
  std::vector<std::filesystem::path> names;
  // A width of millions would fill the memory with zeros.
  if (std::regex_search(pattern, std::regex(R"(\{[^{}]*[0-9]{3}[^{}]*\})")))
    throw Error(
        fmt::format("-o: found \"{}\"; expected at most two digits for the width of a number, as in {}",
                    pattern, "frame_{frame:04}.png"));
  try {
    for (const int frame : frames)
      names.emplace_back(fmt::format(fmt::runtime(pattern), fmt::arg("frame", frame),
                                     fmt::arg("time", plainTime(times[static_cast<std::size_t>(frame)]))));
  } catch (const fmt::format_error& error) {
    throw Error(
        fmt::format("-o: found \"{}\" ({}); expected a name in which braces hold frame or time, as in {}",
                    pattern, error.what(), "frame_{frame:04}.png"));
  }
  if (std::set(names.begin(), names.end()).size() < names.size())
    throw Error(
        fmt::format("-o: found \"{}\" for {} frames; expected a name with the number of the frame, as in {}",
                    pattern, frames.size(), "frame_{frame:04}.png"));
  return names;
}

std::array<double, 2> rangeFromText(const char* option, const std::string& text,
                                    const std::vector<std::string>& words) {
  const auto range = listFrom<double, 2>(text);
  if (range && isDrawableRange(*range)) return *range;
  throw Error(fmt::format("{}: found \"{}\"; expected LO,HI: {}{}{}.{}", option, text, kDrawableRangeWords,
                          words.empty() ? "" : "; or ", fmt::join(words, ", "), didYouMean(text, words)));
}

std::string sizeWords() {
  return "W,H: pixels from " + pictureSizeWords();
}

std::array<int, 2> sizeFromText(const std::string& text) {
  const auto size = listFrom<int, 2>(text);
  if (size && isPictureSize(*size)) return *size;
  throw Error(fmt::format("--size: found \"{}\"; expected {}", text, sizeWords()));
}

std::string shellWord(const std::string& word) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

void requireNotInput(const char* option, const std::filesystem::path& output,
                     const std::vector<std::filesystem::path>& inputs) {
  namespace fs = std::filesystem;
  if (output.empty()) return;
  std::error_code absent;
  const auto place = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, absent), absent);
  };
  for (const fs::path& input : inputs) {
    if (input.empty()) continue;
    if (place(output) == place(input) || fs::equivalent(output, input, absent))
      throw Error(fmt::format("{}: {} is also read ({}) and would be overwritten; choose another name",
                              option, output.string(), input.string()));
  }
}

void requireDirectoryName(const char* option, const std::filesystem::path& directory) {
  const std::string& name = directory.string();
  if (name == "-")
    throw Error(fmt::format(
        "{}: found \"-\"; expected a directory: several files are written, which cannot be printed", option));
  if (name.starts_with("--"))
    throw Error(fmt::format("{}: found \"{}\"; expected a directory; one of such a name is written ./{}",
                            option, name, name));
}

void requireDocumentName(const std::filesystem::path& file) {
  if (file == "-")
    throw Error(
        "--document: found \"-\"; expected the name of a file: its pictures are written beside it, which cannot be printed");
}

void makeDirectoryOf(const std::filesystem::path& file) {
  const auto directory = file.parent_path();
  if (directory.empty()) return;
  std::error_code status;
  std::filesystem::create_directories(directory, status);
  if (status)
    throw Error(fmt::format("-o: cannot create the directory {}: {}", directory.string(), status.message()));
}

}  // namespace burnish

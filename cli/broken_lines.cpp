#include "cli/broken_lines.h"

#include <unistd.h>

#include <algorithm>
#include <limits>

#include "cli/console.h"

namespace burnish {

std::size_t lineColumns() {
  constexpr std::size_t least = 40;
  return ::isatty(STDOUT_FILENO) != 0 ? std::max(terminalColumns(), least)
                                      : std::numeric_limits<std::size_t>::max();
}

std::string brokenLine(std::string_view line, std::size_t indent, std::size_t columns) {
  std::string lines;
  std::size_t room = columns;
  while (line.size() > room) {
    std::size_t end = line.rfind(' ', room);
    if (end == std::string_view::npos) end = line.find(' ', room);
    if (end == std::string_view::npos) break;
    const std::size_t last = line.find_last_not_of(' ', end);
    lines.append(line.substr(0, last + 1)).append("\n").append(indent, ' ');
    line.remove_prefix(end + 1);
    room = columns - indent;
  }
  return lines.append(line);
}

std::string brokenText(std::string_view text) {
  std::string lines;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    lines += brokenLine(line, begin + 2, lineColumns()) + "\n";
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return lines;
}

}  // namespace burnish

#pragma once
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>

#include "postproc/text/text_file.h"
#include "tests/cli/shell.h"

/// Pages in a real browser. BURNISH_CHROMIUM is its path, or none where it is not installed.
namespace burnish {

inline bool haveBrowser() {
  return std::filesystem::exists(BURNISH_CHROMIUM);
}

/// WebGL needs a graphics card or Chromium's own software for one.
inline constexpr const char* kWebGl = "--enable-unsafe-swiftshader";

/// Opens a page with a script (HTML) behind it, which its policy then lets in, that uses the page as a person
/// does and writes what it finds into a last <pre>, whose text is `out`. `err` has a line with CONSOLE for
/// each error or warning of the page. Its time, of which there are 1000 s, runs through the page's timers while
/// pictures are being decoded, which takes real time. flags: more of the browser's.
inline Outcome usePage(const std::filesystem::path& dir, const std::filesystem::path& page,
                       const std::string& script, const std::string& flags = "") {
  std::string html = readText(page) + script;
  const auto replace = [&html](std::size_t at, const std::string& part, const std::string& replacement) {
    html.replace(at, part.size(), replacement);
  };
  replace(html.rfind("<script>"), "<script>", "<script nonce=\"test\">");
  replace(html.find("script-src "), "script-src ", "script-src 'nonce-test' ");
  writeText(html, dir / "used.html");
  Outcome outcome = shell(dir, "timeout 100 " BURNISH_CHROMIUM
                               " --headless --no-sandbox --disable-gpu --enable-logging=stderr"
                               " --virtual-time-budget=1000000 --user-data-dir=profile --dump-dom " +
                                   flags + " used.html");
  outcome.out.erase(0, std::min(outcome.out.rfind("<pre>"), outcome.out.size()));
  return outcome;
}

/// Errors and warnings of a page that was used; the driver's remarks on its speed are none.
inline std::string complaintsOf(const Outcome& page) {
  std::string complaints;
  std::istringstream lines(page.err);
  for (std::string line; std::getline(lines, line);)
    if (line.find("CONSOLE") != std::string::npos && line.find("GL Driver Message") == std::string::npos)
      complaints += line + "\n";
  return complaints;
}

}  // namespace burnish

#pragma once
#include <map>
#include <string>

namespace CLI {
class App;
}

namespace burnish {

/// The manual pages by their file names, such as `man1/burnish-run.1`: of the program, of every command that help lists, and of the
/// keys of scenes and studies. Made from what `--help` and `info --keys` are made from.
std::map<std::string, std::string> manualPages(const CLI::App& program);

}  // namespace burnish

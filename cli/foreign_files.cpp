#include "cli/foreign_files.h"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <system_error>

#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/result_files.h"

namespace burnish {

namespace fs = std::filesystem;

bool isOfARun(const fs::path& directory) {
  std::error_code absent;
  if (fs::exists(modelFile(directory), absent)) return true;
  try {
    return readHistory(directory / "history.csv").columns.front() == "step";
  } catch (const Error&) {
    return false;
  }
}

std::vector<fs::path> seriesFiles(const fs::path& directory) {
  std::vector<fs::path> files{directory / "frames.pvd", directory / "frames.py"};
  std::error_code absent;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory / "frames", absent))
    if (const fs::path extension = entry.path().extension();
        extension == ".vtu" || extension == ".vtp" || extension == ".pvtu")
      files.push_back(entry.path());
  return files;
}

bool hasSeries(const fs::path& directory) {
  std::ifstream collection(directory / "frames.pvd");
  std::string line;
  bool isCollection = false;
  while (std::getline(collection, line)) {
    if (line.find("<VTKFile type=\"Collection\"") != std::string::npos) isCollection = true;
    const std::size_t file = line.find(" file=\"");
    if (file != std::string::npos && line.compare(file, 14, " file=\"frames/") != 0) return false;
  }
  return isCollection;
}

void requireAbsent(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    std::error_code absent;
    if (fs::symlink_status(file, absent).type() != fs::file_type::not_found)
      throw Error(
          fmt::format("-o: {} is not of a run of burnish and would be overwritten; choose another directory, "
                      "or move it away",
                      file.string()));
  }
}

}  // namespace burnish

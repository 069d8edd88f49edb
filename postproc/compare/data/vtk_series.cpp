#include "postproc/compare/data/vtk_series.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/quoted.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

vtkSmartPointer<vtkXMLReader> readerOf(const fs::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".vtu") return vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  if (extension == ".vtp") return vtkSmartPointer<vtkXMLPolyDataReader>::New();
  throw Error(
      fmt::format("{}: found the ending {}; expected .vtu, .pvtu or .vtp", file.string(), quoted(extension)));
}

Error cannotBeRead(const fs::path& file) {
  return Error(fmt::format("{}: this is no VTK file of its ending, or it is damaged", file.string()));
}

/// `stress [MPa]` as name and unit.
std::pair<std::string, std::string> nameAndUnit(const std::string& text) {
  const std::size_t bracket = text.rfind(" [");
  if (bracket == std::string::npos || !text.ends_with("]")) return {text, ""};
  return {text.substr(0, bracket), text.substr(bracket + 2, text.size() - bracket - 3)};
}

DataArray arrayOf(vtkDataArray& array, const std::string& prefix) {
  const auto [name, unit] = nameAndUnit(array.GetName());
  DataArray result{prefix + name, unit, {}, {}};
  result.values.resize(array.GetNumberOfComponents(), array.GetNumberOfTuples());
  for (int k = 0; k < array.GetNumberOfComponents(); ++k) {
    if (const char* component = array.GetComponentName(k)) result.components.emplace_back(component);
    for (vtkIdType place = 0; place < array.GetNumberOfTuples(); ++place)
      result.values(k, place) = array.GetComponent(place, k);
  }
  return result;
}

/// Arrays of numbers with names; texts are left out.
void addArrays(DataPart& part, vtkDataSetAttributes& data, const std::string& prefix) {
  for (int k = 0; k < data.GetNumberOfArrays(); ++k) {
    vtkDataArray* numbers = data.GetArray(k);
    if (!numbers || !numbers->GetName() || numbers->GetNumberOfTuples() != part.numPlaces) continue;
    DataArray array = arrayOf(*numbers, prefix);
    while (std::ranges::count(part.arrays, array.name, &DataArray::name)) array.name += "_2";
    part.arrays.push_back(std::move(array));
  }
}

DataPart pointPart(vtkDataSet& data) {
  DataPart part{.name = "points", .place = "point", .numPlaces = data.GetNumberOfPoints()};
  part.positions.resize(3, part.numPlaces);
  for (vtkIdType point = 0; point < part.numPlaces; ++point)
    data.GetPoint(point, part.positions.col(point).data());
  part.arrays.push_back({"points", "", {"x", "y", "z"}, part.positions});
  addArrays(part, *data.GetPointData(), "");
  return part;
}

DataPart cellPart(vtkDataSet& data, const std::vector<std::vector<vtkIdType>>& corners,
                  const Eigen::MatrixXd& points) {
  DataPart part{.name = "cells", .place = "cell", .numPlaces = data.GetNumberOfCells()};
  part.positions = Eigen::MatrixXd::Zero(3, part.numPlaces);
  Eigen::MatrixXd types(1, part.numPlaces), sizes(1, part.numPlaces);
  for (vtkIdType cell = 0; cell < part.numPlaces; ++cell) {
    const std::vector<vtkIdType>& own = corners[static_cast<std::size_t>(cell)];
    types(0, cell) = data.GetCellType(cell);
    sizes(0, cell) = static_cast<double>(own.size());
    if (!own.empty()) part.positions.col(cell) = points(Eigen::all, own).rowwise().mean();
  }
  part.arrays = {{"cells.type", "", {}, std::move(types), true},
                 {"cells.size", "", {}, std::move(sizes), true}};
  addArrays(part, *data.GetCellData(), "cells.");
  return part;
}

DataPart cornerPart(const std::vector<std::vector<vtkIdType>>& corners) {
  DataPart part{.name = "cells.corners", .place = "corner"};
  std::vector<double> points;
  for (std::size_t cell = 0; cell < corners.size(); ++cell) {
    part.owners.push_back(fmt::format("cell {}", cell));
    part.ownerOf.insert(part.ownerOf.end(), corners[cell].size(), static_cast<int>(cell));
    points.insert(points.end(), corners[cell].begin(), corners[cell].end());
  }
  part.numPlaces = std::ssize(points);
  part.arrays = {
      {"cells.corners", "", {}, Eigen::Map<Eigen::RowVectorXd>(points.data(), part.numPlaces), true}};
  return part;
}

/// Points of every cell. Throws `Error` for a point that is not there.
std::vector<std::vector<vtkIdType>> cornersOf(vtkDataSet& data, const fs::path& file) {
  std::vector<std::vector<vtkIdType>> corners;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data.GetNumberOfCells(); ++cell) {
    data.GetCellPoints(cell, ids);
    corners.emplace_back(ids->begin(), ids->end());
    for (const vtkIdType id : corners.back())
      if (id < 0 || id >= data.GetNumberOfPoints()) throw cannotBeRead(file);
  }
  return corners;
}

/// Throws `Error` for a file that was cut off: its last values may be missing without a word of the reader.
void requireEnd(const fs::path& file) {
  constexpr std::streamoff kTail = 100;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  stream.seekg(std::max<std::streamoff>(stream.tellg() - kTail, 0));
  const std::string tail{std::istreambuf_iterator<char>(stream), {}};
  if (tail.find("</VTKFile>") == std::string::npos) throw cannotBeRead(file);
}

std::string textIn(vtkXMLDataElement& element, const char* attribute) {
  const char* text = element.GetAttribute(attribute);
  return text ? text : "";
}

vtkSmartPointer<vtkXMLDataElement> rootOf(const fs::path& file) {
  std::error_code status;
  if (!fs::exists(file, status)) throw Error(fmt::format("{}: there is no such file", file.string()));
  return vtk::TakeSmartPointer(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
}

/// The files that a `.pvtu` file names. VTK's reader of it is silent about damaged ones.
std::vector<fs::path> piecesOf(const fs::path& file) {
  const vtkSmartPointer<vtkXMLDataElement> root = rootOf(file);
  vtkXMLDataElement* grid = root ? root->FindNestedElementWithName("PUnstructuredGrid") : nullptr;
  std::vector<fs::path> pieces;
  for (int k = 0; grid && k < grid->GetNumberOfNestedElements(); ++k)
    if (vtkXMLDataElement& element = *grid->GetNestedElement(k); textIn(element, "Source") != "")
      pieces.push_back(file.parent_path() / textIn(element, "Source"));
  if (pieces.empty()) throw cannotBeRead(file);
  return pieces;
}

/// Reads with VTK's reader, which ends the process on some damaged files.
DataFrame readOne(const fs::path& file) {
  requireEnd(file);
  bool isSound = true;
  vtkNew<vtkCallbackCommand> complaint;
  complaint->SetClientData(&isSound);
  complaint->SetCallback(
      [](vtkObject*, unsigned long, void* sound, void*) { *static_cast<bool*>(sound) = false; });
  const vtkSmartPointer<vtkXMLReader> reader = readerOf(file);
  reader->AddObserver("ErrorEvent", complaint);
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkDataSet* data = vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  if (!isSound || reader->GetErrorCode() != 0 || !data) throw cannotBeRead(file);
  const std::vector<std::vector<vtkIdType>> corners = cornersOf(*data, file);
  DataFrame frame{pointPart(*data)};
  frame.push_back(cellPart(*data, corners, frame.front().positions));
  frame.push_back(cornerPart(corners));
  return frame;
}

/// In the process that only tries whether a file can be read: ends it with 0 if so.
[[noreturn]] void tryToRead(const fs::path& file) {
  const ::rlimit noCore{0, 0};
  ::setrlimit(RLIMIT_CORE, &noCore);
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, descriptor);
  try {
    readOne(file);
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

/// Throws `Error` unless another process could read the file.
void requireReadable(const fs::path& file) {
  static_cast<void>(readerOf(file));
  std::error_code status;
  if (!fs::exists(file, status)) throw Error(fmt::format("{}: there is no such file", file.string()));
  const ::pid_t child = ::fork();
  if (child < 0) throw Error(fmt::format("{}: no process could be started to read it", file.string()));
  if (child == 0) tryToRead(file);
  int end = 0;
  while (::waitpid(child, &end, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(end) || WEXITSTATUS(end) != 0) throw cannotBeRead(file);
}

/// Reads files, each of which is tried once.
class VtkFiles {
 public:
  /// detail: of the parts; that of a piece is added.
  DataFrame read(const fs::path& file, const std::string& detail = "") {
    if (file.extension() != ".pvtu") return readFile(file, detail);
    DataFrame frame;
    int number = 0;
    for (const fs::path& piece : piecesOf(file))
      for (DataPart& part :
           readFile(piece, fmt::format("{}{}piece {}", detail, detail.empty() ? "" : ", ", number++)))
        frame.push_back(std::move(part));
    return frame;
  }

 private:
  DataFrame readFile(const fs::path& file, const std::string& detail) {
    if (tried_.insert(file).second) requireReadable(file);
    DataFrame frame = readOne(file);
    for (DataPart& part : frame) part.detail = detail;
    return frame;
  }

  std::set<fs::path> tried_;
};

struct CollectionEntry {
  std::string name;
  fs::path file;
};

double timeIn(const char* text, const fs::path& file) {
  const std::string_view word = text ? text : "";
  double time = 0.0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), time);
  if (status != std::errc() || end != word.data() + word.size() || !std::isfinite(time))
    throw Error(fmt::format("{}: found the timestep {}; expected a number", file.string(),
                            quoted(std::string(word))));
  return time;
}

/// Entries of a collection by their times, each list in the order of the file.
std::map<double, std::vector<CollectionEntry>> entriesOf(const fs::path& file) {
  const vtkSmartPointer<vtkXMLDataElement> root = rootOf(file);
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection) throw Error(fmt::format("{}: found no collection of VTK files in it", file.string()));
  std::map<double, std::vector<CollectionEntry>> entries;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement& element = *collection->GetNestedElement(k);
    const std::string name = textIn(element, "name"), part = textIn(element, "part");
    entries[timeIn(element.GetAttribute("timestep"), file)].push_back(
        {name.empty() ? "part " + part : name, file.parent_path() / textIn(element, "file")});
  }
  if (entries.empty()) throw Error(fmt::format("{}: the collection is empty", file.string()));
  return entries;
}

}  // namespace

DataSeries vtkFileSeries(const fs::path& file) {
  const auto files = std::make_shared<VtkFiles>();
  return {.name = "files", .times = {}, .isTimed = false, .frame = [files, file](std::size_t /*index*/) {
            return files->read(file);
          }};
}

DataSeries vtkCollectionSeries(const fs::path& file) {
  const auto files = std::make_shared<VtkFiles>();
  std::vector<double> times;
  std::vector<std::vector<CollectionEntry>> all;
  for (auto& [time, entries] : entriesOf(file)) {
    times.push_back(time);
    all.push_back(entries);
  }
  return {.name = "times", .times = times, .frame = [files, all](std::size_t index) {
            DataFrame frame;
            for (const auto& [name, path] : all[index])
              for (DataPart& part : files->read(path, name)) frame.push_back(std::move(part));
            return frame;
          }};
}

}  // namespace burnish

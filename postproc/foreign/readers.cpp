#include <fmt/format.h>
#include <fmt/ranges.h>
#include <json/json.h>
#include <vtkAVSucdReader.h>
#include <vtkAbstractArray.h>
#include <vtkAppendFilter.h>
#include <vtkCGNSReader.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkDataSetReader.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkExodusIIReader.h>
#include <vtkFLUENTReader.h>
#include <vtkGLTFReader.h>
#include <vtkGenericEnSightReader.h>
#include <vtkHDFReader.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObjectFactory.h>
#include <vtkOpenFOAMReader.h>
#include <vtkOutputWindow.h>
#include <vtkPLYReader.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTecplotReader.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/lower_case.h"
#include "engine/core/quoted.h"
#include "postproc/foreign/announced_counts.h"
#include "postproc/foreign/array_names.h"
#include "postproc/foreign/check_grid.h"
#include "postproc/foreign/foreign_formats.h"
#include "postproc/foreign/foreign_source.h"

/// A module: VTK's readers bring along libraries for the network, for MPI and for pictures, which take as long to load as the rest
/// of the program, and which most commands never need.
namespace burnish {
namespace {

namespace fs = std::filesystem;

int numComplaints = 0;
std::string firstComplaint;

/// What VTK says, without the place in its source; of letters of the file among it those alone that can be shown.
std::string complaintIn(const std::string& text) {
  constexpr std::size_t kLongest = 160;
  const std::size_t place = text.find("): ");
  std::string words = place == std::string::npos ? text : text.substr(place + 3);
  words.erase(std::min(words.find('\n'), words.size()));
  std::erase_if(words, [](unsigned char letter) { return letter < ' ' || letter > '~'; });
  return words.substr(0, kLongest);
}

/// What the reader said, behind a sentence of what is wrong.
std::string complaintText() {
  return firstComplaint.empty() ? "" : "; its reader says: " + firstComplaint;
}

/// Counts errors of VTK; warnings are the reader's own business.
class ComplaintWindow : public vtkOutputWindow {
 public:
  static ComplaintWindow* New();
  void DisplayText(const char* /*text*/) override {}
  void DisplayErrorText(const char* text) override {
    ++numComplaints;
    // That the pipeline failed is said of every reader.
    if (firstComplaint.empty() &&
        std::string_view(text).find("returned failure for request") == std::string_view::npos)
      firstComplaint = complaintIn(text);
  }
};
vtkStandardNewMacro(ComplaintWindow);

/// The value of an attribute in a tag of XML, or nothing.
std::string_view attributeIn(std::string_view tag, std::string_view name) {
  const std::size_t found = tag.find(fmt::format(" {}=\"", name));
  if (found == std::string_view::npos) return {};
  const std::size_t begin = found + name.size() + 3;
  return tag.substr(begin, tag.find('"', begin) - begin);
}

/// The first value of a file of VTK's XML in letters that is a word, such as nan, which the reader stops at; with its array.
std::string wordAmongNumbers(const fs::path& file) {
  constexpr std::uintmax_t kLargest = 256'000'000;
  constexpr const char* kNumbers = " \t\r\n0123456789+-.eE";
  std::error_code status;
  if (!endingOf(file).starts_with(".vt") || fs::file_size(file, status) > kLargest) return "";
  std::ifstream stream(file, std::ios::binary);
  const std::string contents{std::istreambuf_iterator<char>(stream), {}};
  const std::string_view text = contents;
  for (std::size_t at = text.find("<DataArray "); at != std::string_view::npos;
       at = text.find("<DataArray ", at + 1)) {
    const std::string_view tag = text.substr(at, text.find('>', at) - at);
    if (attributeIn(tag, "format") != "ascii" || tag.ends_with('/')) continue;
    std::string_view values = text.substr(at + tag.size());
    values = values.substr(std::min<std::size_t>(1, values.size()), values.find('<') - 1);
    const std::size_t odd = values.find_first_not_of(kNumbers);
    if (odd == std::string_view::npos) continue;
    const std::size_t begin = values.find_last_of(" \t\r\n", odd) + 1;  // 0 if there is none
    const std::string_view word = values.substr(begin, values.find_first_of(" \t\r\n", odd) - begin);
    return fmt::format(
        "; the array {} holds {} in letters, which this reader does not know: write the file in binary",
        quoted(std::string(attributeIn(tag, "Name"))), quoted(std::string(word)));
  }
  return "";
}

Error cannotBeRead(const fs::path& file) {
  const ForeignFormat* format = foreignFormat(file);
  return Error(fmt::format("{}: this is no {} of its ending, or it is damaged{}{}", file.string(),
                           format != nullptr ? format->words : "file", complaintText(),
                           numComplaints > 0 ? wordAmongNumbers(file) : ""));
}

void requireThere(const fs::path& file) {
  std::error_code status;
  if (!fs::exists(file, status)) throw Error(fmt::format("{}: there is no such file", file.string()));
  if (!fs::is_regular_file(file, status)) throw Error(fmt::format("{}: this is no file", file.string()));
}

/// Throws `Error` for a file of VTK's XML that was cut off: its last values may be missing without a word of
/// the reader.
void requireEnd(const fs::path& file) {
  constexpr std::streamoff kTail = 100;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  stream.seekg(std::max<std::streamoff>(stream.tellg() - kTail, 0));
  const std::string tail{std::istreambuf_iterator<char>(stream), {}};
  if (tail.find("</VTKFile>") == std::string::npos) throw cannotBeRead(file);
}

/// Arrays of numbers with names, one per point or cell; names that are there twice get a number.
void tidyArrays(vtkDataSetAttributes& data, vtkIdType count) {
  std::set<std::string> names;
  for (int k = data.GetNumberOfArrays() - 1; k >= 0; --k) {
    vtkDataArray* numbers = data.GetArray(k);
    if (!numbers || numbers->GetNumberOfTuples() != count || numbers->GetNumberOfComponents() < 1)
      data.RemoveArray(k);
    else if (!numbers->GetName() || *numbers->GetName() == '\0')
      numbers->SetName(fmt::format("array {}", k).c_str());
  }
  for (int k = 0; k < data.GetNumberOfArrays(); ++k) {
    std::string name = data.GetArray(k)->GetName();
    while (!names.insert(name).second) name += "_2";
    data.GetArray(k)->SetName(name.c_str());
  }
}

/// Checked, as an unstructured grid, and tried with the filter on which pictures build.
vtkSmartPointer<vtkUnstructuredGrid> gridOf(vtkDataSet& data, const fs::path& file) {
  if (!isSound(data)) throw cannotBeRead(file);
  vtkSmartPointer<vtkUnstructuredGrid> grid = vtkUnstructuredGrid::SafeDownCast(&data);
  if (!grid) {
    vtkNew<vtkAppendFilter> append;
    append->AddInputData(&data);
    append->Update();
    grid = append->GetOutput();
  }
  tidyArrays(*grid->GetPointData(), grid->GetNumberOfPoints());
  if (file.extension() == ".obj") grid->GetCellData()->RemoveArray("GroupIds");  // not in the file
  tidyArrays(*grid->GetCellData(), grid->GetNumberOfCells());
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(grid);
  surface->Update();
  return grid;
}

std::string nameIn(vtkInformation* information) {
  const char* name = information && information->Has(vtkCompositeDataSet::NAME())
                         ? information->Get(vtkCompositeDataSet::NAME())
                         : nullptr;
  return name ? name : "";
}

/// Data sets that are not empty, with the names of their places.
void addBlocks(std::vector<ForeignBlock>& blocks, vtkDataObject* object, const std::string& name,
               const fs::path& file) {
  if (auto* data = vtkDataSet::SafeDownCast(object)) {
    if (data->GetNumberOfPoints() > 0 || data->GetNumberOfCells() > 0)
      blocks.push_back({name, gridOf(*data, file)});
    return;
  }
  if (auto* pieces = vtkPartitionedDataSet::SafeDownCast(object)) {
    const unsigned count = pieces->GetNumberOfPartitions();
    for (unsigned k = 0; k < count; ++k)
      addBlocks(blocks, pieces->GetPartitionAsDataObject(k),
                count == 1 ? name : fmt::format("{} piece {}", name, k), file);
    return;
  }
  const auto addNamed = [&](vtkDataObject* child, vtkInformation* information) {
    const std::string own = nameIn(information);
    addBlocks(blocks, child, own.empty() ? fmt::format("block {}", blocks.size()) : typedName(own), file);
  };
  if (auto* sets = vtkPartitionedDataSetCollection::SafeDownCast(object))
    for (unsigned k = 0; k < sets->GetNumberOfPartitionedDataSets(); ++k)
      addNamed(sets->GetPartitionedDataSet(k), sets->HasMetaData(k) ? sets->GetMetaData(k) : nullptr);
  auto* tree = vtkMultiBlockDataSet::SafeDownCast(object);
  for (unsigned k = 0; tree && k < tree->GetNumberOfBlocks(); ++k) {
    // Readers put blocks into groups for their kind, which is no name of a block.
    if (vtkMultiBlockDataSet::SafeDownCast(tree->GetBlock(k)))
      addBlocks(blocks, tree->GetBlock(k), name, file);
    else
      addNamed(tree->GetBlock(k), tree->HasMetaData(k) ? tree->GetMetaData(k) : nullptr);
  }
}

/// One file read by one of VTK's readers.
class ReaderSource : public ForeignSource {
 public:
  /// prepare: after the reader knows what is in the file, says that all of it is wanted.
  ReaderSource(fs::path file, vtkSmartPointer<vtkAlgorithm> reader, const std::function<void()>& prepare)
      : file_(std::move(file)), reader_(std::move(reader)) {
    reader_->UpdateInformation();
    if (prepare) prepare();
    vtkInformation& information = *reader_->GetOutputInformation(0);
    auto* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
    for (int k = 0; information.Has(key) && k < information.Length(key); ++k)
      times_.push_back(information.Get(key)[k]);
    if (!std::is_sorted(times_.begin(), times_.end())) throw cannotBeRead(file_);
    if (times_ == std::vector{0.0}) times_.clear();  // readers say so of files without times
  }

  std::vector<double> times() override { return times_; }

  std::vector<ForeignBlock> blocks(std::size_t instant) override {
    if (times_.empty())
      reader_->Update();
    else
      reader_->UpdateTimeStep(times_.at(instant));
    std::vector<ForeignBlock> blocks;
    addBlocks(blocks, reader_->GetOutputDataObject(0), "", file_);
    try {
      requireAnnounced(file_, blocks);
    } catch (const Error& error) {
      throw Error(error.what() + complaintText());
    }
    if (numComplaints > 0) throw cannotBeRead(file_);
    return blocks;
  }

 private:
  fs::path file_;
  vtkSmartPointer<vtkAlgorithm> reader_;
  std::vector<double> times_;
};

template <class Reader>
std::unique_ptr<ForeignSource> readWith(const fs::path& file) {
  const auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(file.c_str());
  return std::make_unique<ReaderSource>(file, reader, nullptr);
}

template <class Reader>
std::unique_ptr<ForeignSource> readXmlWith(const fs::path& file) {
  requireEnd(file);
  return readWith<Reader>(file);
}

std::unique_ptr<ForeignSource> readLegacy(const fs::path& file) {
  const auto reader = vtkSmartPointer<vtkDataSetReader>::New();
  reader->SetFileName(file.c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  return std::make_unique<ReaderSource>(file, reader, nullptr);
}

std::unique_ptr<ForeignSource> readExodus(const fs::path& file) {
  const auto reader = vtkSmartPointer<vtkExodusIIReader>::New();
  reader->SetFileName(file.c_str());
  reader->ApplyDisplacementsOff();  // a picture warps by them where it is asked to
  reader->GenerateObjectIdCellArrayOff();
  return std::make_unique<ReaderSource>(file, reader, [reader] {
    reader->SetAllArrayStatus(vtkExodusIIReader::NODAL, 1);
    reader->SetAllArrayStatus(vtkExodusIIReader::ELEM_BLOCK, 1);
  });
}

std::unique_ptr<ForeignSource> readAvs(const fs::path& file) {
  requireAvs(file);
  const auto reader = vtkSmartPointer<vtkAVSucdReader>::New();
  reader->SetFileName(file.c_str());
  return std::make_unique<ReaderSource>(file, reader, [reader] {
    reader->EnableAllPointArrays();
    reader->EnableAllCellArrays();
  });
}

std::unique_ptr<ForeignSource> readTecplot(const fs::path& file) {
  requireTecplot(file);
  const auto reader = vtkSmartPointer<vtkTecplotReader>::New();
  reader->SetFileName(file.c_str());
  return std::make_unique<ReaderSource>(file, reader, [reader] {
    for (int k = 0; k < reader->GetNumberOfDataArrays(); ++k)
      reader->SetDataArrayStatus(reader->GetDataArrayName(k), 1);
  });
}

/// With the `.dat` file beside it, where the fields are.
std::unique_ptr<ForeignSource> readFluent(const fs::path& file) {
  if (const fs::path fields = fs::path(file).replace_extension(".dat"); !fs::exists(fields))
    throw Error(fmt::format("{}: found no {} beside it, where the fields of such a case are", file.string(),
                            fields.filename().string()));
  const auto reader = vtkSmartPointer<vtkFLUENTReader>::New();
  reader->SetFileName(file.c_str());
  return std::make_unique<ReaderSource>(file, reader, [reader] { reader->EnableAllCellArrays(); });
}

std::unique_ptr<ForeignSource> readCgns(const fs::path& file) {
  const auto reader = vtkSmartPointer<vtkCGNSReader>::New();
  reader->SetFileName(file.c_str());
  return std::make_unique<ReaderSource>(file, reader, [reader] {
    reader->EnableAllBases();
    reader->EnableAllFamilies();
    reader->EnableAllPointArrays();
    reader->EnableAllCellArrays();
  });
}

std::unique_ptr<ForeignSource> readEnSight(const fs::path& file) {
  const auto reader = vtkSmartPointer<vtkGenericEnSightReader>::New();
  reader->SetCaseFileName(fs::absolute(file).c_str());
  reader->ReadAllVariablesOn();
  return std::make_unique<ReaderSource>(file, reader, nullptr);
}

/// The directory that the file lies in: the body itself, with what its cells have.
std::unique_ptr<ForeignSource> readOpenFoam(const fs::path& file) {
  const auto reader = vtkSmartPointer<vtkOpenFOAMReader>::New();
  reader->SetFileName(fs::absolute(file).c_str());
  reader->CreateCellToPointOff();
  reader->SkipZeroTimeOff();
  reader->DecomposePolyhedraOff();
  return std::make_unique<ReaderSource>(file, reader, [reader] { reader->EnableAllCellArrays(); });
}

std::string textIn(vtkXMLDataElement& element, const char* attribute) {
  const char* text = element.GetAttribute(attribute);
  return text ? text : "";
}

vtkSmartPointer<vtkXMLDataElement> rootOf(const fs::path& file) {
  return vtk::TakeSmartPointer(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
}

std::unique_ptr<ForeignSource> openFile(const fs::path& file);

/// What is wrong with a file that others name, behind these.
Error ofPart(const std::string& whole, const Error& error) {
  return Error(fmt::format("{}: {}", whole, error.what()));
}

/// The files that a `.pvtu` file or another one of several pieces names. VTK's readers of them are silent about damaged ones.
class PieceSource : public ForeignSource {
 public:
  explicit PieceSource(const fs::path& file) : file_(file) {
    const vtkSmartPointer<vtkXMLDataElement> root = rootOf(file);
    const std::string ending = endingOf(file);
    const auto* kind = std::ranges::find(kKinds, std::string_view(ending).substr(2), &Kind::ending);
    vtkXMLDataElement* whole = root ? root->FindNestedElementWithName(kind->element) : nullptr;
    for (int k = 0; whole && k < whole->GetNumberOfNestedElements(); ++k)
      if (vtkXMLDataElement& element = *whole->GetNestedElement(k); textIn(element, "Source") != "")
        pieces_.push_back(file.parent_path() / textIn(element, "Source"));
    if (pieces_.empty()) throw cannotBeRead(file);
  }

  std::vector<ForeignBlock> blocks(std::size_t /*instant*/) override {
    std::vector<ForeignBlock> all;
    try {
      for (std::size_t k = 0; k < pieces_.size(); ++k)
        for (ForeignBlock& block : openPart(pieces_[k])->blocks(0))
          all.push_back({fmt::format("piece {}", k), block.grid});
    } catch (const Error& error) {
      throw ofPart(file_.string(), error);
    }
    return all;
  }

  /// One of the files that another one names, which itself names none.
  static std::unique_ptr<ForeignSource> openPart(const fs::path& file) {
    const std::string ending = endingOf(file);
    const std::string_view kind = std::string_view(ending).substr(ending.empty() ? 0 : 1);
    if (std::ranges::find(kKinds, kind, &Kind::ending) != kKinds.end()) return openFile(file);
    throw Error(fmt::format("{}: found the ending {}; expected .vtu, .vtp, .vts, .vtr or .vti", file.string(),
                            quoted(ending)));
  }

 private:
  /// Behind `.p` and `.`, and the element of XML that holds the pieces.
  struct Kind {
    std::string_view ending;
    const char* element;
  };
  static constexpr std::array kKinds{Kind{"vti", "PImageData"}, Kind{"vtp", "PPolyData"},
                                     Kind{"vtr", "PRectilinearGrid"}, Kind{"vts", "PStructuredGrid"},
                                     Kind{"vtu", "PUnstructuredGrid"}};

  fs::path file_;
  std::vector<fs::path> pieces_;
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

/// A file of one time.
struct Entry {
  std::string name;
  fs::path file;
};
using EntriesByTime = std::map<double, std::vector<Entry>>;

/// Of a collection of ParaView.
EntriesByTime entriesOfCollection(const fs::path& file) {
  const vtkSmartPointer<vtkXMLDataElement> root = rootOf(file);
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection) throw Error(fmt::format("{}: found no collection of VTK files in it", file.string()));
  EntriesByTime byTime;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement& element = *collection->GetNestedElement(k);
    const std::string name = textIn(element, "name"), part = textIn(element, "part");
    byTime[timeIn(element.GetAttribute("timestep"), file)].push_back(
        {name.empty() && !part.empty() ? "part " + part : name,
         file.parent_path() / textIn(element, "file")});
  }
  return byTime;
}

/// Of a `.vtu.series` file and its like, which are JSON: {"files": [{"name": "a.vtu", "time": 0}, ...]}.
EntriesByTime entriesOfSeries(const fs::path& file) {
  std::ifstream stream(file);
  Json::Value root;
  std::string problem;
  bool isJson = false;
  try {
    isJson = Json::parseFromStream(Json::CharReaderBuilder(), stream, &root, &problem);
  } catch (const Json::Exception&) {  // too many brackets in one another
  }
  if (!isJson || !root.isObject() || !root["files"].isArray())
    throw Error(fmt::format("{}: found no series of VTK files in it", file.string()));
  EntriesByTime byTime;
  for (const Json::Value& entry : root["files"]) {
    if (!entry.isObject() || !entry["name"].isString() || !entry["time"].isNumeric() ||
        !std::isfinite(entry["time"].asDouble()))
      throw Error(fmt::format("{}: an entry of its files has no name or no time", file.string()));
    byTime[entry["time"].asDouble()].push_back({"", file.parent_path() / entry["name"].asString()});
  }
  return byTime;
}

/// Files by their times, those of one time in the order in which they are named.
class CollectionSource : public ForeignSource {
 public:
  explicit CollectionSource(const fs::path& file) : file_(file) {
    EntriesByTime byTime = endingOf(file) == ".series" ? entriesOfSeries(file) : entriesOfCollection(file);
    if (byTime.empty()) throw Error(fmt::format("{}: the collection is empty", file.string()));
    for (auto& [time, entries] : byTime) {
      times_.push_back(time);
      entries_.push_back(std::move(entries));
    }
  }

  std::vector<double> times() override { return times_; }

  std::vector<ForeignBlock> blocks(std::size_t instant) override {
    std::vector<ForeignBlock> all;
    try {
      for (const Entry& entry : entries_.at(instant))
        for (ForeignBlock& block : openEntry(entry.file)->blocks(0))
          all.push_back({entry.name.empty()   ? block.name
                         : block.name.empty() ? typedName(entry.name)
                                              : typedName(entry.name + " " + block.name),
                         block.grid});
    } catch (const Error& error) {
      throw ofPart(fmt::format("{}: t = {}", file_.string(), times_.at(instant)), error);
    }
    return all;
  }

 private:
  /// What has no times of its own.
  static std::unique_ptr<ForeignSource> openEntry(const fs::path& file) {
    constexpr std::array kEndings{".vtu",  ".vtp",  ".vts", ".vtr",  ".vti", ".pvtu", ".pvtp", ".pvts",
                                  ".pvtr", ".pvti", ".vtm", ".vtpc", ".vtk", ".stl",  ".ply"};
    const std::string ending = endingOf(file);
    if (std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end()) return openFile(file);
    throw Error(fmt::format("{}: found the ending {}; expected {}", file.string(), quoted(ending),
                            fmt::join(kEndings, ", ")));
  }

  fs::path file_;
  std::vector<double> times_;
  std::vector<std::vector<Entry>> entries_;
};

template <class Source>
std::unique_ptr<ForeignSource> make(const fs::path& file) {
  return std::make_unique<Source>(file);
}

/// How each of `kForeignFormats` is opened.
struct Opening {
  std::string_view ending;
  std::unique_ptr<ForeignSource> (*open)(const fs::path& file);
};

constexpr std::array kOpenings{Opening{".avs", readAvs},
                               Opening{".cas", readFluent},
                               Opening{".case", readEnSight},
                               Opening{".cgns", readCgns},
                               Opening{".e", readExodus},
                               Opening{".ex2", readExodus},
                               Opening{".exo", readExodus},
                               Opening{".foam", readOpenFoam},
                               Opening{".glb", readWith<vtkGLTFReader>},
                               Opening{".obj", readWith<vtkOBJReader>},
                               Opening{".ply", readWith<vtkPLYReader>},
                               Opening{".pvd", make<CollectionSource>},
                               Opening{".pvti", make<PieceSource>},
                               Opening{".pvtp", make<PieceSource>},
                               Opening{".pvtr", make<PieceSource>},
                               Opening{".pvts", make<PieceSource>},
                               Opening{".pvtu", make<PieceSource>},
                               Opening{".series", make<CollectionSource>},
                               Opening{".stl", readWith<vtkSTLReader>},
                               Opening{".tec", readTecplot},
                               Opening{".tp", readTecplot},
                               Opening{".ucd", readAvs},
                               Opening{".vti", readXmlWith<vtkXMLImageDataReader>},
                               Opening{".vtk", readLegacy},
                               Opening{".vtkhdf", readWith<vtkHDFReader>},
                               Opening{".vtm", readXmlWith<vtkXMLMultiBlockDataReader>},
                               Opening{".vtp", readXmlWith<vtkXMLPolyDataReader>},
                               Opening{".vtpc", readXmlWith<vtkXMLPartitionedDataSetCollectionReader>},
                               Opening{".vtr", readXmlWith<vtkXMLRectilinearGridReader>},
                               Opening{".vts", readXmlWith<vtkXMLStructuredGridReader>},
                               Opening{".vtu", readXmlWith<vtkXMLUnstructuredGridReader>}};
static_assert(std::ranges::equal(kOpenings, kForeignFormats, {}, &Opening::ending, &ForeignFormat::ending));

std::unique_ptr<ForeignSource> openFile(const fs::path& file) {
  const auto* found = std::ranges::find(kOpenings, endingOf(file), &Opening::ending);
  if (found == kOpenings.end())
    throw Error(fmt::format("{}: found the ending {}; expected one of a format that VTK reads", file.string(),
                            quoted(file.extension().string())));
  requireThere(file);
  numComplaints = 0;
  firstComplaint.clear();
  auto source = found->open(file);
  if (numComplaints > 0) throw cannotBeRead(file);
  return source;
}

/// From now on VTK's errors are noted in this process.
void noteComplaints() {
  vtkObject::GlobalWarningDisplayOn();
  const vtkNew<ComplaintWindow> window;
  vtkOutputWindow::SetInstance(window);
}

}  // namespace
}  // namespace burnish

extern "C" burnish::ForeignSource* burnishOpenForeign(const std::filesystem::path& file) {
  burnish::noteComplaints();
  return burnish::openFile(file).release();
}

#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace burnish::test {

/// Collects what VTK complains about, by whatever way.
class Complaints : public vtkOutputWindow {
 public:
  static Complaints* New();
  vtkTypeMacro(Complaints, vtkOutputWindow) void DisplayText(const char* text) override {
    texts.emplace_back(text);
  }
  std::vector<std::string> texts;
};
inline vtkStandardNewMacro(Complaints);

/// A directory for exported files, which are read back with VTK's own readers.
class VtuFiles : public testing::Test {
 protected:
  VtuFiles() {
    std::string name = (std::filesystem::temp_directory_path() / "burnish_vtu_XXXXXX").string();
    directory_ = mkdtemp(name.data());
    vtkOutputWindow::SetInstance(complaints_);
  }
  ~VtuFiles() override {
    vtkOutputWindow::SetInstance(nullptr);
    std::filesystem::remove_all(directory_);
  }

  vtkSmartPointer<vtkUnstructuredGrid> readGrid(const std::string& file) {
    return read<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(file);
  }
  vtkSmartPointer<vtkUnstructuredGrid> readPieces(const std::string& file) {
    return read<vtkXMLPUnstructuredGridReader, vtkUnstructuredGrid>(file);
  }
  vtkSmartPointer<vtkPolyData> readPolyData(const std::string& file) {
    return read<vtkXMLPolyDataReader, vtkPolyData>(file);
  }

  struct Entry {
    double time;
    int part;
    std::string name, file;
    bool operator==(const Entry&) const = default;
  };
  std::vector<Entry> readCollection() const {
    const auto root =
        vtk::TakeSmartPointer(vtkXMLUtilities::ReadElementFromFile((directory_ / "frames.pvd").c_str()));
    EXPECT_NE(root, nullptr);
    EXPECT_STREQ(root->GetAttribute("type"), "Collection");
    vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
    std::vector<Entry> entries;
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
      vtkXMLDataElement* element = collection->GetNestedElement(i);
      entries.push_back({std::stod(element->GetAttribute("timestep")),
                         std::stoi(element->GetAttribute("part")), element->GetAttribute("name"),
                         element->GetAttribute("file")});
    }
    return entries;
  }

  static std::set<std::string> filesIn(const std::filesystem::path& path) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path))
      names.insert(entry.path().filename().string());
    return names;
  }

  static std::string bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::filesystem::path directory_;

 private:
  /// Any error, warning or message of the reader fails the test.
  template <class Reader, class Data>
  vtkSmartPointer<Data> read(const std::string& file) {
    vtkNew<vtkCallbackCommand> fail;
    fail->SetCallback([](vtkObject*, unsigned long, void*, void* text) {
      ADD_FAILURE() << "the reader says: " << static_cast<const char*>(text);
    });
    vtkNew<Reader> reader;
    reader->AddObserver("ErrorEvent", fail);
    reader->AddObserver("WarningEvent", fail);
    reader->SetFileName((directory_ / "frames" / file).c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), 0u) << file;
    EXPECT_THAT(complaints_->texts, testing::IsEmpty());
    return reader->GetOutput();
  }

  vtkNew<Complaints> complaints_;
};

}  // namespace burnish::test

#include "postproc/export/vtu_series_writer.h"

#include <fmt/format.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <span>
#include <system_error>
#include <utility>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/results/check_records.h"
#include "postproc/export/vtk_file.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/outlines.h"
#include "postproc/mesh/recorded_shape.h"
#include "postproc/mesh/span_lines.h"
#include "postproc/text/plain_time.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// Every file that some choice of parts writes, also when it was not finished.
const std::regex kOurFiles(
    R"((body|points|net|knots|self_contact|all|(tool|contact|body|points|net|knots)_[\w-]+)_\d{6,}(\.vt[upm]|\.pvtu|_\d+\.vtu)(\.partial)?)");

/// What all file systems and URLs accept of a name.
std::string fileStem(const std::string& name) {
  std::string stem = std::regex_replace(name, std::regex("[^A-Za-z0-9_-]"), "_");
  return stem.empty() ? "tool" : stem;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// One stem per name, no two alike even where a file system ignores case.
std::vector<std::string> fileStems(const std::vector<std::string>& names) {
  std::vector<std::string> stems;
  for (const std::string& name : names) {
    const std::string wanted = fileStem(name);
    std::string stem = wanted;
    const auto taken = [&](const std::string& other) { return lower(other) == lower(stem); };
    for (int k = 2; std::any_of(stems.begin(), stems.end(), taken); ++k)
      stem = fmt::format("{}_{}", wanted, k);
    stems.push_back(stem);
  }
  return stems;
}

/// The box of the control points, which holds the body.
Eigen::AlignedBox3d boxOf(const MeshRecord& mesh, const Eigen::MatrixXd& displacement) {
  Eigen::AlignedBox3d box;
  for (const PatchRecord& patch : mesh.patches)
    for (Eigen::Index a = 0; a < patch.points.cols(); ++a) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      x.head(patch.points.rows()) =
          patch.points.col(a) + displacement.col(patch.nodes[static_cast<std::size_t>(a)]);
      box.extend(x);
    }
  return box;
}

struct BodyGrid {
  const FrameRecord& frame;
  const std::string& lengthUnit;

  auto operator()(const Tessellation& cells) const { return makeGrid(cells, frame, true, lengthUnit); }
  auto operator()(const CurvedCells& cells) const { return makeGrid(cells, frame, lengthUnit); }
};

const char* extensionOf(ExportPart kind, int pieces) {
  if (kind == ExportPart::Knots) return "vtu";
  if (kind != ExportPart::Body) return "vtp";
  return pieces > 1 ? "pvtu" : "vtu";
}

void removeFile(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw Error(fmt::format("cannot remove {}: {}", file.string(), error.message()));
}

}  // namespace

VtuSeriesWriter::VtuSeriesWriter(fs::path runDir, ModelRecord model, const VtuOptions& options)
    : runDir_(std::move(runDir)),
      model_(std::move(model)),
      cellKind_(options.cells),
      pieces_(options.pieces),
      cells_(makeAllCells()),
      wantsContact_(options.parts.contains(ExportPart::Contact)),
      parts_(makeParts(model_, options.parts)) {
  std::error_code error;
  fs::create_directories(runDir_ / "frames", error);
  if (error)
    throw Error(
        fmt::format("cannot create the directory {}: {}", (runDir_ / "frames").string(), error.message()));
  removeEarlierSeries();
}

VtuSeriesWriter::BodyCells VtuSeriesWriter::makeCells(const MeshRecord& mesh, const MeshPiece* piece) const {
  if (cellKind_ == CellKind::Lagrange) return CurvedCells(mesh, CurvedFamily::Lagrange, piece);
  if (cellKind_ == CellKind::Bezier) return CurvedCells(mesh, CurvedFamily::Bezier, piece);
  return Tessellation(mesh, model_.subdivision, piece);
}

std::vector<VtuSeriesWriter::BodyCells> VtuSeriesWriter::makeAllCells() const {
  std::vector<BodyCells> all;
  if (pieces_ > 1) {
    // What cannot be cut is an error before anything is removed, also where cells are made later.
    const MeshPiece first = piecesOf(model_.mesh, pieces_).front();
    static_cast<void>(makeCells(model_.mesh, &first));
    return all;
  }
  if (model_.bodies.size() < 2) return {makeCells(model_.mesh)};
  for (const std::string& body : model_.bodies)
    all.push_back(makeCells(chosenBodies(model_, {}, {body}).model.mesh));
  return all;
}

std::vector<VtuSeriesWriter::Part> VtuSeriesWriter::makeParts(const ModelRecord& model,
                                                              const std::set<ExportPart>& kinds) {
  std::vector<std::string> names;
  for (const ToolRecord& tool : model.tools) names.push_back(tool.name);
  const std::vector<std::string> stems = fileStems(names), bodies = fileStems(model.bodies);
  std::vector<Part> parts;
  const auto addPerBody = [&](ExportPart kind, const std::string& name) {
    if (bodies.size() < 2) return parts.push_back({kind, name, {}, {}, {}});
    for (std::size_t body = 0; body < bodies.size(); ++body)
      parts.push_back({kind, fmt::format("{}_{}", name, bodies[body]), {}, body, {}});
  };
  for (const ExportPart kind : kinds) {
    if (kind == ExportPart::Body) addPerBody(kind, "body");
    if (kind == ExportPart::Tools)
      for (std::size_t tool = 0; tool < stems.size(); ++tool)
        parts.push_back({kind, "tool_" + stems[tool], tool, {}, {}});
    if (kind == ExportPart::Contact) {
      for (std::size_t tool = 0; tool < stems.size(); ++tool)
        parts.push_back({kind, "contact_" + stems[tool], {}, {}, ContactName{names[tool], {}}});
      parts.push_back({kind, "self_contact", {}, {}, ContactName{}});
    }
    if (kind == ExportPart::Points) addPerBody(kind, "points");
    if (kind == ExportPart::Net) addPerBody(kind, "net");
    if (kind == ExportPart::Knots) addPerBody(kind, "knots");
  }
  return parts;
}

void VtuSeriesWriter::addPairs(const std::vector<ContactName>& contacts) {
  if (!wantsContact_) return;
  std::vector<std::string> names;
  for (const ToolRecord& tool : model_.tools) names.push_back(tool.name);
  for (const ContactName& contact : contacts)
    if (!contact.pair.empty()) names.push_back(contact.pair);
  const std::vector<std::string> stems = fileStems(names);
  std::size_t number = model_.tools.size();
  for (const ContactName& contact : contacts) {
    if (contact.pair.empty()) continue;
    const std::string& stem = stems[number++];
    const bool isNew =
        std::none_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.contact == contact; });
    if (isNew) parts_.push_back({ExportPart::Contact, "contact_" + stem, {}, {}, contact});
  }
}

void VtuSeriesWriter::write(const FrameRecord& frame) {
  checkFrame(frame, model_, fmt::format("frame {} for {}", frame.index, (runDir_ / "frames").string()));
  Instant instant{plainTime(frame.time), {}};
  const std::vector<ContactName> contacts = contactsOf(frame);
  addPairs(contacts);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i].contact &&
        std::find(contacts.begin(), contacts.end(), *parts_[i].contact) == contacts.end())
      continue;
    if (parts_[i].tool && !model_.tools[*parts_[i].tool].isThereAt(frame.time)) continue;
    writePart(parts_[i], frame);
    instant.parts.push_back(i);
  }
  if (model_.bodies.size() > 1) writeBlocks(frame.index, instant.parts);
  const auto from = instants_.lower_bound(frame.index);
  const std::map<int, Instant> dropped(instants_.upper_bound(frame.index), instants_.end());
  instants_.erase(from, instants_.end());
  instants_.emplace(frame.index, std::move(instant));
  writeCollection();
  removeFrames(dropped);
}

std::vector<SeriesBlock> VtuSeriesWriter::blocks() const {
  std::set<std::size_t> numbers;
  for (const auto& [index, instant] : instants_) numbers.insert(instant.parts.begin(), instant.parts.end());
  std::vector<SeriesBlock> blocks;
  for (const std::size_t part : numbers)
    blocks.push_back({parts_[part].name, parts_[part].kind, parts_[part].body});
  return blocks;
}

void VtuSeriesWriter::writeBodyPart(const Part& part, const ModelRecord& model,
                                    const FrameRecord& frame) const {
  const fs::path path = file(part, frame.index);
  if (part.kind == ExportPart::Points) return writeVtkFile(*quadraturePoints(frame), frame.time, path);
  if (part.kind == ExportPart::Net) return writeVtkFile(*controlNet(model, frame), frame.time, path);
  if (part.kind == ExportPart::Knots) return writeVtkFile(*knotLines(model, frame), frame.time, path);
  if (pieces_ > 1) return writePieces(part, model, frame);
  const BodyGrid grid{frame, model.lengthUnit};
  const BodyCells& cells = cells_[part.body.value_or(0)];
  writeVtkFile(*(frame.mesh ? std::visit(grid, makeCells(*frame.mesh)) : std::visit(grid, cells)), frame.time,
               path);
}

vtkSmartPointer<vtkUnstructuredGrid> VtuSeriesWriter::knotLines(const ModelRecord& model,
                                                                const FrameRecord& frame) const {
  const MeshRecord& mesh = meshOf(model, frame);
  // Of Lagrange curves, VTK's filters for surfaces do not make lines but crash.
  return cellKind_ == CellKind::Bezier ? makeSpanLines(CurvedCells(mesh, CurvedFamily::Bezier).points(),
                                                       LineCells::Bezier, frame, model.lengthUnit)
                                       : makeSpanLines(Tessellation(mesh, model.subdivision).points(),
                                                       LineCells::Polylines, frame, model.lengthUnit);
}

void VtuSeriesWriter::writePieces(const Part& part, const ModelRecord& model,
                                  const FrameRecord& frame) const {
  const MeshRecord& mesh = meshOf(model, frame);
  const BodyGrid grid{frame, model.lengthUnit};
  std::vector<fs::path> files;
  std::string layout;
  for (const MeshPiece& piece : piecesOf(mesh, pieces_)) {
    const auto data = std::visit(grid, makeCells(mesh, &piece));
    if (files.empty()) layout = layoutOf(*data);
    files.push_back(pieceFile(part, frame.index, files.size()));
    writeVtkFile(*data, frame.time, files.back());
  }
  writePvtuFile(layout, files, file(part, frame.index));
}

void VtuSeriesWriter::writePart(const Part& part, const FrameRecord& frame) const {
  const fs::path path = file(part, frame.index);
  switch (part.kind) {
    case ExportPart::Body:
    case ExportPart::Points:
    case ExportPart::Net:
    case ExportPart::Knots: {
      if (!part.body) return writeBodyPart(part, model_, frame);
      const ModelFrame alone = chosenBodies(model_, frame, {model_.bodies[*part.body]});
      return writeBodyPart(part, alone.model, alone.frame);
    }
    case ExportPart::Tools: {
      const Eigen::AlignedBox3d box = boxOf(meshOf(model_, frame), frame.displacement);
      return writeVtkFile(*toolOutline(placedTool(model_, frame, part.tool.value()), model_.dim, box),
                          frame.time, path);
    }
    case ExportPart::Contact:
      return writeVtkFile(*contactSurface(model_, frame, part.contact.value()), frame.time, path);
  }
}

void VtuSeriesWriter::writeBlocks(int frame, const std::vector<std::size_t>& parts) const {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">\n"
      "  <vtkMultiBlockDataSet>\n";
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Part& part = parts_[parts[k]];
    const std::vector<fs::path> pieces = pieceFiles(part, frame);
    if (pieces.empty()) {
      xml += fmt::format("    <DataSet index=\"{}\" name=\"{}\" file=\"{}\"/>\n", k, part.name,
                         file(part, frame).filename().string());
      continue;
    }
    // VTK's readers of such files do not know those that name pieces.
    xml += fmt::format("    <Block index=\"{}\" name=\"{}\">\n", k, part.name);
    for (std::size_t piece = 0; piece < pieces.size(); ++piece)
      xml += fmt::format("      <DataSet index=\"{}\" file=\"{}\"/>\n", piece,
                         pieces[piece].filename().string());
    xml += "    </Block>\n";
  }
  xml += "  </vtkMultiBlockDataSet>\n</VTKFile>\n";
  writeFileAtomically(blocksFile(frame), std::as_bytes(std::span(xml)));
}

fs::path VtuSeriesWriter::blocksFile(int frame) const {
  return runDir_ / "frames" / fmt::format("all_{:06}.vtm", frame);
}

fs::path VtuSeriesWriter::file(const Part& part, int frame) const {
  return runDir_ / "frames" / fmt::format("{}_{:06}.{}", part.name, frame, extensionOf(part.kind, pieces_));
}

fs::path VtuSeriesWriter::pieceFile(const Part& part, int frame, std::size_t piece) const {
  return runDir_ / "frames" / fmt::format("{}_{:06}_{}.vtu", part.name, frame, piece);
}

std::vector<fs::path> VtuSeriesWriter::pieceFiles(const Part& part, int frame) const {
  std::vector<fs::path> files;
  if (part.kind != ExportPart::Body || pieces_ == 1) return files;
  std::error_code absent;
  while (fs::exists(pieceFile(part, frame, files.size()), absent))
    files.push_back(pieceFile(part, frame, files.size()));
  return files;
}

void VtuSeriesWriter::removeEarlierSeries() const {
  // The collection goes first, so that it never names a file that is gone.
  removeFile(runDir_ / "frames.pvd");
  std::error_code error;
  std::vector<fs::path> stale;
  for (fs::directory_iterator entry(runDir_ / "frames", error), end; !error && entry != end;
       entry.increment(error))
    if (std::regex_match(entry->path().filename().string(), kOurFiles)) stale.push_back(entry->path());
  if (error)
    throw Error(
        fmt::format("cannot read the directory {}: {}", (runDir_ / "frames").string(), error.message()));
  for (const fs::path& path : stale) removeFile(path);
}

void VtuSeriesWriter::removeFrames(const std::map<int, Instant>& frames) const {
  for (const auto& [index, instant] : frames) {
    for (const std::size_t part : instant.parts) {
      removeFile(file(parts_[part], index));
      for (const fs::path& piece : pieceFiles(parts_[part], index)) removeFile(piece);
    }
    removeFile(blocksFile(index));
  }
}

void VtuSeriesWriter::writeCollection() const {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const auto& [index, instant] : instants_)
    for (const std::size_t part : instant.parts)
      xml += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", instant.time,
                         part, parts_[part].name,
                         file(parts_[part], index).lexically_relative(runDir_).generic_string());
  xml += "  </Collection>\n</VTKFile>\n";
  writeFileAtomically(runDir_ / "frames.pvd", std::as_bytes(std::span(xml)));
}

}  // namespace burnish

#pragma once
#include <vtkSmartPointer.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "engine/results/result.h"
#include "postproc/mesh/curved_cells.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/tessellation.h"

class vtkUnstructuredGrid;

namespace burnish {

enum class CellKind {
  Linear,    ///< straight cells, the model's `subdivision` per knot span and direction
  Lagrange,  ///< one cell per knot span through values at equal steps
  Bezier     ///< one cell per knot span, geometry and fields exactly as computed
};

enum class ExportPart {
  Body,     ///< `body_000000.vtu`; of several bodies `body_NAME_000000.vtu` for each, and so on below. In
            ///< pieces: `body_000000_0.vtu`, … and `body_000000.pvtu`, which names them
  Tools,    ///< `tool_NAME_000000.vtp` for every tool
  Contact,  ///< `contact_NAME_000000.vtp` for every tool and pair of faces, `self_contact_000000.vtp`
  Points,   ///< `points_000000.vtp`: values at the quadrature points, not projected
  Net,      ///< `net_000000.vtp`: the control net
  Knots  ///< `knots_000000.vtu`: lines between knot spans with the fields of the body, exact with Bezier cells
};

struct VtuOptions {
  CellKind cells = CellKind::Linear;
  std::set<ExportPart> parts{ExportPart::Body, ExportPart::Tools, ExportPart::Contact};
  int pieces = 1;  ///< of each body: about so many files, one after the other, which takes less memory
};

/// One data set of the collection.
struct SeriesBlock {
  std::string name;
  ExportPart kind;
  std::optional<std::size_t> body;  ///< of one of several bodies
};

/// Writes a run as VTK files in `frames/`, all at current positions, with the collection `frames.pvd` of
/// their times, which can be opened while the run goes on. Where there are several bodies, each is a part of
/// its own with the fields that it has, and `all_000000.vtm` holds the parts of a frame as named blocks. Every
/// file appears under its name only when it is complete.
class VtuSeriesWriter {
 public:
  /// Makes the directory and removes a series that was written there before, of whatever parts. Throws
  /// `Error` naming the file or directory, or if the model has no such cells (then nothing is removed).
  VtuSeriesWriter(std::filesystem::path runDir, ModelRecord model, const VtuOptions& options = {});

  /// Adds a frame. Frames of the same or a higher index are dropped from the collection and removed. Throws
  /// `Error` naming the file, or saying what of the frame does not fit the model.
  void write(const FrameRecord& frame);

  /// Those that some frame has.
  std::vector<SeriesBlock> blocks() const;

  const ModelRecord& model() const { return model_; }

 private:
  using BodyCells = std::variant<Tessellation, CurvedCells>;

  /// One data set of the collection in every frame.
  struct Part {
    ExportPart kind;
    std::string name;                    ///< in the collection and of the files
    std::optional<std::size_t> tool;     ///< of tools
    std::optional<std::size_t> body;     ///< of one of several bodies
    std::optional<ContactName> contact;  ///< of faces in contact
  };
  struct Instant {
    double time;
    std::vector<std::size_t> parts;  ///< those that the frame has
  };

  static std::vector<Part> makeParts(const ModelRecord& model, const std::set<ExportPart>& kinds);

  /// Pairs of faces are known from frames alone.
  void addPairs(const std::vector<ContactName>& contacts);
  BodyCells makeCells(const MeshRecord& mesh, const MeshPiece* piece = nullptr) const;
  std::vector<BodyCells> makeAllCells() const;
  void writePart(const Part& part, const FrameRecord& frame) const;
  void writeBodyPart(const Part& part, const ModelRecord& model, const FrameRecord& frame) const;
  vtkSmartPointer<vtkUnstructuredGrid> knotLines(const ModelRecord& model, const FrameRecord& frame) const;
  void writePieces(const Part& part, const ModelRecord& model, const FrameRecord& frame) const;
  void writeBlocks(int frame, const std::vector<std::size_t>& parts) const;
  std::filesystem::path file(const Part& part, int frame) const;
  std::filesystem::path pieceFile(const Part& part, int frame, std::size_t piece) const;
  std::filesystem::path blocksFile(int frame) const;
  std::vector<std::filesystem::path> pieceFiles(const Part& part, int frame) const;  ///< that are there
  void removeEarlierSeries() const;
  void removeFrames(const std::map<int, Instant>& frames) const;
  void writeCollection() const;

  std::filesystem::path runDir_;
  ModelRecord model_;
  CellKind cellKind_;
  int pieces_;
  std::vector<BodyCells> cells_;  ///< of the model's mesh, per body; none in pieces
  bool wantsContact_;
  std::vector<Part> parts_;
  std::map<int, Instant> instants_;  ///< by index of the frame
};

}  // namespace burnish

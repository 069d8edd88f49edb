#include "cli/commands/info_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <vector>

#include "cli/commands/info_line.h"
#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/run_files.h"
#include "engine/results/summary_file.h"
#include "postproc/mesh/recorded_shape.h"
#include "postproc/text/account_text.h"
#include "postproc/text/plain_time.h"

namespace burnish {
namespace {

std::string patchText(const PatchRecord& patch) {
  std::vector<int> degrees;
  std::vector<std::size_t> spans;
  for (const DirectionRecord& direction : patch.directions) {
    degrees.push_back(direction.degree);
    const bool spline = direction.family == BasisFamily::BSpline;
    spans.push_back(spline
                        ? static_cast<std::size_t>(KnotVector(direction.degree, direction.knots).numSpans())
                        : direction.knots.size() - 1);
  }
  return fmt::format("{} of degree {}, {} spans, {} functions",
                     patch.directions.front().family == BasisFamily::BSpline ? "NURBS" : "Lagrange",
                     fmt::join(degrees, " x "), fmt::join(spans, " x "), patch.nodes.size());
}

/// bodies: their names, if there are any.
std::string patchesText(const MeshRecord& mesh, const std::vector<std::string>& bodies) {
  std::string text;
  for (const PatchRecord& patch : mesh.patches) {
    const std::string body =
        bodies.empty() ? ""
                       : fmt::format("body {}: ", infoWords(bodies[static_cast<std::size_t>(patch.body)]));
    text += infoLine("patch", body + patchText(patch));
  }
  return text;
}

/// " of body NAME" where bodies have names.
std::string ofBody(const ModelRecord& model, const PatchRecord& patch) {
  return model.bodies.empty()
             ? ""
             : fmt::format(" of body {}", infoWords(model.bodies[static_cast<std::size_t>(patch.body)]));
}

std::string fieldText(const std::string& name, const FieldRecord& field) {
  std::string text = name;
  if (!field.components.empty()) text += fmt::format(" ({})", fmt::join(field.components, " "));
  if (!field.unit.empty()) text += fmt::format(" [{}]", infoWords(field.unit));
  if (!field.bodies.empty()) text += fmt::format(", of {} alone", fmt::join(field.bodies, ", "));
  return text;
}

std::string framesText(const ResultReader& result) {
  const std::vector<double> times = result.times();
  if (times.empty()) return infoLine("frames", "none yet");
  std::string text = infoLine("frames", fmt::format("{}, t = {} to {}", times.size(),
                                                    plainTime(times.front()), plainTime(times.back())));
  const FrameRecord last = result.frame(result.numFrames() - 1);
  if (last.mesh)
    text += infoLine("last mesh", fmt::format("{} nodes", last.mesh->numNodes)) +
            patchesText(*last.mesh, result.model().bodies);
  for (const auto& [name, field] : last.fields) text += infoLine("field", fieldText(name, field));
  for (const ContactRecord& contact : last.contact) {
    const auto& patch = meshOf(result.model(), last).patches[static_cast<std::size_t>(contact.patch)];
    text +=
        infoLine("contact", fmt::format("{} on {}{}, {} control points",
                                        !contact.pair.empty()  ? contact.pair
                                        : contact.tool.empty() ? "self"
                                                               : contact.tool,
                                        contact.face, ofBody(result.model(), patch), contact.nodes.size()));
  }
  return text;
}

std::string historyText(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return "";
  const HistoryTable history = readHistory(file);
  return infoLine("history", fmt::format("{} rows: {}", history.numRows(), fmt::join(history.columns, ", ")));
}

std::string summaryText(const RunAccount& summary) {
  std::string text =
      infoLine("run", summary.completed ? "has come to its end" : "stopped " + summary.stoppedBecause);
  for (const std::string& warning : summary.warnings) text += infoLine("warning", warning);
  for (const std::string& warning : warningsOf(summary)) text += infoLine("warning", warning);
  for (const ReactionRecord& reaction : summary.reactions)
    text += infoLine("support", fmt::format("{}: {}", reaction.support, reactionText(reaction)));
  return text;
}

/// How far the run in a directory is; of a summary that is damaged, what is wrong with it.
std::string runText(const std::filesystem::path& directory) {
  if (std::filesystem::exists(directory / "summary.yaml")) {
    try {
      return summaryText(readSummary(directory));
    } catch (const Error& error) {
      return infoLine("run", error.what());
    }
  }
  if (canBeResumed(directory))
    return infoLine("run",
                    fmt::format("not at its end; if it does not go on any more: burnish run --resume {}",
                                directory.string()));
  return "";
}

}  // namespace

std::string resultText(const ResultReader& result) {
  const ModelRecord& model = result.model();
  std::string text = infoLine("result", result.file().string());
  text += infoLine("title", infoWords(model.title));
  text += infoLine("written by", model.program);
  text += infoLine("model", fmt::format("{} dimensions, {} nodes", model.dim, model.mesh.numNodes));
  text += patchesText(model.mesh, model.bodies);
  for (const ToolRecord& tool : model.tools)
    text += infoLine("tool", fmt::format("{}: {}{}", infoWords(tool.name), shapeText(tool.shape),
                                         tool.until ? fmt::format(", until t = {:.6g}", *tool.until) : ""));
  text += framesText(result);
  const std::filesystem::path directory = result.file().parent_path();
  text += historyText(directory / "history.csv");
  text += runText(directory);
  return text;
}

std::string sceneText(const Scene& scene) {
  return scene.resolvedYaml.ends_with('\n') ? scene.resolvedYaml : scene.resolvedYaml + "\n";
}

}  // namespace burnish

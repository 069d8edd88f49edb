#include "cli/jobs/snakefile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/jobs/study_plan.h"
#include "engine/core/error.h"
#include "engine/core/shown_text.h"
#include "engine/scene/scene_reading.h"
#include "engine/schema/overrides.h"
#include "postproc/scene/scene_document.h"
#include "postproc/study/figures/figures.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// The first line, by which a workflow is known that may be written over.
constexpr std::string_view kMark = "# A study of burnish as a workflow of Snakemake.";

/// What comes before the study's own values: their names in braces.
constexpr std::string_view kHead = R"({mark}
# Written by: {again}
# Once more after a change of the study. Start it where it was written:
#     {start} -c2         two jobs at a time; -n: what is due; -k: go on when one fails
# With --config results=DIR threads=N burnish=PROGRAM: results elsewhere, threads of a run, another program.
import shutil
import subprocess
from pathlib import Path

from snakemake.common import Mode
from snakemake.exceptions import WorkflowError

STUDY = {study}
STUDY_DIGEST = "{digest}"
RESULTS = config.get("results", {results})
DOCUMENT = {document}
GALLERY = [{gallery}]
PROGRAM = config.get("burnish", {program})
THREADS = config.get("threads", 1)

# Of each run the files that it reads, its scene first; what it changes in the scene; its place in the order
# of costs, as the most expensive run begins first.
RUNS = {{
{runs}}}

# Of each figure the runs that it shows, its parts, and the files beside.
FIGURES = {{
{figures}}}
)";

/// What is the same for all studies.
constexpr std::string_view kRules = R"(

def digest(file):
    """As burnish makes it of a study: FNV-1a of 64 bits."""
    value = 0xCBF29CE484222325
    for byte in Path(file).read_bytes():
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return f"study {value:016x}"


def ended(runs):
    """Written at the end of a run, be it before its time: then that is the result."""
    return [f"{RESULTS}/runs/{run}/summary.yaml" for run in runs]


def drawn(figures):
    return [f"{RESULTS}/figures/{figure}.png" for figure in figures]


if workflow.mode == Mode.default and digest(STUDY) != STUDY_DIGEST:
    raise WorkflowError(f"{STUDY} is not as it was when {workflow.main_snakefile} was written; its top tells how to write it anew")

BURNISH = shutil.which(PROGRAM)
if BURNISH is None:
    raise WorkflowError(f"there is no program {PROGRAM}; --config burnish=PROGRAM names another")
# What another version has computed is computed again.
VERSION = subprocess.check_output([BURNISH, "--version"], text=True).strip()


rule all:
    input:
        DOCUMENT,
        # By name: an input that is missing is not made again for what is there.
        ended(RUNS),
        drawn(FIGURES),


for name, run in RUNS.items():

    rule:
        name:
            f"run_{name}"
        input:
            run["files"],
        output:
            ended([name]),
        log:
            f"{RESULTS}/runs/{name}/log.txt",
        params:
            version=VERSION,
            directory=f"{RESULTS}/runs/{name}",
            # By a function: in texts, Snakemake would look for wildcards.
            changes=lambda wildcards, changes=run["set"]: [word for change in changes for word in ("--set", change)],
        priority: run["priority"]
        threads: THREADS
        shell:
            # 3: it stopped before its end, 4: a picture is missing; the results are there.
            "{BURNISH:q} run --threads {threads} --quiet --continue {input[0]:q} -o {params.directory:q} {params.changes:q}"
            " >{log:q} 2>&1 || case $? in 3 | 4) ;; *) exit 1 ;; esac"


for name, figure in FIGURES.items():

    rule:
        name:
            f"figure_{name}"
        input:
            STUDY,
            BURNISH,
            figure["files"],
            ended(figure["runs"]),
            drawn(figure["parts"]),
        output:
            drawn([name]),
        log:
            f"{RESULTS}/drawn/{name}.log",
        params:
            figure=name,
        shell:
            "{BURNISH:q} figures {STUDY:q} -o {RESULTS:q} --only {params.figure:q} --draw-only >{log:q} 2>&1"


rule document:
    input:
        STUDY,
        BURNISH,
        ended(RUNS),
        drawn(FIGURES),
    output:
        DOCUMENT,
        f"{RESULTS}/runs.csv",
    shell:
        # Finds everything done but this; what is not of this study after all, it does itself.
        "{BURNISH:q} figures {STUDY:q} -o {RESULTS:q} --jobs {threads} --document {output[0]:q} {GALLERY:q}"
)";

/// As a literal of Python.
std::string python(std::string_view text) {
  std::string literal = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') literal += '\\';
    if (static_cast<unsigned char>(c) < ' ')
      literal += fmt::format("\\x{:02x}", c);
    else
      literal += c;
  }
  return literal + '"';
}

std::string python(const std::vector<std::string>& texts) {
  std::vector<std::string> literals;
  for (const std::string& text : texts) literals.push_back(python(text));
  return fmt::format("[{}]", fmt::join(literals, ", "));
}

/// The name of a file without parts that lead nowhere, which Snakemake warns of. Throws `Error` for one that
/// it cannot work with.
std::string named(const fs::path& file) {
  fs::path name;
  for (const fs::path& part : file)
    if (part != ".") name /= part;
  std::string text = name.string();
  const std::string fault =
      text.find_first_of("{}\n") == std::string::npos
          ? encodingFault(text)
          : "found a brace or the end of a line; allowed: file names without, as Snakemake "
            "takes braces for wildcards";
  if (!fault.empty())
    throw Error(fmt::format("--workflow: {}: {}", forMessage(text, kLongestShownText), fault));
  return text;
}

std::vector<std::string> named(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(named(file));
  return names;
}

void collectFiles(const YamlNode& node, const fs::path& directory, std::vector<fs::path>& files) {
  if (node.key == "file" && node.kind == YamlNode::Kind::Scalar && !node.text.empty())
    files.push_back(directory / node.text);
  for (const YamlNode& child : node.children) collectFiles(child, directory, files);
}

/// The files that a run reads: its scene, and those that the scene names, relative to itself.
std::vector<fs::path> filesOf(const StudyRun& run) {
  Diagnostics errors(run.scene.string(), run.overrides);
  YamlNode root = parseDocument(readDocument(run.scene, kSceneKind), kSceneKind, errors);
  for (std::size_t i = 0; i < run.overrides.size(); ++i)
    applyOverride(root, run.overrides[i], static_cast<int>(i) + 1, errors);
  errors.throwIfAny();
  std::vector<fs::path> files{run.scene};
  collectFiles(root, run.scene.parent_path(), files);
  return files;
}

std::string runs(const Study& study) {
  std::vector<double> costs;
  for (const StudyRun& run : study.runs)
    costs.push_back(expectedCost(readSceneDocument(run.scene, run.overrides).scene));
  std::vector<double> ascending = costs;
  std::sort(ascending.begin(), ascending.end());
  std::string lines;
  for (std::size_t k = 0; k < study.runs.size(); ++k) {
    const StudyRun& run = study.runs[k];
    const auto place = std::lower_bound(ascending.begin(), ascending.end(), costs[k]) - ascending.begin();
    lines += fmt::format("    {}: {{\"files\": {}, \"set\": {}, \"priority\": {}}},\n", python(run.name),
                         python(named(filesOf(run))), python(run.overrides), place);
  }
  return lines;
}

std::string figures(const Study& study) {
  std::string lines;
  for (const FigureSpec& figure : study.spec.figures) {
    std::vector<std::string> shown;
    for (const StudyRun* run : runsOf(study, figure)) shown.push_back(run->name);
    lines += fmt::format("    {}: {{\"runs\": {}, \"parts\": {}, \"files\": {}}},\n", python(figure.name),
                         python(shown), python(partsOf(figure)), python(named(inputsOf(study, figure))));
  }
  return lines;
}

/// The command that writes the same workflow.
std::string commandAgain(const Study& study, const SnakefileOptions& options) {
  std::string command = fmt::format("burnish figures {} --workflow snakemake -o {}",
                                    shellWord(named(study.file)), shellWord(named(options.file)));
  if (!options.results.empty()) command += " --results " + shellWord(named(options.results));
  if (!options.document.empty()) command += " --document " + shellWord(named(options.document));
  if (!options.gallery.empty()) command += " --gallery " + shellWord(named(options.gallery));
  return command;
}

/// Whether nothing is there that somebody else would miss.
bool mayBeWritten(const fs::path& file) {
  std::error_code unknown;
  if (!fs::exists(fs::symlink_status(file, unknown))) return true;
  std::ifstream present(file);
  std::string line;
  return std::getline(present, line) && line == kMark;
}

}  // namespace

std::string snakemakeCommand(const fs::path& file) {
  return file == "Snakefile" ? "snakemake" : "snakemake -s " + shellWord(file.string());
}

std::string snakefileText(const Study& study, const SnakefileOptions& options) {
  const std::string stem = named(study.file.stem());
  const std::string results = options.results.empty() ? "out/" + stem : named(options.results);
  const std::string document =
      options.document.empty() ? "RESULTS + " + python("/" + stem + ".md") : python(named(options.document));
  const std::string gallery =
      options.gallery.empty() ? "" : python("--gallery") + ", " + python(named(options.gallery));
  return fmt::format(kHead, fmt::arg("mark", kMark), fmt::arg("again", commandAgain(study, options)),
                     fmt::arg("start", snakemakeCommand(options.file)),
                     fmt::arg("study", python(named(study.file))),
                     fmt::arg("digest", studyDigest(study.file)), fmt::arg("results", python(results)),
                     fmt::arg("document", document), fmt::arg("gallery", gallery),
                     fmt::arg("program", python(named(fs::read_symlink("/proc/self/exe")))),
                     fmt::arg("runs", runs(study)), fmt::arg("figures", figures(study))) +
         std::string(kRules);
}

void writeSnakefile(const Study& study, const SnakefileOptions& options) {
  if (!mayBeWritten(options.file))
    throw Error(fmt::format("-o: {} is there and no workflow that burnish wrote; choose another name",
                            options.file.string()));
  writeText(snakefileText(study, options), options.file);
}

}  // namespace burnish

#include "cli/completion/value_candidates.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

#include "cli/command_tree.h"
#include "cli/completion/file_candidates.h"
#include "cli/completion/key_candidates.h"
#include "cli/offered_words.h"
#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/scene/schema_boundary.h"
#include "engine/schema/diagnostics.h"
#include "engine/schema/yaml_tree.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/foreign/foreign_fields.h"
#include "postproc/foreign/foreign_file.h"
#include "postproc/foreign/foreign_source.h"
#include "postproc/probe/probed_fields.h"
#include "postproc/scene/scene_listing.h"
#include "postproc/study/study_listing.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

using Candidates = std::vector<Candidate>;

const std::vector<std::string> kResults{"RESULT", "DIR", "RESULT|SCENE|FILE", "HISTORY"};
const std::vector<std::string> kDocumentEndings{".yaml", ".yml"};

Candidates plain(const std::vector<std::string>& texts) {
  Candidates out;
  for (const std::string& text : texts) out.push_back({text, ""});
  return out;
}

/// Of a file of another program.
std::vector<ForeignBlock> lastBlocks(const std::string& name) {
  const ForeignFile file(name);
  return file.blocks(file.times().empty() ? 0 : file.times().size() - 1);
}

/// Of the result or the file on the line; the last frame says what there is. Along faces and below them there are their
/// own axes, too.
Candidates fieldsOf(const GivenLine& line) {
  const std::string given = line.argument(kResults);
  if (!foreignKind(given).empty()) return plain(foreignFieldNames(foreignFieldsOf(lastBlocks(given))));
  const ResultReader result(given);
  const FrameRecord frame = result.frame(result.numFrames() - 1);
  std::vector<std::string> names = fieldNames(frame);
  const bool hasAxes = !line.valueOf("--depth").empty() || !line.valueOf("--face").empty();
  if (hasAxes && frame.fields.contains("stress"))
    for (std::string& name : surfaceFieldNames()) names.push_back(std::move(name));
  return plain(names);
}

Candidates componentsOf(const GivenLine& line) {
  const std::string field = line.valueOf("--field");
  std::vector<std::string> components;
  for (const auto& [name, about] : fieldsOf(line)) {
    if (!field.empty() && name == field) components.emplace_back("magnitude");
    const std::size_t point = name.rfind('.');
    if (point == std::string::npos || (!field.empty() && name.substr(0, point) != field)) continue;
    if (std::ranges::find(components, name.substr(point + 1)) == components.end())
      components.push_back(name.substr(point + 1));
  }
  return plain(components);
}

Candidates framesOf(const GivenLine& line) {
  Candidates out;
  const std::string given = line.argument(kResults);
  const std::vector<double> times =
      foreignKind(given).empty() ? ResultReader(given).times() : ForeignFile(given).times();
  for (std::size_t k = 0; k < times.size(); ++k) {
    out.push_back({std::to_string(k), fmt::format("t = {:.9g}", times[k])});
    out.push_back({fmt::format("time={:.9g}", times[k]), fmt::format("frame {}", k)});
  }
  return out;
}

Candidates bodiesOf(const GivenLine& line) {
  const std::string given = line.argument(kResults);
  if (foreignKind(given).empty()) return plain(ResultReader(given).model().bodies);
  std::vector<std::string> names;
  for (const ForeignBlock& block : lastBlocks(given))
    if (!block.name.empty()) names.push_back(block.name);
  return plain(names);
}

Candidates toolsOf(const GivenLine& line) {
  const ResultReader result(line.argument(kResults));
  std::vector<std::string> names;
  for (const ToolRecord& tool : result.model().tools) names.push_back(tool.name);
  return plain(names);
}

Candidates facesOf(const GivenLine& line) {
  std::vector<std::string> names = faceNames();
  names.resize(static_cast<std::size_t>(2 * ResultReader(line.argument(kResults)).model().dim));
  return plain(names);
}

Candidates columnsOf(const GivenLine& line) {
  const fs::path run = line.argument(kResults);
  std::error_code status;
  return plain(readHistory(fs::is_directory(run, status) ? run / "history.csv" : run).columns);
}

/// Names of the mappings in a list of a document.
Candidates namesIn(const fs::path& document, const std::string& list) {
  Diagnostics errors("", {});
  const auto tree = parseYaml(readText(document), 0, errors);
  const YamlNode* entries = tree ? tree->find(list) : nullptr;
  Candidates out;
  if (entries == nullptr) return out;
  for (const YamlNode& entry : entries->children) {
    const YamlNode *name = entry.find("name"), *caption = entry.find("caption");
    if (name != nullptr) out.push_back({name->text, caption == nullptr ? "" : caption->text});
  }
  return out;
}

Candidates commandsOf(const CLI::App& program) {
  Candidates out;
  for (const CLI::App* command : shownCommands(program))
    out.push_back({command->get_name(), command->get_description()});
  return out;
}

Candidates resultFiles(const GivenLine& line) {
  std::vector<std::string> endings = foreignEndings();
  endings.emplace_back(".h5");
  return fileCandidates(line.word, endings);
}

/// What a name in the type of an option, or the name of an argument, stands for.
using Maker = std::function<Candidates(const CLI::App& program, const GivenLine& line)>;

Maker files(const std::vector<std::string>& endings) {
  return [=](const CLI::App&, const GivenLine& line) { return fileCandidates(line.word, endings); };
}

const std::map<std::string, Maker>& makers() {
  const auto ofLine = [](Candidates (*make)(const GivenLine&)) {
    return [make](const CLI::App&, const GivenLine& line) { return make(line); };
  };
  static const std::map<std::string, Maker> table{
      {"SCENE", files(kDocumentEndings)},
      {"STUDY", files(kDocumentEndings)},
      {"DIR", files({})},
      {"RESULT", ofLine(resultFiles)},
      {"HISTORY", files({".csv"})},
      {"PICTURE", files({".png"})},
      {"FILE", files({""})},
      {"ACTUAL", files({""})},
      {"BASELINE", files({""})},
      {"FIELD", ofLine(fieldsOf)},
      {"COMPONENT", ofLine(componentsOf)},
      {"BODY", ofLine(bodiesOf)},
      {"A-B", ofLine(framesOf)},
      {"EXPR", ofLine(columnsOf)},
      {"COLUMN", ofLine(columnsOf)},
      {"FIGURE",
       [](const CLI::App&, const GivenLine& line) { return namesIn(line.argument({"STUDY"}), "figures"); }},
      {"COMMAND", [](const CLI::App& program, const GivenLine&) { return commandsOf(program); }},
      {"PATH=VALUE",
       [](const CLI::App&, const GivenLine& line) {
         return keyCandidates(sceneDeclarations(), line.word, KeyUse::Set, line.argument({"SCENE"}));
       }},
      {"KEY", [](const CLI::App&, const GivenLine& line) {
         const bool isStudy = std::ranges::any_of(
             line.values, [](const auto& given) { return given.first->check_name("--study"); });
         return keyCandidates(isStudy ? studyDeclarations() : sceneDeclarations(), line.word,
                              KeyUse::Explained, {});
       }}};
  return table;
}

/// Options of names that have no type of their own.
const std::map<std::string, Candidates (*)(const GivenLine&)>& namesOfOptions() {
  static const std::map<std::string, Candidates (*)(const GivenLine&)> table{
      {"--body", bodiesOf}, {"--face", facesOf}, {"--tool", toolsOf}};
  return table;
}

/// The type of an option's value, or the name of an argument.
std::string typeName(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (option.get_positional()) return option.get_name(true);
  return type.substr(0, type.find(':'));
}

std::vector<std::string> partsOf(const std::string& type) {
  std::vector<std::string> parts;
  std::istringstream text(type);
  for (std::string part; std::getline(text, part, '|');) parts.push_back(part);
  return parts;
}

/// {x,y} of a check of CLI11.
std::vector<std::string> checkedWords(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find(":{"), end = type.find('}');
  std::vector<std::string> words;
  if (begin == std::string::npos || end == std::string::npos) return words;
  std::istringstream list(type.substr(begin + 2, end - begin - 2));
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

void append(Candidates& out, Candidates more) {
  out.insert(out.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<Candidate> valueCandidates(const CLI::App& program, const GivenLine& line) {
  Candidates out = plain(offeredWords(*line.of));
  append(out, plain(checkedWords(*line.of)));
  std::string type = typeName(*line.of);
  if (type.ends_with(",...")) type.resize(type.size() - 4);
  if (const auto maker = namesOfOptions().find(line.of->get_name());
      maker != namesOfOptions().end() && (type == "TEXT" || type == "NAME"))
    append(out, maker->second(line));
  const std::vector<std::string> parts = partsOf(type);
  // FILE.csv|pdf: endings of a file's name.
  if (const std::size_t point = parts.front().find('.'); point != std::string::npos) {
    std::vector<std::string> endings{parts.front().substr(point)};
    for (std::size_t k = 1; k < parts.size(); ++k)
      if (parts[k] == "-")
        out.push_back({"-", "standard output"});
      else
        endings.push_back("." + parts[k]);
    append(out, fileCandidates(line.word, endings));
    return out;
  }
  for (const std::string& part : parts) {
    const auto maker = makers().find(part);
    if (maker != makers().end())
      append(out, maker->second(program, line));
    else if (!part.empty() && std::islower(static_cast<unsigned char>(part.front())) != 0)
      out.push_back(
          {part.substr(0, part.find('=') == std::string::npos ? part.size() : part.find('=') + 1), ""});
  }
  return out;
}

}  // namespace burnish

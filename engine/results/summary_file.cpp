#include "engine/results/summary_file.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <span>
#include <system_error>
#include <utility>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

/// The numbers of a rezoning in the file.
constexpr std::array<std::pair<const char*, double RezoningRecord::*>, 7> kRezoningNumbers{
    {{"time", &RezoningRecord::time},
     {"energy_lost", &RezoningRecord::energyLost},
     {"gap_work", &RezoningRecord::gapWork},
     {"volume_drift", &RezoningRecord::volumeDrift},
     {"boundary_error", &RezoningRecord::boundaryError},
     {"quality", &RezoningRecord::quality},
     {"smallest_span", &RezoningRecord::smallestSpan}}};

std::filesystem::path summaryFile(const std::filesystem::path& directory) {
  return directory / "summary.yaml";
}

std::vector<std::string> exactly(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(fmt::format("{}", number));
  return texts;
}

void writeReactions(YAML::Emitter& yaml, const std::vector<ReactionRecord>& reactions) {
  yaml << YAML::Key << "reactions" << YAML::Value << YAML::BeginSeq;
  for (const ReactionRecord& reaction : reactions)
    yaml << YAML::Flow << YAML::BeginMap << YAML::Key << "support" << YAML::Value << reaction.support
         << YAML::Key << "place" << YAML::Value << reaction.place << YAML::Key << "force" << YAML::Value
         << exactly(reaction.force) << YAML::Key << "moment" << YAML::Value << exactly(reaction.moment)
         << YAML::Key << "largest" << YAML::Value << fmt::format("{}", reaction.largest) << YAML::Key
         << "largest_time" << YAML::Value << fmt::format("{}", reaction.largestTime) << YAML::EndMap;
  yaml << YAML::EndSeq;
}

ReactionRecord readReaction(const YAML::Node& stored) {
  return {.support = stored["support"].as<std::string>(),
          .place = stored["place"].as<std::string>(),
          .force = stored["force"].as<std::vector<double>>(),
          .moment = stored["moment"].as<std::vector<double>>(),
          .largest = stored["largest"].as<double>(),
          .largestTime = stored["largest_time"].as<double>()};
}

}  // namespace

void writeSummary(const std::filesystem::path& directory, const SummaryRecord& summary) {
  YAML::Emitter yaml;
  yaml << YAML::BeginMap;
  yaml << YAML::Key << "program" << YAML::Value << summary.program;
  yaml << YAML::Key << "completed" << YAML::Value << summary.completed;
  if (!summary.completed) yaml << YAML::Key << "stopped_because" << YAML::Value << summary.stoppedBecause;
  if (!summary.advice.empty()) yaml << YAML::Key << "advice" << YAML::Value << summary.advice;
  if (!summary.doubts.empty()) {
    yaml << YAML::Key << "doubts" << YAML::Value << YAML::BeginSeq;
    for (const DoubtRecord& doubt : summary.doubts) {
      yaml << YAML::BeginMap << YAML::Key << "what" << YAML::Value << doubt.what << YAML::Key << "first_time"
           << YAML::Value << fmt::format("{}", doubt.firstTime) << YAML::Key << "steps" << YAML::Value
           << doubt.steps;
      if (!doubt.detail.empty()) yaml << YAML::Key << "detail" << YAML::Value << doubt.detail;
      yaml << YAML::EndMap;
    }
    yaml << YAML::EndSeq;
  }
  if (!summary.warnings.empty()) yaml << YAML::Key << "warnings" << YAML::Value << summary.warnings;
  if (!summary.idleTools.empty()) yaml << YAML::Key << "idle_tools" << YAML::Value << summary.idleTools;
  if (!summary.reactions.empty()) writeReactions(yaml, summary.reactions);
  if (!summary.rezonings.empty()) {
    yaml << YAML::Key << "rezonings" << YAML::Value << YAML::BeginSeq;
    for (const RezoningRecord& rezoning : summary.rezonings) {
      yaml << YAML::Flow << YAML::BeginMap;
      for (const auto& [name, member] : kRezoningNumbers)
        yaml << YAML::Key << name << YAML::Value << fmt::format("{}", rezoning.*member);
      yaml << YAML::Key << "iterations" << YAML::Value << rezoning.iterations << YAML::EndMap;
    }
    yaml << YAML::EndSeq;
  }
  if (!summary.rezoningFailure.empty())
    yaml << YAML::Key << "rezoning_failure" << YAML::Value << summary.rezoningFailure;
  for (const auto& [name, value] : summary.numbers)
    yaml << YAML::Key << name << YAML::Value << fmt::format("{}", value);  // shortest that reads back exactly
  yaml << YAML::EndMap << YAML::Newline;
  writeFileAtomically(summaryFile(directory), std::as_bytes(std::span(yaml.c_str(), yaml.size())));
}

SummaryRecord readSummary(const std::filesystem::path& directory) {
  const auto file = summaryFile(directory);
  try {
    SummaryRecord summary;
    for (const auto& entry : YAML::LoadFile(file.string())) {
      const auto name = entry.first.as<std::string>();
      if (name == "program")
        summary.program = entry.second.as<std::string>();
      else if (name == "completed")
        summary.completed = entry.second.as<bool>();
      else if (name == "stopped_because")
        summary.stoppedBecause = entry.second.as<std::string>();
      else if (name == "advice")
        summary.advice = entry.second.as<std::string>();
      else if (name == "doubts")
        for (const auto& doubt : entry.second)
          summary.doubts.push_back({doubt["what"].as<std::string>(), doubt["first_time"].as<double>(),
                                    doubt["steps"].as<int>(), doubt["detail"].as<std::string>("")});
      else if (name == "warnings")
        summary.warnings = entry.second.as<std::vector<std::string>>();
      else if (name == "idle_tools")
        summary.idleTools = entry.second.as<std::vector<std::string>>();
      else if (name == "reactions")
        for (const auto& stored : entry.second) summary.reactions.push_back(readReaction(stored));
      else if (name == "rezoning_failure")
        summary.rezoningFailure = entry.second.as<std::string>();
      else if (name == "rezonings")
        for (const auto& stored : entry.second) {
          auto& rezoning = summary.rezonings.emplace_back();
          for (const auto& [number, member] : kRezoningNumbers)
            rezoning.*member = stored[number].as<double>();
          rezoning.iterations = stored["iterations"].as<int>();
        }
      else if (double number = 0.0; YAML::convert<double>::decode(entry.second, number))
        summary.numbers[name] = number;
    }
    if (summary.program.empty()) throw Error(fmt::format("{}: is not the summary of a run", file.string()));
    return summary;
  } catch (const YAML::Exception& error) {
    throw Error(fmt::format("{}: cannot be read as the summary of a run: {}", file.string(), error.what()));
  }
}

void removeSummary(const std::filesystem::path& directory) {
  std::error_code status;
  std::filesystem::remove(summaryFile(directory), status);
  if (status)
    throw Error(fmt::format("cannot remove {}: {}", summaryFile(directory).string(), status.message()));
}

}  // namespace burnish

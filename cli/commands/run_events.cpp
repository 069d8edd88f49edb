#include "cli/commands/run_events.h"

#include <json/value.h>

#include "cli/console.h"
#include "postproc/text/described_json.h"
#include "postproc/text/json_text.h"

namespace burnish {
namespace {

/// At once: who reads it wants to know now.
void printEvent(const char* name, Json::Value value) {
  value["event"] = name;
  printText(compactText(value, kJsonDigits) + "\n");
  flushOutput();
}

}  // namespace

void printStepEvent(const RunProgress& progress, double elapsedSeconds) {
  Json::Value value;
  value["step"] = progress.step;
  value["time"] = progress.time;
  value["end_time"] = progress.endTime;
  value["iterations"] = progress.iterations;
  value["cut_backs"] = progress.totalCuts;
  value["seconds"] = elapsedSeconds;
  printEvent("step", std::move(value));
}

void printFrameEvent(int index, double time) {
  Json::Value value;
  value["index"] = index;
  value["time"] = time;
  printEvent("frame", std::move(value));
}

void printPictureEvent(const std::filesystem::path& file) {
  Json::Value value;
  value["file"] = file.string();
  printEvent("picture", std::move(value));
}

void printEndEvent(const RunAccount& account, const std::filesystem::path& directory) {
  Json::Value value = describedJson(account);
  value["directory"] = directory.string();
  printEvent("end", std::move(value));
}

}  // namespace burnish

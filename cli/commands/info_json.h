#pragma once
#include <json/value.h>

#include "engine/results/result_reader.h"
#include "engine/schema/yaml_tree.h"
#include "postproc/foreign/foreign_file.h"

/// What `burnish info --json` prints.
namespace burnish {

/// Model, frames, fields, columns of the history and, of a run that has ended, its account.
Json::Value resultJson(const ResultReader& result);

/// Times, and blocks and fields of the last instant.
Json::Value foreignJson(const ForeignFile& file);

/// A document with its numbers and truth values as such.
Json::Value documentJson(const YamlNode& node);

}  // namespace burnish

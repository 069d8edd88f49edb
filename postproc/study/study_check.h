#pragma once
#include "engine/schema/yaml_tree.h"
#include "postproc/study/run_outlook.h"
#include "postproc/study/study.h"

namespace burnish {

/// Adds to `errors` what is wrong between the values of a study before its runs are known: names that are
/// given twice, lists of different length, runs that would be too many.
void checkNames(const StudySpec& spec, const YamlNode& root, Diagnostics& errors);

/// The same for what refers to runs, parameters, figures and measures.
void checkReferences(const Study& study, const YamlNode& root, Diagnostics& errors);

/// The same for what figures and measures ask for that results will not have. outlooks: one for each run.
void checkOutlooks(const Study& study, const std::vector<RunOutlook>& outlooks, const YamlNode& root,
                   Diagnostics& errors);

}  // namespace burnish

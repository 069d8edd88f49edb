#pragma once
#include <muParser.h>

#include <string>
#include <vector>

/// The words that every formula knows beside its variables.
namespace burnish::inline core {

/// Names of functions, such as sin.
std::vector<std::string> formulaFunctions();

/// "functions are abs, acos, ...; constants are pi and e".
std::string formulaWords();

/// Lets a parser know the constants pi and e, but for those that are names of something else there.
void defineConstants(mu::Parser& parser, const std::vector<std::string>& names);

/// What is wrong with a formula that the parser has refused, in words: a function that does not exist, with
/// the nearest one and all that there are, or what the parser says.
std::string formulaProblem(const std::string& formula, const mu::ParserError& problem);

/// " (did you mean NAME?)", or nothing.
std::string orNearest(const std::string& word, const std::vector<std::string>& names);

/// Names with commas, as many as a message can hold.
std::string listed(const std::vector<std::string>& names);

}  // namespace burnish::inline core

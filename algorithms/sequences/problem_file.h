#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sequences/sequence_problem.h"

namespace plat::sequences {

/// A problem as a file states it.
struct ReadProblem {
  SequenceProblem problem;
  /// What was done to the numbers, one line each: steps that were found, amounts that were rounded,
  /// bounds that were narrowed to whole steps.
  std::vector<std::string> notes;
};

/// Reads a problem from JSON (docs/sequence_problem.md, docs/sequence_problem.schema.json).
///
/// Guarantees: 1. an unknown key, name or type, or a value out of its range is refused with source,
/// key, value and what is allowed;  2. a number that is no whole multiple of its step
/// (`kMultipleTolerance`) is refused, unless the resource says `"round": true`;  3. where no step
/// is given it is the greatest common divisor of the elements' and transitions' values, and a note
/// tells it;  4. what `problem_json` writes is read back as the same problem.
/// @param source  names the text in messages
/// @throws InputError
/// Paper: [Har, Sec. 3.3.1]
ReadProblem parse_problem(std::string_view text, const std::string& source);

/// The problem in a file: JSON, or a resource constrained shortest path problem as OR-Library
/// writes it, which begins with a number.
/// @throws InputError where the file cannot be read, or as `parse_problem`
ReadProblem read_problem(const std::filesystem::path& file);

/// The problem as JSON, in the units of its resources.
/// @throws InputError for elements, key points or resources that share a name: a file tells them
///         apart by it
std::string problem_json(const SequenceProblem& problem);

}  // namespace plat::sequences

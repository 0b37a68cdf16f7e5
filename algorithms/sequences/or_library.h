#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "sequences/sequence_problem.h"

namespace plat::sequences {

/// Reads one resource constrained shortest path problem of Beasley and Christofides as OR-Library
/// writes it: numbers of vertices, arcs and resources; lower and upper limits by resource; what
/// each vertex uses; per arc its tail, head, cost and uses. An element is a vertex, named by its
/// number; the first vertex is the only front and the last the only back.
///
/// Guarantees: 1. elements and transitions come in the order of the text;  2. what does not fit the
/// format is refused with its line, its meaning and the allowed range.
/// @param text  the file's contents; layout in lines means nothing
/// @param name  of the file, for messages
/// @throws InputError
/// Paper:       [BC89]
/// Deviation:   a path may meet a vertex twice; the optimum is the same, since costs and uses are
///              not negative and no instance has lower limits
SequenceProblem parse_or_library(std::string_view text, std::string_view name);

/// The problem in a file.
/// @throws InputError where the file cannot be read, or as `parse_or_library`
SequenceProblem read_or_library(const std::filesystem::path& file);

/// A published optimum; no cost: the instance has no feasible path.
struct PublishedOptimum {
  int instance = 0;
  std::optional<Cost> cost;
};

/// The optima beside the instances: a heading, then a line for each with its number and cost, 0
/// where there is no path.
/// @throws InputError with file and line
std::vector<PublishedOptimum> read_or_library_optima(const std::filesystem::path& file);

}  // namespace plat::sequences

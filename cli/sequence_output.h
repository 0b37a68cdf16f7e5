#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sequences/bound_use.h"
#include "sequences/sequence_search.h"

namespace plat::cli {

/// Where lines go: standard output, or a file that appears whole when `finish` is called.
class LineOutput {
 public:
  /// @param path  empty: standard output
  /// @throws InputError where the file cannot be written
  explicit LineOutput(std::string path);
  ~LineOutput();  ///< without `finish`, nothing is left
  LineOutput(const LineOutput&) = delete;
  LineOutput& operator=(const LineOutput&) = delete;

  void line(const std::string& text);
  void finish();

 private:
  std::string path_;
  std::string temporary_;
  std::FILE* file_ = nullptr;
};

/// An amount or a cost in the user's unit, as short as it reads back: 3 steps of 0.2 are 0.6.
std::string in_unit(std::int64_t steps, double step);

/// "12", "8..10", "8.." or "..10" in the resource's unit.
std::string bounds_text(const sequences::SequenceProblem& problem,
                        const sequences::BoundUse& bound);

/// What a path places and consumes, for people: a heading and a few lines.
std::string sequence_text(const sequences::CompiledProblem& compiled,
                          const sequences::SequenceProblem& problem,
                          const sequences::SequencePath& path, std::size_t rank);
/// The same for programs: cost, elements (or key_points and segments), consumed, bounds.
nlohmann::ordered_json sequence_json(const sequences::CompiledProblem& compiled,
                                     const sequences::SequenceProblem& problem,
                                     const sequences::SequencePath& path, std::size_t rank);

}  // namespace plat::cli

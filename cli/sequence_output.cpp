#include "sequence_output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "core/failure.h"
#include "sequences/diagnosis.h"

namespace plat::cli {

using nlohmann::ordered_json;
using sequences::Arrangement;
using sequences::BoundPlace;
using sequences::BoundUse;
using sequences::CompiledProblem;
using sequences::ElementIndex;
using sequences::kUnbounded;
using sequences::SequencePath;
using sequences::SequenceProblem;

LineOutput::LineOutput(std::string path) : path_(std::move(path)) {
  if (path_.empty()) {
    file_ = stdout;
    return;
  }
  temporary_ = path_ + ".part";
  file_ = std::fopen(temporary_.c_str(), "wb");
  if (file_ == nullptr)
    throw InputError(fmt::format("--out {}: no file can be written there", path_));
}

LineOutput::~LineOutput() {
  if (path_.empty() || file_ == nullptr) return;
  std::fclose(file_);
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void LineOutput::line(const std::string& text) { fmt::print(file_, "{}\n", text); }

void LineOutput::finish() {
  if (path_.empty()) {
    std::fflush(stdout);
    return;
  }
  const bool is_whole = std::fclose(file_) == 0;
  file_ = nullptr;
  std::error_code error;
  if (is_whole) std::filesystem::rename(temporary_, path_, error);
  if (!is_whole || error) throw InputError(fmt::format("--out {}: cannot be written", path_));
}

namespace {

double step_of(const SequenceProblem& problem, const BoundPlace& place) {
  return problem.database.resources[place.resource].step;
}

const std::string& element_name(const SequenceProblem& problem, ElementIndex element) {
  return problem.database.elements[element].name;
}

/// "gable, wall x3, gable"
std::string row_text(const SequenceProblem& problem, const std::vector<ElementIndex>& row) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < row.size();) {
    std::size_t same = i;
    while (same < row.size() && row[same] == row[i]) ++same;
    words.push_back(element_name(problem, row[i]));
    if (same - i > 1) words.back() += fmt::format(" x{}", same - i);
    i = same;
  }
  return words.empty() ? "(none)" : fmt::format("{}", fmt::join(words, ", "));
}

bool is_structure(const SequenceProblem& problem) { return !problem.structure.key_points.empty(); }

ordered_json number(std::int64_t steps, double step) {
  return ordered_json::parse(in_unit(steps, step));
}

}  // namespace

std::string in_unit(std::int64_t steps, double step) {
  return fmt::format("{:.15g}", static_cast<double>(steps) * step);
}

std::string bounds_text(const SequenceProblem& problem, const BoundUse& bound) {
  const double step = step_of(problem, bound.place);
  const auto& [min, max] = bound.bounds;
  if (min == max) return in_unit(min, step);
  return fmt::format("{}..{}", min == 0 ? "" : in_unit(min, step),
                     max == kUnbounded ? "" : in_unit(max, step));
}

std::string sequence_text(const CompiledProblem& compiled, const SequenceProblem& problem,
                          const SequencePath& path, std::size_t rank) {
  const Arrangement found = arrangement(compiled, problem, path);
  const sequences::ArrangementByPart parts = by_part(problem.structure, found);
  std::string out =
      fmt::format("{}: cost {}", rank, in_unit(found.cost, problem.database.cost_step));
  for (std::size_t k = 0; k < parts.key_points.size(); ++k)
    out += fmt::format("\n   {} = {}", problem.structure.key_points[k].name,
                       element_name(problem, parts.key_points[k]));
  for (std::size_t s = 0; s < parts.segments.size(); ++s)
    out += "\n   " + (is_structure(problem) ? segment_name(problem, s) + ": " : "") +
           row_text(problem, parts.segments[s]);
  std::vector<std::string> uses;
  for (const BoundUse& use : bound_uses(compiled, path))
    uses.push_back(fmt::format("{} {} of {}", place_name(problem, use.place),
                               in_unit(use.consumed, step_of(problem, use.place)),
                               bounds_text(problem, use)));
  if (!uses.empty()) out += fmt::format("\n   {}", fmt::join(uses, "; "));
  return out;
}

ordered_json sequence_json(const CompiledProblem& compiled, const SequenceProblem& problem,
                           const SequencePath& path, std::size_t rank) {
  const Arrangement found = arrangement(compiled, problem, path);
  const sequences::ArrangementByPart parts = by_part(problem.structure, found);
  ordered_json out{{"rank", rank}, {"cost", number(found.cost, problem.database.cost_step)}};
  const auto names = [&](const std::vector<ElementIndex>& row) {
    ordered_json list = ordered_json::array();
    for (const ElementIndex e : row) list.push_back(element_name(problem, e));
    return list;
  };
  if (is_structure(problem)) {
    for (std::size_t k = 0; k < parts.key_points.size(); ++k)
      out["key_points"][problem.structure.key_points[k].name] =
          element_name(problem, parts.key_points[k]);
    for (std::size_t s = 0; s < parts.segments.size(); ++s)
      out["segments"][segment_name(problem, s)] = names(parts.segments[s]);
  } else {
    out["elements"] = names(parts.segments.front());
  }
  out["consumed"] = ordered_json::object();
  for (std::size_t r = 0; r < found.consumed.size(); ++r)
    out["consumed"][problem.database.resources[r].name] =
        number(found.consumed[r], problem.database.resources[r].step);
  if (!is_structure(problem)) return out;
  for (const BoundUse& use : bound_uses(compiled, path)) {
    if (!use.place.segment) continue;
    out["consumed_by_segment"][segment_name(problem, *use.place.segment)]
       [problem.database.resources[use.place.resource].name] =
           number(use.consumed, step_of(problem, use.place));
  }
  return out;
}

}  // namespace plat::cli

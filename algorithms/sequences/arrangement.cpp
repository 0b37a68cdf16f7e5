#include <algorithm>

#include "sequences/compiled_problem.h"

namespace plat::sequences {
namespace {

/// The transition that led to a step, or `kNoTransition`.
std::uint32_t transition_into(const CompiledProblem& compiled, const SequencePath& path,
                              std::size_t step) {
  if (step == 0) return kNoTransition;
  const SearchGraph& graph = compiled.graph;
  const std::uint32_t zone = graph.zone_of(path.steps[step].node);
  if (zone != graph.zone_of(path.steps[step - 1].node))
    return compiled.link_transitions[path.steps[step].arc];
  return compiled.arc_transitions[*graph.zones[zone].table][path.steps[step].arc];
}

void add(std::vector<std::int64_t>& sums, const std::vector<Amount>& amounts) {
  for (std::size_t r = 0; r < amounts.size(); ++r) sums[r] += amounts[r];
}

bool is_of_segment(const Placement& placement, std::uint32_t segment) {
  return placement.place == Placement::Place::kSegment && placement.index == segment;
}

/// Segments that the path met from their other end are turned round.
void turn_segments(const CompiledProblem& compiled, std::vector<Placement>& placements) {
  for (auto first = placements.begin(); first != placements.end();) {
    if (first->place == Placement::Place::kKeyPoint) {
      ++first;
      continue;
    }
    const std::uint32_t segment = first->index;
    const auto last = std::find_if(first, placements.end(), [segment](const Placement& placement) {
      return !is_of_segment(placement, segment);
    });
    if (compiled.is_walked_backwards[segment]) std::reverse(first, last);
    first = last;
  }
}

}  // namespace

Arrangement arrangement(const CompiledProblem& compiled, const SequenceProblem& problem,
                        const SequencePath& path) {
  Arrangement result{path.cost, {}, {}};
  result.consumed.assign(problem.database.resources.size(), 0);
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    const std::uint32_t transition = transition_into(compiled, path, i);
    if (transition != kNoTransition)
      add(result.consumed, problem.database.transitions[transition].uses);
    const auto& placement = compiled.placements[path.steps[i].node];
    if (!placement) continue;
    result.placements.push_back(*placement);
    add(result.consumed, problem.database.elements[placement->element].uses);
  }
  turn_segments(compiled, result.placements);
  return result;
}

ArrangementByPart by_part(const Structure& structure, const Arrangement& arrangement) {
  ArrangementByPart parts;
  parts.key_points.resize(structure.key_points.size());
  parts.segments.resize(structure.segments.size());
  for (const Placement& placement : arrangement.placements) {
    if (placement.place == Placement::Place::kKeyPoint)
      parts.key_points[placement.index] = placement.element;
    else
      parts.segments[placement.index].push_back(placement.element);
  }
  return parts;
}

}  // namespace plat::sequences

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/failure.h"
#include "sequences/compiled_problem.h"

namespace plat::sequences {
namespace {

/// The transitions from right to left sides, sorted into a table over all elements.
TransitionTable right_to_left_table(const SequenceDatabase& database,
                                    const std::vector<DimensionMeaning>& dimensions) {
  std::vector<const Transition*> sorted;
  bool has_uses = false;
  for (const Transition& transition : database.transitions) {
    if (transition.from_port != Port::kRight || transition.to_port != Port::kLeft) continue;
    if (!database.elements[transition.from].is_filling) continue;
    if (!database.elements[transition.to].is_filling) continue;
    sorted.push_back(&transition);
    has_uses = has_uses || std::ranges::any_of(transition.uses, [](Amount a) { return a > 0; });
  }
  std::ranges::stable_sort(sorted, {}, [](const Transition* transition) {
    return std::pair(transition->from, transition->to);
  });
  TransitionTable table;
  table.first.assign(database.elements.size() + 1, 0);
  for (const Transition* transition : sorted) {
    ++table.first[transition->from + 1];
    table.arcs.push_back({transition->to, transition->cost});
    if (!has_uses) continue;
    for (const auto& meaning : dimensions)
      table.arc_uses.push_back(transition->uses.empty() ? 0 : transition->uses[meaning.resource]);
  }
  std::partial_sum(table.first.begin(), table.first.end(), table.first.begin());
  return table;
}

/// Bounds on the whole and bounds on the only segment say the same thing.
std::vector<Bounds> joint_bounds(const SequenceProblem& problem) {
  std::vector<Bounds> bounds(problem.database.resources.size());
  const auto narrow = [&bounds](const std::vector<Bounds>& by) {
    for (std::size_t r = 0; r < by.size(); ++r) {
      bounds[r].min = std::max(bounds[r].min, by[r].min);
      bounds[r].max = std::min(bounds[r].max, by[r].max);
    }
  };
  narrow(problem.bounds);
  narrow(problem.structure.segments.front().bounds);
  return bounds;
}

}  // namespace

SequenceProblem plain_sequence(SequenceDatabase database, std::vector<Bounds> bounds) {
  SequenceProblem problem{std::move(database), std::move(bounds), {}};
  problem.structure.segments.emplace_back();
  return problem;
}

CompiledProblem compile(const SequenceProblem& problem) {
  expects(problem.structure.key_points.empty() && problem.structure.segments.size() == 1,
          "a plain sequence");
  const SequenceDatabase& database = problem.database;
  CompiledProblem compiled;
  SearchGraph& graph = compiled.graph;
  Zone zone{0, static_cast<std::uint32_t>(database.elements.size()), 0, {}, {}};
  const auto bounds = joint_bounds(problem);
  for (std::uint32_t r = 0; r < bounds.size(); ++r) {
    if (bounds[r] == Bounds{}) continue;
    compiled.dimensions.push_back({r, false});
    zone.bounds.push_back(bounds[r]);
    zone.resets.push_back(false);
  }
  graph.dimension_count = static_cast<std::uint32_t>(compiled.dimensions.size());
  for (std::uint32_t e = 0; e < database.elements.size(); ++e) {
    const Element& element = database.elements[e];
    for (const auto& meaning : compiled.dimensions)
      graph.node_uses.push_back(element.uses[meaning.resource]);
    if (element.is_filling && element.is_front) graph.entries.push_back({e, 0});
    if (element.is_filling && element.is_back) graph.exits.push_back({e, 0});
    compiled.placements.push_back(Placement{e, Placement::Place::kSegment, 0});
  }
  graph.tables.push_back(right_to_left_table(database, compiled.dimensions));
  graph.zones.push_back(std::move(zone));
  validate(graph);
  return compiled;
}

Arrangement arrangement(const CompiledProblem& compiled, const SequenceProblem& problem,
                        const SequencePath& path) {
  Arrangement result{path.cost, {}, {}};
  result.consumed.assign(problem.database.resources.size(), 0);
  for (const Step& step : path.steps) {
    const auto& placement = compiled.placements[step.node];
    if (!placement) continue;
    result.placements.push_back(*placement);
    const auto& uses = problem.database.elements[placement->element].uses;
    for (std::size_t r = 0; r < uses.size(); ++r) result.consumed[r] += uses[r];
  }
  return result;
}

}  // namespace plat::sequences

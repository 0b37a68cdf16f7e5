#include <algorithm>
#include <utility>

#include "core/failure.h"
#include "sequences/adjacency.h"
#include "sequences/compiled_check.h"
#include "sequences/compiled_problem.h"
#include "sequences/structure_check.h"
#include "sequences/unrolling.h"

namespace plat::sequences {
namespace {

/// The transitions from right to left sides as a table over all elements.
TransitionTable right_to_left_table(const SequenceDatabase& database,
                                    const std::vector<DimensionMeaning>& dimensions,
                                    std::vector<std::uint32_t>& transitions) {
  const Adjacency adjacency(database);
  TransitionTable table;
  table.first.push_back(0);
  bool has_uses = false;
  for (ElementIndex tail = 0; tail < database.elements.size(); ++tail) {
    for (const Neighbour& neighbour : adjacency.of(tail, Port::kRight, Port::kLeft)) {
      if (!database.elements[tail].is_filling || !database.elements[neighbour.head].is_filling)
        continue;
      const Transition& transition = database.transitions[neighbour.transition];
      table.arcs.push_back({neighbour.head, transition.cost});
      transitions.push_back(neighbour.transition);
      for (const auto& meaning : dimensions) {
        table.arc_uses.push_back(transition.uses.empty() ? 0 : transition.uses[meaning.resource]);
        has_uses = has_uses || table.arc_uses.back() > 0;
      }
    }
    table.first.push_back(static_cast<std::uint32_t>(table.arcs.size()));
  }
  if (!has_uses) table.arc_uses.clear();
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
  if (!is_plain(problem.structure)) return unroll(problem);
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
  compiled.arc_transitions.emplace_back();
  graph.tables.push_back(
      right_to_left_table(database, compiled.dimensions, compiled.arc_transitions.back()));
  compiled.is_walked_backwards.assign(1, problem.structure.segments.front().is_reversed);
  graph.zones.push_back(std::move(zone));
  compiled.zone_segments = {0};
  validate(compiled, database);
  return compiled;
}

}  // namespace plat::sequences

#include "sequences/bound_use.h"

#include <algorithm>

namespace plat::sequences {
namespace {

/// The whole first, then by segment.
bool comes_before(const BoundUse& a, const BoundUse& b) {
  return std::pair(a.place.segment, a.place.resource) <
         std::pair(b.place.segment, b.place.resource);
}

}  // namespace

BoundPlace place_of(const CompiledProblem& compiled, std::size_t dimension, std::size_t zone) {
  const DimensionMeaning& meaning = compiled.dimensions[dimension];
  if (!meaning.is_local) return {meaning.resource, std::nullopt};
  return {meaning.resource, compiled.zone_segments[zone]};
}

std::vector<BoundUse> bounds_of(const CompiledProblem& compiled) {
  std::vector<BoundUse> out;
  for (std::size_t z = 0; z < compiled.graph.zones.size(); ++z) {
    for (std::size_t d = 0; d < compiled.dimensions.size(); ++d) {
      const Bounds& bounds = compiled.graph.zones[z].bounds[d];
      const BoundPlace place = place_of(compiled, d, z);
      if (bounds == Bounds{} || std::ranges::find(out, place, &BoundUse::place) != out.end())
        continue;
      out.push_back({place, bounds, 0});
    }
  }
  std::ranges::sort(out, comes_before);
  return out;
}

std::vector<BoundUse> bound_uses(const CompiledProblem& compiled, const SequencePath& path) {
  const SearchGraph& graph = compiled.graph;
  std::vector<BoundUse> out = bounds_of(compiled);
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    const Step& step = path.steps[i];
    const std::uint32_t z = graph.zone_of(step.node);
    const bool is_arc = i > 0 && graph.zone_of(path.steps[i - 1].node) == z;
    for (std::size_t d = 0; d < compiled.dimensions.size(); ++d) {
      const auto bound = std::ranges::find(out, place_of(compiled, d, z), &BoundUse::place);
      if (bound == out.end()) continue;
      bound->consumed += graph.uses(step.node)[d];
      if (!is_arc) continue;
      const TransitionTable& table = graph.tables[*graph.zones[z].table];
      if (!table.arc_uses.empty())
        bound->consumed += table.arc_uses[std::size_t{step.arc} * graph.dimension_count + d];
    }
  }
  return out;
}

}  // namespace plat::sequences

#include "sequences/compiled_check.h"

#include <algorithm>
#include <string>

#include "core/failure.h"
#include "sequences/free_cycle.h"

namespace plat::sequences {
namespace {

/// The zone's elements are walked alike in a zone that came before: in a copy for another context.
bool is_copy(const SearchGraph& graph, std::size_t zone) {
  const auto is_same = [&](const Zone& other) {
    return other.table == graph.zones[zone].table && other.bounds == graph.zones[zone].bounds;
  };
  const auto end = graph.zones.begin() + static_cast<std::ptrdiff_t>(zone);
  return std::find_if(graph.zones.begin(), end, is_same) != end;
}

}  // namespace

void validate(const CompiledProblem& compiled, const SequenceDatabase& database) {
  const SearchGraph& graph = compiled.graph;
  for (std::size_t z = 0; z < graph.zones.size(); ++z) {
    if (!graph.zones[z].table || is_copy(graph, z)) continue;
    std::string names;
    for (const std::uint32_t node : free_cycle(graph, graph.zones[z]))
      names +=
          (names.empty() ? "" : ", ") + database.elements[compiled.placements[node]->element].name;
    if (!names.empty()) throw InputError(std::string(kFreeCycle) + "; elements: " + names);
  }
  validate(graph);
}

}  // namespace plat::sequences

#include "graph_output.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/failure.h"
#include "sequences/intermediate_graph_trace.h"

namespace plat::cli {
namespace {

using nlohmann::ordered_json;
using sequences::CompiledProblem;
using sequences::SequenceProblem;
using sequences::TracedArc;
using sequences::TracedState;

ordered_json state_json(const TracedState& state, const CompiledProblem& compiled,
                        const SequenceProblem& problem) {
  const auto& placement = compiled.placements[state.node];
  ordered_json out;
  if (placement) out["element"] = problem.database.elements[placement->element].name;
  out["consumed"] = state.consumed;
  out["level"] = state.level;
  out["from_front"] = state.side != TracedState::Side::kBack;
  out["from_end"] = state.side != TracedState::Side::kFront;
  out["alive"] = !state.is_pruned;
  out["entry"] = state.is_entry;
  out["exit"] = state.is_exit;
  return out;
}

}  // namespace

void write_graph(const CompiledProblem& compiled, const SequenceProblem& problem,
                 const std::string& file) {
  const auto graph =
      sequences::trace_intermediate_graph(compiled.graph, {.max_states = kMostDrawnStates});
  if (!graph)
    throw InputError(fmt::format("{}: the graph has more than {} states, too many to draw", file,
                                 kMostDrawnStates));
  ordered_json out{{"dimensions", ordered_json::array()},
                   {"states", ordered_json::array()},
                   {"arcs", ordered_json::array()}};
  for (const sequences::DimensionMeaning& meaning : compiled.dimensions)
    out["dimensions"].push_back(problem.database.resources[meaning.resource].name);
  for (const TracedState& state : graph->states)
    out["states"].push_back(state_json(state, compiled, problem));
  for (const TracedArc& arc : graph->arcs)
    out["arcs"].push_back({{"from", arc.from},
                           {"to", arc.to},
                           {"cost", static_cast<double>(arc.cost) * problem.database.cost_step}});
  write_file(file, out.dump(1) + "\n");
}

}  // namespace plat::cli

#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <tuple>

#include "core/failure.h"
#include "core/options.h"
#include "sequences/search_graph.h"
#include "sequences/sequence_search.h"

namespace plat::sequences {

/// Builds the graph of all feasible paths, ordered by what is consumed, and finds the shortest
/// paths in it.
///
/// Equal costs come in the order of `KShortestWalks`, arcs of a state as in its table, links after
/// arcs, the exit last. For graphs with many resources, whose states are too many, there is
/// `bounding`: the paths and their costs stay the same.
///
/// Guarantees: 1. those of `SequenceSearch`;  2. without bounding, `states_created` is the number
/// of nodes of the thesis's graph after its prunings, and `states_pruned` that of its dead ends;
/// with bounding by cost they are those of the last graph, of paths up to the limit.
/// @returns       Failure kTooManyStates beyond `max_states` or `max_memory_mib`
/// Complexity:    O(states x arcs of a node) for the first path, then as `KShortestWalks`
/// Paper:         [Har, Sec. 3.3]; k best by [Epp94]; bounds as in [BC89]
/// Deviation:     ADR 0019
class IntermediateGraphSearch {
 public:
  static constexpr std::string_view kName = "intermediate_graph";
  static constexpr std::string_view kSummary =
      "the graph of all feasible sequences, grown from both ends by what is consumed, then k "
      "shortest paths [Har, Sec. 3.3]";
  enum class Bounding { kNone, kResources, kResourcesAndCost };
  struct Options {
    Bounding bounding = Bounding::kNone;    ///< which states are not created
    std::uint32_t max_states = 50'000'000;  ///< states held, dead ends included
    std::uint32_t max_memory_mib = 4'000;   ///< memory held while the graph grows
    /// Last states from which growth from the end may begin; more, and it is from the front alone.
    std::uint32_t max_end_states = 100'000;
    static constexpr auto fields() {
      return std::tuple{
          EnumField<Options, Bounding, 3>{
              "bounding",
              &Options::bounding,
              {{"none", Bounding::kNone},
               {"resources", Bounding::kResources},
               {"resources_and_cost", Bounding::kResourcesAndCost}},
              "which states are not created: none, as in the paper; those that by some resource "
              "cannot end well; also those whose cost is beyond a limit, which is raised as "
              "needed"},
          Field{"max_states", &Options::max_states, 1, 1'000'000'000,
                "states that may be held, dead ends included; more is a failure"},
          Field{"max_memory_mib", &Options::max_memory_mib, 1, 1'000'000,
                "mebibytes that the growing graph may hold; more is a failure"},
          Field{"max_end_states", &Options::max_end_states, 0, 1'000'000'000,
                "last states from which the graph is grown backwards; where the bounds allow more, "
                "it is grown from the front alone, to the same graph"}};
    }
  };

  explicit IntermediateGraphSearch(const Options& options) : options_(options) {}
  [[nodiscard]] Expected<std::unique_ptr<SequenceStream>> search(const SearchGraph& graph) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(SequenceSearch<IntermediateGraphSearch> && Registrable<IntermediateGraphSearch>);

}  // namespace plat::sequences

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

/// Ranks the walks of the graph by cost alone, and hands out those that keep the bounds.
///
/// Prunings leave the ranking what it is: walks come in order of cost, and each is looked at by
/// itself. Where a walk cannot end well any more before its last detour is over, no walk that
/// begins as it does is looked at; nodes and arcs that no feasible path can use are taken away
/// before. Equal costs come in the order of `KShortestWalks`: where most arcs cost nothing, the
/// search goes deep and is soon done.
///
/// Guarantees: 1. those of `SequenceSearch`;  2. at most `max_walks` walks are looked at, which are
/// its `states_expanded`.
/// @returns       Failure kTooManyStates beyond that: where few of the cheap walks are feasible, or
///                none at all, a ranking does not end in a reasonable time [Har, Sec. 6.4]
/// Complexity:    O(m log n), then O(length + log k) for each walk, feasible or not
/// Paper:         path ranking of [Har, Sec. 3.5, 6.4]; by [Epp94], prunings of [BC89]
/// Deviation:     walks, not simple paths: elements may come again (ADR 0019)
class RankingSearch {
 public:
  static constexpr std::string_view kName = "ranking";
  static constexpr std::string_view kSummary =
      "all sequences by cost, bounds or not, until one keeps the bounds [Har, Sec. 6.4]";
  enum class Pruning { kNone, kResources, kStates };
  struct Options {
    Pruning pruning = Pruning::kStates;   ///< which walks are not looked at
    std::uint32_t max_walks = 1'000'000;  ///< walks looked at in all
    static constexpr auto fields() {
      return std::tuple{
          EnumField<Options, Pruning, 3>{
              "pruning",
              &Options::pruning,
              {{"none", Pruning::kNone},
               {"resources", Pruning::kResources},
               {"states", Pruning::kStates}},
              "which walks are left out: none, those that begin like one that exceeded a maximum; "
              "resources, also those that by some resource cannot end well; states, by all "
              "resources together"},
          Field{"max_walks", &Options::max_walks, 1, 1'000'000'000,
                "walks that may be looked at in all; more is a failure"}};
    }
  };

  explicit RankingSearch(const Options& options) : options_(options) {}
  [[nodiscard]] Expected<std::unique_ptr<SequenceStream>> search(const SearchGraph& graph) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(SequenceSearch<RankingSearch> && Registrable<RankingSearch>);

}  // namespace plat::sequences

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
/// Two prunings leave the ranking what it is: nodes that are on no walk from an entry to an exit
/// are never visited, and where a walk breaks a maximum before its last detour ends, no walk that
/// goes on from that detour is looked at. Equal costs come in the order of `KShortestWalks`.
///
/// Guarantees: 1. those of `SequenceSearch`;  2. at most `max_walks` walks are looked at.
/// @returns       Failure kTooManyStates beyond that: where few of the cheap walks are feasible, or
///                none at all, a ranking does not end in a reasonable time [Har, Sec. 6.4]
/// Complexity:    O(m log n), then O(length + log k) for each walk, feasible or not
/// Paper:         path ranking of [Har, Sec. 3.5, 6.4]; ranking by [Epp94]
/// Deviation:     walks, not simple paths: elements may come again (ADR 0019)
class RankingSearch {
 public:
  static constexpr std::string_view kName = "ranking";
  static constexpr std::string_view kSummary =
      "all sequences by cost, bounds or not, until one keeps the bounds [Har, Sec. 6.4]";
  struct Options {
    std::uint32_t max_walks = 1'000'000;  ///< walks looked at between two that are handed out
    static constexpr auto fields() {
      return std::tuple{Field{"max_walks", &Options::max_walks, 1, 1'000'000'000,
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

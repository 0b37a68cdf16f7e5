#pragma once

#include <memory>
#include <string_view>
#include <tuple>

#include "sequences/sequence_search.h"

namespace plat::sequences {

/// Constrained forward search: states (element, consumed resources) are expanded in the order of
/// their cost until one is met that satisfies all bounds.
///
/// Guarantees: 1. equal costs come in the order in which the search meets them, latest first; the
/// graph alone decides;  2. without `none`, no more than the j best ways to a state are expanded
/// for the first j paths rounded up to a power of four;  3. the number of paths need not be known:
/// where more are asked for than the limit per state allows, the search starts again with four
/// times the limit and leaves out what it has given.
/// @returns    Failure kTooManyStates beyond `max_states` ways that are held
/// Complexity: O(s a) for s states and a arcs from each, for one path
/// Paper:      [Har, Sec. 3.5], [LHL10]
/// Deviation:  the paper's search gives one path only; `bounds` is ours (ADR 0020)
class ForwardSearch {
 public:
  static constexpr std::string_view kName = "forward";
  static constexpr std::string_view kSummary =
      "expands states (element, consumed) in order of cost, as Lefebvre et al.";
  enum class Dominance { kNone, kStates, kBounds };
  struct Options {
    Dominance dominance = Dominance::kStates;  ///< which ways are not followed further
    int max_states = 20'000'000;               ///< ways to states that are held at a time
    static constexpr auto fields() {
      return std::tuple{
          EnumField<Options, Dominance, 3>{
              "dominance",
              &Options::dominance,
              {{"none", Dominance::kNone},
               {"states", Dominance::kStates},
               {"bounds", Dominance::kBounds}},
              "which ways are left: none; all but the k cheapest to a state; with bounds also "
              "those that cannot end well, and the rest come by their least total cost"},
          Field{"max_states", &Options::max_states, 1, 1'000'000'000,
                "ways to states that are held before the search gives up"},
      };
    }
  };

  explicit ForwardSearch(const Options& options) : options_(options) {}
  [[nodiscard]] Expected<std::unique_ptr<SequenceStream>> search(const SearchGraph& graph) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(SequenceSearch<ForwardSearch> && Registrable<ForwardSearch>);

}  // namespace plat::sequences

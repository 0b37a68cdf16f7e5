#pragma once

#include <memory>
#include <string_view>
#include <tuple>

#include "sequences/sequence_search.h"

namespace plat::sequences {

/// Label setting by Boost.Graph's `r_c_shortest_paths`, the overload for all Pareto-optimal paths.
///
/// Dominance that is exact: less is better where a dimension has no minimum, more where it has no
/// maximum, and where it has both only equal amounts compare. A label falls when as many labels
/// precede it as paths are asked for.
///
/// Guarantees: 1. equal costs come in the order in which the search makes them; the graph alone
/// decides;  2. the number of paths need not be known: where more are asked for than the limit per
/// label allows, the search starts again with twice the limit and leaves out what it has
/// given.
/// @returns    Failure kTooManyStates beyond `max_labels` or `max_comparisons_million`
/// Complexity: O(l^2) comparisons at a node of l labels
/// Paper:      [ID05]
/// Deviation:  Boost 1.74's overload for one path is not optimal (ADR 0020)
class LabelSettingSearch {
 public:
  static constexpr std::string_view kName = "label_setting";
  static constexpr std::string_view kSummary =
      "Boost.Graph's r_c_shortest_paths, all Pareto-optimal labels, with dominance for k paths";
  enum class Pruning { kNone, kBounds };
  struct Options {
    Pruning pruning = Pruning::kBounds;      ///< which labels are not made
    int max_labels = 1'000'000;              ///< labels made
    double max_comparisons_million = 200.0;  ///< of two labels at a node
    static constexpr auto fields() {
      return std::tuple{
          EnumField<Options, Pruning, 2>{
              "pruning",
              &Options::pruning,
              {{"none", Pruning::kNone}, {"bounds", Pruning::kBounds}},
              "none: Boost by itself, until no label is left; bounds: labels that cannot end well "
              "are not made, and the search ends when enough are taken by their least total cost"},
          Field{"max_labels", &Options::max_labels, 1, 1'000'000'000,
                "labels that are made before the search gives up"},
          Field{"max_comparisons_million", &Options::max_comparisons_million, 0.001, 1e6,
                "millions of comparisons of labels before the search gives up"},
      };
    }
  };

  explicit LabelSettingSearch(const Options& options) : options_(options) {}
  [[nodiscard]] Expected<std::unique_ptr<SequenceStream>> search(const SearchGraph& graph) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(SequenceSearch<LabelSettingSearch> && Registrable<LabelSettingSearch>);

}  // namespace plat::sequences

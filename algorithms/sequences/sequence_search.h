#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "core/failure.h"
#include "core/options.h"
#include "core/registry.h"
#include "sequences/search_graph.h"
#include "sequences/sequence_path.h"

namespace plat::sequences {

/// What a search has built and looked at so far. A count that a strategy has no use for stays 0.
struct SearchStatistics {
  std::uint64_t states_created = 0;   ///< (node, consumed) pairs kept; nodes of [Har, Fig. 6.12]
  std::uint64_t states_expanded = 0;  ///< those whose outgoing arcs were followed
  std::uint64_t arcs_relaxed = 0;     ///< arcs followed
  std::uint64_t states_pruned = 0;    ///< dead ends and dominated labels taken away again
  std::uint64_t bytes_held = 0;       ///< an estimate of the memory that the search holds
};

/// The best paths of one graph, one after the other. The graph must outlive the stream.
class SequenceStream {
 public:
  virtual ~SequenceStream() = default;
  /// Writes the next best path to `path` (whose memory is used again) and returns true, or returns
  /// false where there is no further one. Failure kTooManyStates beyond the strategy's limit.
  virtual Expected<bool> next(SequencePath& path) = 0;
  [[nodiscard]] virtual SearchStatistics statistics() const = 0;
};

/// Finds the k best paths of a search graph, one at a time.
///
/// Contract, tested over the whole registry: 1. every path is feasible and costs what it says
/// (`why_not_feasible`);  2. costs do not decrease;  3. no path comes twice;  4. all strategies
/// give the same costs in the same order, and stop at the same number of paths;  5. the same graph
/// gives the same paths, bit for bit; the order among equal costs is the strategy's own, and stated
/// there;
/// 6. no path at all is an answer, not a failure. Graph construction happens in `search`, the first
/// path's search in the first `next`: [Har, Fig. 6.12] times them apart.
template <class S>
concept SequenceSearch = requires(const S& strategy, const SearchGraph& graph) {
  { strategy.search(graph) } -> std::same_as<Expected<std::unique_ptr<SequenceStream>>>;
};

/// Any strategy of the family, chosen at run time.
class AnySequenceSearch {
 public:
  template <class S>
    requires(SequenceSearch<S> && Registrable<S> && !std::same_as<S, AnySequenceSearch>)
  explicit AnySequenceSearch(S strategy)
      : self_(std::make_shared<const Model<S>>(std::move(strategy))) {}

  [[nodiscard]] Expected<std::unique_ptr<SequenceStream>> search(const SearchGraph& graph) const {
    return self_->search(graph);
  }
  [[nodiscard]] std::string_view name() const { return self_->name(); }
  [[nodiscard]] OptionMap options() const { return self_->options(); }

 private:
  struct Interface {
    virtual ~Interface() = default;
    [[nodiscard]] virtual Expected<std::unique_ptr<SequenceStream>> search(
        const SearchGraph&) const = 0;
    [[nodiscard]] virtual std::string_view name() const = 0;
    [[nodiscard]] virtual OptionMap options() const = 0;
  };
  template <class S>
  struct Model final : Interface {
    explicit Model(S s) : strategy(std::move(s)) {}
    [[nodiscard]] Expected<std::unique_ptr<SequenceStream>> search(
        const SearchGraph& graph) const override {
      return strategy.search(graph);
    }
    [[nodiscard]] std::string_view name() const override { return S::kName; }
    [[nodiscard]] OptionMap options() const override { return to_option_map(strategy.options()); }
    S strategy;
  };
  std::shared_ptr<const Interface> self_;
};
static_assert(SequenceSearch<AnySequenceSearch>);

/// The menu of search strategies.
const Registry<AnySequenceSearch>& sequence_searches();

/// The first `k` paths, or all where there are fewer.
Expected<std::vector<SequencePath>> find_paths(SequenceStream& stream, std::size_t k);

}  // namespace plat::sequences

#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "sequences/sequence_search.h"

/// Searches of a few lines, each with one thing that an experiment must be able to tell.
namespace plat::rcksp {

struct NoOptions {
  static constexpr auto fields() { return std::tuple{}; }
};

/// Hands out what it was given, by cost.
class ListStream final : public sequences::SequenceStream {
 public:
  explicit ListStream(std::vector<sequences::SequencePath> paths) : paths_(std::move(paths)) {}
  Expected<bool> next(sequences::SequencePath& path) override {
    if (next_ == paths_.size()) return false;
    path = paths_[next_++];
    return true;
  }
  [[nodiscard]] sequences::SearchStatistics statistics() const override {
    return {.states_created = paths_.size()};
  }

 private:
  std::vector<sequences::SequencePath> paths_;
  std::size_t next_ = 0;
};

/// Tries every path of a graph of one zone and one dimension.
class ExhaustiveSearch {
 public:
  static constexpr std::string_view kName = "exhaustive";
  static constexpr std::string_view kSummary = "Tries every path";
  using Options = NoOptions;
  ExhaustiveSearch() = default;
  explicit ExhaustiveSearch(const Options&) {}
  [[nodiscard]] Options options() const { return {}; }

  [[nodiscard]] Expected<std::unique_ptr<sequences::SequenceStream>> search(
      const sequences::SearchGraph& graph) const {
    return std::make_unique<ListStream>(paths(graph));
  }

  [[nodiscard]] static std::vector<sequences::SequencePath> paths(
      const sequences::SearchGraph& graph) {
    std::vector<sequences::SequencePath> out;
    for (std::uint32_t e = 0; e < graph.entries.size(); ++e)
      extend(graph, {graph.entries[e].cost, {{graph.entries[e].node, e}}}, 0, out);
    std::ranges::stable_sort(out, {}, &sequences::SequencePath::cost);
    return out;
  }

 private:
  static void extend(const sequences::SearchGraph& graph, const sequences::SequencePath& path,
                     sequences::Amount before, std::vector<sequences::SequencePath>& out) {
    const std::uint32_t node = path.steps.back().node;
    const sequences::Amount consumed = before + graph.uses(node)[0];
    const sequences::Bounds& bounds = graph.zones[0].bounds[0];
    if (consumed > bounds.max) return;
    if (consumed >= bounds.min) out.push_back(path);
    const sequences::TransitionTable& table = graph.tables[0];
    for (std::uint32_t a = table.first[node]; a < table.first[node + 1]; ++a) {
      sequences::SequencePath longer = path;
      longer.cost += table.arcs[a].cost;
      longer.steps.push_back({table.arcs[a].head, a});
      extend(graph, longer, consumed, out);
    }
  }
};

/// Leaves the best path out.
class SecondBestSearch {
 public:
  static constexpr std::string_view kName = "second_best";
  static constexpr std::string_view kSummary = "Leaves the best path out";
  using Options = NoOptions;
  explicit SecondBestSearch(const Options&) {}
  [[nodiscard]] Options options() const { return {}; }
  [[nodiscard]] Expected<std::unique_ptr<sequences::SequenceStream>> search(
      const sequences::SearchGraph& graph) const {
    auto paths = ExhaustiveSearch::paths(graph);
    if (!paths.empty()) paths.erase(paths.begin());
    return std::make_unique<ListStream>(std::move(paths));
  }
};

/// Does not come to an end.
class EndlessSearch {
 public:
  static constexpr std::string_view kName = "endless";
  static constexpr std::string_view kSummary = "Does not come to an end";
  using Options = NoOptions;
  explicit EndlessSearch(const Options&) {}
  [[nodiscard]] Options options() const { return {}; }
  [[nodiscard]] Expected<std::unique_ptr<sequences::SequenceStream>> search(
      const sequences::SearchGraph&) const {
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  }
};

/// Ends as a search does that asks for more memory than there is.
class HungrySearch {
 public:
  static constexpr std::string_view kName = "hungry";
  static constexpr std::string_view kSummary = "Asks for more memory than there is";
  using Options = NoOptions;
  explicit HungrySearch(const Options&) {}
  [[nodiscard]] Options options() const { return {}; }
  [[nodiscard]] Expected<std::unique_ptr<sequences::SequenceStream>> search(
      const sequences::SearchGraph&) const {
    throw std::bad_alloc();
  }
};

}  // namespace plat::rcksp

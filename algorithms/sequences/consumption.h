#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// How far a zone tells amounts of one dimension apart.
struct AmountLimit {
  Amount asked = 0;        ///< what leaving the scope of the dimension asks for at least
  Amount largest = 0;      ///< no state of the zone has more
  bool saturates = false;  ///< more counts as `largest`; else more is refused
};

/// Amounts from `low` to `high`, both included; none where `low` exceeds `high`.
struct AmountRange {
  Amount low = 0;
  Amount high = 0;
};

/// What paths have consumed, as states remember it: how the vector changes along arcs and links,
/// and which vectors may have been there before.
///
/// Guarantees: 1. two paths to a node with the same vector may go on in the same ways;  2. amounts
/// never decrease within a zone, so that states in the order of (zone, vector), lexicographically,
/// are in topological order, but for those that have both in common.
class Consumption {
 public:
  explicit Consumption(const SearchGraph& graph);

  [[nodiscard]] const SearchGraph& graph() const { return *graph_; }
  [[nodiscard]] std::uint32_t zone_of(std::uint32_t node) const { return zone_of_node_[node]; }
  /// The node's index within its zone.
  [[nodiscard]] std::uint32_t local(std::uint32_t node) const {
    return node - graph_->zones[zone_of_node_[node]].first_node;
  }
  /// By dimension.
  [[nodiscard]] std::span<const AmountLimit> limits(std::uint32_t zone) const {
    return {limits_.data() + std::size_t{zone} * graph_->dimension_count, graph_->dimension_count};
  }
  /// The links that leave `node`: indices first .. second - 1.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> links_from(std::uint32_t node) const {
    return {first_link_[node], first_link_[node + 1]};
  }

  /// Adds `used` to `consumed` in place. @returns false where that exceeds a maximum
  bool add(std::uint32_t zone, std::span<Amount> consumed, std::span<const Amount> used) const;
  /// Follows an arc of the zone's table in place. @returns false where that exceeds a maximum
  bool follow_arc(std::uint32_t zone, std::uint32_t arc, std::span<Amount> consumed) const;
  /// Follows a link in place: minima of what is reset, the reset, what the head uses.
  bool follow(const Link& link, std::span<Amount> consumed) const;
  /// Whether a path may end here, if the node is an exit.
  [[nodiscard]] bool may_end(std::uint32_t zone, std::span<const Amount> consumed) const;

  /// The vectors from which `add(zone, ., used)` leads to `consumed`. @returns false for none
  bool before_arc(std::uint32_t zone, std::span<const Amount> consumed,
                  std::span<const Amount> used, std::span<AmountRange> before) const;
  /// The vectors from which `follow(link, .)` leads to `consumed`. @returns false for none
  bool before_link(const Link& link, std::span<const Amount> consumed,
                   std::span<AmountRange> before) const;
  /// The vectors with which a path may end in `zone`.
  void at_end(std::uint32_t zone, std::span<AmountRange> range) const;

 private:
  const SearchGraph* graph_;
  std::vector<AmountLimit> limits_;  ///< zones x dimensions
  std::vector<std::uint32_t> zone_of_node_;
  std::vector<std::uint32_t> first_link_;  ///< nodes + 1 offsets into the links
};

/// Calls `visit(vector)` for every vector of the box, in lexicographic order.
template <class Visit>
void for_each_vector(std::span<const AmountRange> box, Visit visit) {
  std::vector<Amount> vector(box.size());
  for (std::size_t d = 0; d < box.size(); ++d) {
    if (box[d].low > box[d].high) return;
    vector[d] = box[d].low;
  }
  while (true) {
    visit(std::span<const Amount>(vector));
    std::size_t d = box.size();
    while (d > 0 && vector[d - 1] == box[d - 1].high) {
      vector[d - 1] = box[d - 1].low;
      --d;
    }
    if (d == 0) return;
    ++vector[d - 1];
  }
}

}  // namespace plat::sequences

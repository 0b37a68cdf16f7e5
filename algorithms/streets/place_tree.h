#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/box.h"
#include "core/point.h"

namespace plat::streets {

/// Finds places near a place, and places in a region: a k-d tree, so that clusters and outliers
/// cost no more than even places do.
///
/// Guarantees: 1. what is found depends on the places and their numbers only, not on how the tree
/// divides them.
/// Complexity: O(n log n) to build; O(log n + k) for the k nearest of places in general position.
class PlaceTree {
 public:
  /// Pre: fewer than 2^32 places.
  explicit PlaceTree(std::span<const Point> places);

  /// The `count` places nearest to the place `of`, itself left out: nearest first, of equally near
  /// ones the lowest number first; all others where there are fewer.
  [[nodiscard]] std::vector<std::uint32_t> nearest(std::uint32_t of, std::size_t count) const;

  /// Whether there is a place that is_wanted(number). Places in boxes that may not hold one,
  /// may_hold(box), are not asked.
  template <class MayHold, class IsWanted>
  [[nodiscard]] bool any(MayHold may_hold, IsWanted is_wanted) const {
    std::vector<std::uint32_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
      const Node& node = nodes_[open.back()];
      open.pop_back();
      if (!may_hold(node.box)) continue;
      if (node.second_child != 0) {
        open.push_back(node.second_child);
        open.push_back(node.first_child);
        continue;
      }
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        if (is_wanted(order_[i])) return true;
    }
    return false;
  }

 private:
  /// Places order_[begin] .. order_[end - 1]; a leaf has no children (0, which is the root).
  struct Node {
    Box box;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t first_child = 0;
    std::uint32_t second_child = 0;
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  std::vector<Point> places_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace plat::streets

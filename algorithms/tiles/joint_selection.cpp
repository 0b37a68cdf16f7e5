#include "tiles/joint_selection.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace plat::tiles {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

class JointSelection {
 public:
  explicit JointSelection(TileLayout& layout) : layout_(layout), tiles_at_(layout.vertices.size()) {
    for (std::uint32_t t = 0; t < layout.tiles.size(); ++t) {
      for (const auto& ring : layout.tiles[t].rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          tiles_at_[ring[i].vertex].push_back(t);
          owner_.emplace(Pair{ring[i].vertex, ring[(i + 1) % ring.size()].vertex}, t);
        }
      }
    }
    for (std::size_t v = 0; v < tiles_at_.size(); ++v) {
      auto& tiles = tiles_at_[v];
      tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
      layout.vertices[v].is_joint = tiles.size() > 1;
    }
  }

  void drop_collinear(double collinear_m) {
    for (std::uint32_t t = 0; t < layout_.tiles.size(); ++t) {
      for (const auto& ring : layout_.tiles[t].rings) drop_collinear(t, ring, collinear_m);
    }
  }

  void drop_near(double near_m) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < tiles_at_.size(); ++v) {
      if (!layout_.vertices[v].is_joint) continue;
      order.push_back(v);
      for_each_pair(v, [&](Pair pair) { ++joints_of_[pair]; });
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t v) { return tiles_at_[v].size(); });
    for (const std::uint32_t v : order) {
      if (!is_spare(v) || !has_joint_near(v, near_m)) continue;
      layout_.vertices[v].is_joint = false;
      for_each_pair(v, [&](Pair pair) { --joints_of_[pair]; });
    }
  }

 private:
  [[nodiscard]] Point at(std::uint32_t vertex) const { return layout_.vertices[vertex].at; }

  template <class Visit>
  void for_each_pair(std::uint32_t vertex, Visit visit) const {
    const auto& tiles = tiles_at_[vertex];
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      for (std::size_t j = i + 1; j < tiles.size(); ++j) visit(Pair{tiles[i], tiles[j]});
    }
  }

  /// The tile on the other side of the edge that starts at corner `i`.
  [[nodiscard]] std::optional<std::uint32_t> across(const std::vector<Corner>& ring,
                                                    std::size_t i) const {
    const auto it = owner_.find({ring[(i + 1) % ring.size()].vertex, ring[i].vertex});
    if (it == owner_.end()) return std::nullopt;
    return it->second;
  }

  /// Follows the boundary that tile `t` has in common with each neighbour of a higher number, from
  /// one end to the other.
  void drop_collinear(std::uint32_t t, const std::vector<Corner>& ring, double collinear_m) {
    const std::size_t n = ring.size();
    std::vector<std::optional<std::uint32_t>> other(n);
    for (std::size_t i = 0; i < n; ++i) other[i] = across(ring, i);
    const auto is_end = [&](std::size_t i) {
      return other[(i + n - 1) % n] != other[i] || tiles_at_[ring[i].vertex].size() != 2;
    };
    std::size_t first = 0;
    while (first < n && !is_end(first)) ++first;
    if (first == n) {  // one neighbour all around
      if (!other[0] || *other[0] < t) return;
      std::vector<std::uint32_t> chain;
      for (std::size_t i = 0; i <= n; ++i) chain.push_back(ring[i % n].vertex);
      simplify(chain, collinear_m);
      return;
    }
    for (std::size_t k = 0; k < n;) {
      std::vector<std::uint32_t> chain{ring[(first + k) % n].vertex};
      const auto neighbour = other[(first + k) % n];
      do {
        ++k;
        chain.push_back(ring[(first + k) % n].vertex);
      } while (k < n && !is_end((first + k) % n));
      if (neighbour && *neighbour > t) simplify(chain, collinear_m);
    }
  }

  /// Douglas and Peucker's: what lies within `collinear_m` of the chord is no joint. A closed chain
  /// is divided at its farthest vertex first, which stays.
  void simplify(std::span<const std::uint32_t> chain, double collinear_m) {
    if (chain.size() < 3) return;
    const Segment chord{at(chain.front()), at(chain.back())};
    const bool is_closed = chain.front() == chain.back();
    std::size_t farthest = 0;
    double off_m = -1.0;
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
      const double d = distance(chord, at(chain[i]));
      if (d > off_m) {
        off_m = d;
        farthest = i;
      }
    }
    if (off_m <= collinear_m && !is_closed) {
      for (std::size_t i = 1; i + 1 < chain.size(); ++i)
        layout_.vertices[chain[i]].is_joint = false;
      return;
    }
    simplify(chain.first(farthest + 1), collinear_m);
    simplify(chain.subspan(farthest), collinear_m);
  }

  /// Whether each two of its tiles have two other joints.
  [[nodiscard]] bool is_spare(std::uint32_t vertex) const {
    bool is_spare = true;
    for_each_pair(vertex, [&](Pair pair) {
      constexpr int kJointsOfPair = 2;
      is_spare = is_spare && joints_of_.at(pair) > kJointsOfPair;
    });
    return is_spare;
  }

  [[nodiscard]] bool has_joint_near(std::uint32_t vertex, double near_m) const {
    for (const std::uint32_t t : tiles_at_[vertex]) {
      for (const auto& ring : layout_.tiles[t].rings) {
        for (const Corner& corner : ring) {
          if (corner.vertex != vertex && layout_.vertices[corner.vertex].is_joint &&
              distance(at(corner.vertex), at(vertex)) < near_m) {
            return true;
          }
        }
      }
    }
    return false;
  }

  TileLayout& layout_;
  std::vector<std::vector<std::uint32_t>> tiles_at_;  ///< per vertex, ascending
  std::map<Pair, std::uint32_t> owner_;               ///< of a directed edge
  std::map<Pair, int> joints_of_;                     ///< of two tiles
};

}  // namespace

TileLayout with_joints_selected(TileLayout layout, double near_m, double collinear_m) {
  JointSelection selection(layout);
  selection.drop_collinear(collinear_m);
  selection.drop_near(near_m);
  return layout;
}

}  // namespace plat::tiles

#include "tiles/tile_closing_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "core/oriented_box.h"
#include "tiles/reconfiguration_internal.h"
#include "tiles/tile_outline_internal.h"

namespace plat::tiles::detail {
namespace {

/// Vertices of the two sides that come as near to each other become one.
constexpr double kNear_m = 2.0;

/// The four corners between which the sides of a ring run: sides 0 and 2 are opposite, 1 and 3.
using Sides = std::array<std::size_t, 4>;

/// The corners nearest to those of the least box around the ring, in the order of the ring.
Sides sides_of(const Ring& ring) {
  const OrientedBox box = minimum_area_box(ring);
  const Point u = 0.5 * box.length_m * box.axis;
  const Point v = 0.5 * box.width_m * perpendicular(box.axis);
  Sides out{};
  const std::array<Point, 4> corners{box.center - u - v, box.center + u - v, box.center + u + v,
                                     box.center - u + v};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto nearest =
        std::ranges::min_element(ring, {}, [&](Point p) { return squared_length(p - corners[k]); });
    out[k] = static_cast<std::size_t>(nearest - ring.begin());
  }
  return out;
}

/// One end of what a tile was connected to.
struct Heir {
  std::uint32_t tile = 0;
  Point rest;
};

class Closing {
 public:
  Closing(const TileLayout& layout, std::uint32_t tile, unsigned turn);

  /// Whether the sides could be laid on each other.
  bool run();
  /// Of the sides that become points, the length along neighbours: what they lose.
  [[nodiscard]] double lost_m() const;
  TileLayout take() { return without_tiles(out_, std::array{tile_}); }

 private:
  /// A vertex of a side, by how far along the side it lies; all of a side that becomes a point.
  struct Bead {
    double along_01 = 0.0;
    std::size_t corner = 0;
  };
  [[nodiscard]] std::size_t size() const { return corners_.size(); }
  [[nodiscard]] std::optional<EdgePlace> beyond(std::size_t edge) const;
  [[nodiscard]] bool is_shared(std::size_t corner) const { return shared_[corner]; }
  [[nodiscard]] std::vector<Bead> beads(std::size_t side) const;
  [[nodiscard]] double along_01(std::size_t side, double s) const;
  [[nodiscard]] std::size_t side_of(double s) const;
  void merge(std::size_t a, std::size_t b);
  void zip();
  void put_into(std::size_t side, double share, std::size_t corner);
  bool clean_rings();
  [[nodiscard]] std::optional<Heir> heir_across(std::size_t side, double share) const;
  [[nodiscard]] std::optional<Heir> heir_of(double s) const;
  void hand_over_links();

  const TileLayout& layout_;
  TileLayout out_;
  std::uint32_t tile_;
  std::vector<Corner> corners_;
  ArcLength along_;
  EdgeMap others_;
  std::vector<bool> shared_;
  Sides sides_{};                      ///< sides 0 and 2 become points
  std::vector<std::uint32_t> merged_;  ///< per vertex: the one that it becomes
  std::map<std::pair<std::uint32_t, std::uint32_t>,
           std::vector<std::pair<std::pair<std::uint32_t, double>, Corner>>>
      put_in_;  ///< per tile and ring: corner and share of its edge, new corner
};

Ring ring_now(const TileLayout& layout, std::uint32_t tile) {
  return plat::tiles::shape_of(layout, layout.tiles[tile]).outer;
}

Closing::Closing(const TileLayout& layout, std::uint32_t tile, unsigned turn)
    : layout_(layout),
      out_(layout),
      tile_(tile),
      corners_(layout.tiles[tile].rings.front()),
      along_(ring_now(layout, tile)),
      merged_(layout.vertices.size()) {
  std::iota(merged_.begin(), merged_.end(), 0U);
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    if (i != tile && layout.tiles[i].block == layout.tiles[tile].block) others.push_back(i);
  }
  others_ = edges_of(layout, others);
  for (const Corner& corner : corners_) {
    const auto from = others_.lower_bound({corner.vertex, 0});
    shared_.push_back(from != others_.end() && from->first.first == corner.vertex);
  }
  const Sides box = sides_of(along_.ring());
  for (std::size_t k = 0; k < 4; ++k) sides_[k] = box[(k + turn) % 4];
}

std::optional<EdgePlace> Closing::beyond(std::size_t edge) const {
  const auto found =
      others_.find({corners_[(edge + 1) % size()].vertex, corners_[edge % size()].vertex});
  if (found == others_.end()) return std::nullopt;
  return found->second;
}

double Closing::lost_m() const {
  double out = 0.0;
  for (const std::size_t side : {0U, 2U}) {
    for (std::size_t i = sides_[side]; i != sides_[side + 1]; i = (i + 1) % size()) {
      if (beyond(i)) out += distance(along_.ring()[i], along_.ring()[(i + 1) % size()]);
    }
  }
  return out;
}

double Closing::along_01(std::size_t side, double s) const {
  const double start = along_.at(sides_[side]);
  const double length = along_.wrapped(along_.at(sides_[(side + 1) % 4]) - start);
  return length > 0.0 ? std::clamp(along_.wrapped(s - start) / length, 0.0, 1.0) : 0.0;
}

std::size_t Closing::side_of(double s) const {
  for (std::size_t side = 0; side < 4; ++side) {
    const double start = along_.at(sides_[side]);
    if (along_.wrapped(s - start) < along_.wrapped(along_.at(sides_[(side + 1) % 4]) - start))
      return side;
  }
  return 0;
}

/// Vertices between the ends of a side that other tiles have. Side 3 is walked against the ring, so
/// that it runs as side 1 does.
std::vector<Closing::Bead> Closing::beads(std::size_t side) const {
  std::vector<Bead> out;
  for (std::size_t i = (sides_[side] + 1) % size();
       i != sides_[(side + 1) % 4] && sides_[side] != sides_[(side + 1) % 4];
       i = (i + 1) % size()) {
    if (!is_shared(i)) continue;
    const double share = along_01(side, along_.at(i));
    out.push_back({side == 3 ? 1.0 - share : share, i});
  }
  if (side == 3) std::ranges::reverse(out);
  return out;
}

void Closing::merge(std::size_t a, std::size_t b) {
  const auto root = [&](std::uint32_t v) {
    while (merged_[v] != v) v = merged_[v];
    return v;
  };
  const std::uint32_t va = root(corners_[a].vertex);
  const std::uint32_t vb = root(corners_[b].vertex);
  merged_[std::max(va, vb)] = std::min(va, vb);
  out_.vertices[std::min(va, vb)].is_joint = true;
}

/// A vertex of one long side in the edge of the tile on the other.
void Closing::put_into(std::size_t side, double share, std::size_t corner) {
  const double start = along_.at(sides_[side]);
  const double length = along_.wrapped(along_.at(sides_[(side + 1) % 4]) - start);
  const auto on = along_.place(start + (side == 3 ? 1.0 - share : share) * length);
  const auto edge = beyond(on.edge);
  if (!edge) return;  // a street is there: nobody to join
  const auto& ring = layout_.tiles[edge->tile].rings[edge->ring];
  const double along = 1.0 - on.along_01;  // the other tile's edge runs against this ring
  const Point rest =
      lerp(ring[edge->corner].rest, ring[(edge->corner + 1) % ring.size()].rest, along);
  put_in_[{edge->tile, edge->ring}].push_back(
      {{edge->corner, along}, {corners_[corner].vertex, rest}});
  out_.vertices[corners_[corner].vertex].is_joint = true;
}

/// Sides 1 and 3 laid on each other.
void Closing::zip() {
  for (const std::size_t side : {0U, 2U}) {
    for (std::size_t i = sides_[side]; i != sides_[side + 1]; i = (i + 1) % size())
      merge(i, (i + 1) % size());
  }
  const double length = 0.5 * (along_.wrapped(along_.at(sides_[2]) - along_.at(sides_[1])) +
                               along_.wrapped(along_.at(sides_[0]) - along_.at(sides_[3])));
  const std::vector<Bead> left = beads(1);
  const std::vector<Bead> right = beads(3);
  const double near = kNear_m / std::max(length, kNear_m);
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < left.size() || j < right.size()) {
    const double a = i < left.size() ? left[i].along_01 : 2.0;
    const double b = j < right.size() ? right[j].along_01 : 2.0;
    if (std::abs(a - b) <= near) {
      merge(left[i++].corner, right[j++].corner);
    } else if (a < b) {
      put_into(3, a, left[i++].corner);
    } else {
      put_into(1, b, right[j++].corner);
    }
  }
}

/// Runs of one vertex become a corner in their middle; ways there and back go. False where less
/// than three corners are left, or a ring visits a vertex twice.
bool clean_ring(std::vector<Corner>& ring) {
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t i = 0; i < ring.size() && ring.size() >= 3; ++i) {
      const std::size_t next = (i + 1) % ring.size();
      const std::size_t after = (i + 2) % ring.size();
      if (ring[i].vertex == ring[next].vertex) {
        ring[i].rest = midpoint(ring[i].rest, ring[next].rest);
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(next));
        is_changed = true;
        break;
      }
      if (ring[i].vertex == ring[after].vertex) {
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(next));
        is_changed = true;
        break;
      }
    }
  }
  std::set<std::uint32_t> seen;
  for (const Corner& corner : ring) {
    if (!seen.insert(corner.vertex).second) return false;
  }
  return ring.size() >= 3;
}

bool Closing::clean_rings() {
  for (std::uint32_t t = 0; t < out_.tiles.size(); ++t) {
    if (t == tile_ || out_.tiles[t].block != out_.tiles[tile_].block) continue;
    for (std::uint32_t r = 0; r < out_.tiles[t].rings.size(); ++r) {
      auto& ring = out_.tiles[t].rings[r];
      bool is_touched = false;
      if (const auto found = put_in_.find({t, r}); found != put_in_.end()) {
        is_touched = true;
        auto put_in = found->second;
        std::ranges::stable_sort(put_in, {}, [](const auto& item) { return item.first; });
        for (auto it = put_in.rbegin(); it != put_in.rend(); ++it)
          ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(it->first.first) + 1, it->second);
      }
      for (Corner& corner : ring) {
        while (merged_[corner.vertex] != corner.vertex) {
          corner.vertex = merged_[corner.vertex];
          is_touched = true;
        }
      }
      if (is_touched && !clean_ring(ring)) return false;
    }
  }
  return true;
}

/// The tile beyond a place of a long side, and the point of it.
std::optional<Heir> Closing::heir_across(std::size_t side, double share) const {
  const double start = along_.at(sides_[side]);
  const double length = along_.wrapped(along_.at(sides_[(side + 1) % 4]) - start);
  const auto on = along_.place(start + share * length);
  const auto edge = beyond(on.edge);
  if (!edge) return std::nullopt;
  const auto& ring = layout_.tiles[edge->tile].rings[edge->ring];
  return Heir{edge->tile, lerp(ring[(edge->corner + 1) % ring.size()].rest, ring[edge->corner].rest,
                               on.along_01)};
}

/// Who takes over what was at a place of the ring: beyond a long side, the tile beyond the other
/// long side; beyond a side that becomes a point, the nearer of the tiles at its ends.
std::optional<Heir> Closing::heir_of(double s) const {
  constexpr double kInside_01 = 1e-6;  // off the corner, so that the edge is that of the side
  const std::size_t side = side_of(s);
  const double share = along_01(side, s);
  if (side == 1 || side == 3) return heir_across(4 - side, 1.0 - share);
  const std::size_t before = side == 0 ? 3 : 1;
  const std::size_t after = side == 0 ? 1 : 3;
  const auto first = heir_across(before, 1.0 - kInside_01);
  const auto second = heir_across(after, kInside_01);
  if (first && (share < 0.5 || !second)) return first;
  return second;
}

/// Tiles that are connected by links or common vertices have the same number.
std::vector<std::uint32_t> connections(const TileLayout& layout) {
  std::vector<std::uint32_t> root(layout.tiles.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::vector<std::optional<std::uint32_t>> first(layout.vertices.size());
  for (std::uint32_t t = 0; t < layout.tiles.size(); ++t) {
    for (const auto& ring : layout.tiles[t].rings) {
      for (const Corner& corner : ring) {
        if (first[corner.vertex])
          root[find(t)] = find(*first[corner.vertex]);
        else
          first[corner.vertex] = t;
      }
    }
  }
  for (const StreetLink& link : layout.links) root[find(link.a)] = find(link.b);
  for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = find(i);
  return root;
}

void Closing::hand_over_links() {
  struct Loose {
    Heir far;  ///< what lies across the street
    double s = 0.0;
    double width_m = 0.0;
  };
  std::vector<Loose> loose;
  std::vector<StreetLink> links;
  const Tile& tile = layout_.tiles[tile_];
  for (const StreetLink& link : layout_.links) {
    if (link.a != tile_ && link.b != tile_) {
      links.push_back(link);
      continue;
    }
    const Heir far = link.a == tile_ ? Heir{link.b, link.rest_b} : Heir{link.a, link.rest_a};
    const Point now = tile.placement(link.a == tile_ ? link.rest_a : link.rest_b);
    const double s = along_.nearest(now);
    const auto heir = heir_of(s);
    if (!heir || heir->tile == far.tile) {
      loose.push_back({far, s, link.width_m});
      continue;
    }
    const auto back = out_.tiles[heir->tile].placement.inverse();
    const Point reach = back ? back->linear(now - along_.point(s)) : Point{};
    links.push_back({far.tile, far.rest, heir->tile, heir->rest + reach, link.width_m});
  }
  // Streets on both sides, and no neighbour: what lies across them is linked in pairs.
  for (const Loose& from : loose) {
    if (side_of(from.s) != 1) continue;
    const double share = along_01(1, from.s);
    const Loose* best = nullptr;
    for (const Loose& to : loose) {
      if (side_of(to.s) != 3 || to.far.tile == from.far.tile) continue;
      const auto off = [&](const Loose& l) { return std::abs(1.0 - along_01(3, l.s) - share); };
      if (best == nullptr || off(to) < off(*best)) best = &to;
    }
    if (best != nullptr)
      links.push_back({from.far.tile, from.far.rest, best->far.tile, best->far.rest,
                       0.5 * (from.width_m + best->width_m)});
  }
  out_.links = std::move(links);
  // Whatever only the tile connected stays connected.
  std::vector<Heir> met;
  for (const Loose& l : loose) met.push_back(l.far);
  for (std::size_t i = 0; i < size(); ++i) {
    if (const auto edge = beyond(i))
      met.push_back({edge->tile, layout_.tiles[edge->tile].rings[edge->ring][edge->corner].rest});
  }
  for (std::size_t k = 1; k < met.size(); ++k) {
    const auto root = connections(take());
    const auto at = [&](std::uint32_t t) { return root[t > tile_ ? t - 1 : t]; };
    if (at(met[k].tile) != at(met.front().tile))
      out_.links.push_back({met.front().tile, met.front().rest, met[k].tile, met[k].rest, 0.0});
  }
}

bool Closing::run() {
  zip();
  if (!clean_rings()) return false;
  hand_over_links();
  return true;
}

/// A tile that one other tile surrounds: the hole in that one, which is closed by taking it away.
std::optional<EdgePlace> surrounding(const TileLayout& layout, std::uint32_t tile) {
  const EdgeMap edges = edges_of_block(layout, layout.tiles[tile].block);
  const auto& ring = layout.tiles[tile].rings.front();
  std::optional<EdgePlace> out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto found = edges.find({ring[(i + 1) % ring.size()].vertex, ring[i].vertex});
    if (found == edges.end() || found->second.ring == 0) return std::nullopt;
    if (out && (out->tile != found->second.tile || out->ring != found->second.ring))
      return std::nullopt;
    out = found->second;
  }
  if (out && layout.tiles[out->tile].rings[out->ring].size() != ring.size()) return std::nullopt;
  return out;
}

bool has_tile_within(const TileLayout& layout, std::uint32_t tile) {
  const auto& rings = layout.tiles[tile].rings;
  const EdgeMap edges = edges_of_block(layout, layout.tiles[tile].block);
  for (std::size_t r = 1; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      if (edges.contains({rings[r][(i + 1) % rings[r].size()].vertex, rings[r][i].vertex}))
        return true;
    }
  }
  return false;
}

}  // namespace

Expected<TileLayout> without_land(const TileLayout& layout, std::uint32_t tile) {
  const TileId id = layout.tiles[tile].id;
  if (has_tile_within(layout, tile))
    return fail(FailureCode::kNoPlace,
                fmt::format("tile {} surrounds another tile: its land cannot be closed", id.value));
  if (const auto hole = surrounding(layout, tile)) {
    TileLayout out = layout;
    auto& rings = out.tiles[hole->tile].rings;
    rings.erase(rings.begin() + hole->ring);
    return without_tiles(out, std::array{tile});
  }
  const unsigned first =
      Closing(layout, tile, 1).lost_m() <= Closing(layout, tile, 0).lost_m() ? 1 : 0;
  for (const unsigned turn : {first, 1 - first}) {
    Closing way(layout, tile, turn);
    if (way.run()) return way.take();
  }
  return fail(FailureCode::kNoPlace,
              fmt::format("no two sides of tile {} can be laid on each other", id.value));
}

}  // namespace plat::tiles::detail

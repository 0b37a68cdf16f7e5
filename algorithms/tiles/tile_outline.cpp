#include <algorithm>
#include <cmath>
#include <set>

#include "tiles/tile_outline_internal.h"

namespace plat::tiles::detail {
namespace {

/// A vertex of a neighbour that was put into a straight edge lies off it by the rounding of the
/// working grid; a corner of a survey by decimetres.
constexpr double kStraight_m = 0.01;

void add_edges(const TileLayout& layout, std::uint32_t tile, EdgeMap& out) {
  const auto& rings = layout.tiles[tile].rings;
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    const auto n = static_cast<std::uint32_t>(rings[r].size());
    for (std::uint32_t i = 0; i < n; ++i)
      out.emplace(std::pair{rings[r][i].vertex, rings[r][(i + 1) % n].vertex},
                  EdgePlace{tile, r, i});
  }
}

}  // namespace

EdgeMap edges_of(const TileLayout& layout, std::span<const std::uint32_t> tiles) {
  EdgeMap out;
  for (const std::uint32_t tile : tiles) add_edges(layout, tile, out);
  return out;
}

EdgeMap edges_of_block(const TileLayout& layout, std::uint32_t block) {
  EdgeMap out;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    if (layout.tiles[i].block == block) add_edges(layout, i, out);
  }
  return out;
}

std::optional<std::vector<OutlineEdge>> outline_of(const TileLayout& layout,
                                                   std::span<const std::uint32_t> tiles) {
  const EdgeMap edges = edges_of(layout, tiles);
  std::map<std::uint32_t, std::pair<std::uint32_t, EdgePlace>> next;
  for (const auto& [edge, place] : edges) {
    const bool is_hole = place.ring != 0;
    if (edges.contains({edge.second, edge.first})) continue;
    if (is_hole) continue;
    if (!next.emplace(edge.first, std::pair{edge.second, place}).second) return std::nullopt;
  }
  if (next.size() < 3) return std::nullopt;
  std::vector<OutlineEdge> out;
  const std::uint32_t first = next.begin()->first;
  std::uint32_t at = first;
  do {
    const auto step = next.find(at);
    if (step == next.end() || out.size() == next.size()) return std::nullopt;
    out.push_back({at, step->second.second});
    at = step->second.first;
  } while (at != first);
  if (out.size() != next.size()) return std::nullopt;  // another ring: a hole, or another region
  return out;
}

similarity::LabelledShape shape_of(const TileLayout& layout, std::span<const OutlineEdge> outline,
                                   const EdgeMap& edges_of_block) {
  using similarity::EdgeLabel;
  similarity::LabelledShape out;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::uint32_t from = outline[i].vertex;
    const std::uint32_t to = outline[(i + 1) % outline.size()].vertex;
    out.polygon.outer.push_back(layout.vertices[from].at);
    out.edges.push_back(edges_of_block.contains({to, from}) ? EdgeLabel::kProperty
                                                            : EdgeLabel::kStreet);
  }
  if (!outline.empty()) out.zone = layout.tiles[outline.front().place.tile].zone;
  return out;
}

std::vector<std::vector<std::uint32_t>> connected_tiles(const TileLayout& layout) {
  std::vector<std::uint32_t> all(layout.tiles.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  const EdgeMap edges = edges_of(layout, all);
  std::vector<std::vector<std::uint32_t>> neighbours(all.size());
  for (const auto& [edge, place] : edges) {
    if (const auto other = edges.find({edge.second, edge.first}); other != edges.end())
      neighbours[place.tile].push_back(other->second.tile);
  }
  std::vector<std::vector<std::uint32_t>> out;
  std::vector<bool> is_seen(all.size(), false);
  for (const std::uint32_t seed : all) {
    if (is_seen[seed]) continue;
    std::vector<std::uint32_t> members{seed};
    is_seen[seed] = true;
    for (std::size_t k = 0; k < members.size(); ++k) {
      for (const std::uint32_t other : neighbours[members[k]]) {
        if (is_seen[other]) continue;
        is_seen[other] = true;
        members.push_back(other);
      }
    }
    std::ranges::sort(members);
    out.push_back(std::move(members));
  }
  return out;
}

ArcLength::ArcLength(Ring ring) : ring_(std::move(ring)), at_{0.0} {
  for (std::size_t i = 0; i < ring_.size(); ++i)
    at_.push_back(at_.back() + distance(ring_[i], ring_[(i + 1) % ring_.size()]));
}

double ArcLength::nearest(Point p) const {
  double best = std::numeric_limits<double>::infinity();
  double out = 0.0;
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const Segment edge{ring_[i], ring_[(i + 1) % ring_.size()]};
    const double t = nearest_parameter(edge, p);
    const double d = distance(lerp(edge.a, edge.b, t), p);
    if (d < best) {
      best = d;
      out = at_[i] + t * (at_[i + 1] - at_[i]);
    }
  }
  return wrapped(out);
}

ArcLength::Place ArcLength::place(double s) const {
  s = wrapped(s);
  const auto after = std::upper_bound(at_.begin() + 1, at_.end() - 1, s);
  const auto edge = static_cast<std::size_t>(after - at_.begin()) - 1;
  const double span = at_[edge + 1] - at_[edge];
  return {edge, span > 0.0 ? std::clamp((s - at_[edge]) / span, 0.0, 1.0) : 0.0};
}

Point ArcLength::point(double s) const {
  const Place p = place(s);
  return lerp(ring_[p.edge], ring_[(p.edge + 1) % ring_.size()], p.along_01);
}

double ArcLength::wrapped(double s) const {
  const double total = total_m();
  const double out = s - total * std::floor(s / total);
  return out >= total ? 0.0 : out;
}

bool is_straight_at_rest(const std::vector<Corner>& ring, std::size_t corner) {
  const std::size_t n = ring.size();
  if (n <= 3) return false;
  const Point before = ring[(corner + n - 1) % n].rest;
  const Point after = ring[(corner + 1) % n].rest;
  return distance(Segment{before, after}, ring[corner].rest) < kStraight_m;
}

}  // namespace plat::tiles::detail

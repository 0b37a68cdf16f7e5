#include "tiles/tile_substitution_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "tiles/outline_matching_internal.h"
#include "tiles/reconfiguration_internal.h"
#include "tiles/tile_outline_internal.h"

namespace plat::tiles::detail {
namespace {

/// A corner of the piece and a vertex of the hole as near as this along the outline become one, as
/// near vertices do in the one-time simplification.
constexpr double kNear_m = 2.0;
/// A vertex of the piece that only divides a straight edge is taken up where the hole has one as
/// near as this: what pasting back finds again after the neighbours have moved a little.
constexpr double kNearOnEdge_m = 0.5;

using RingKey = std::pair<std::uint32_t, std::uint32_t>;  ///< tile and ring

/// A corner put into the edge that begins at a corner of a ring.
struct PutIn {
  std::uint32_t after = 0;
  double along_01 = 0.0;
  Corner corner;
};

struct RingChange {
  std::vector<PutIn> put_in;
  std::set<std::uint32_t> dropped;
};

void change_ring(std::vector<Corner>& ring, RingChange change) {
  std::ranges::stable_sort(change.put_in, {},
                           [](const PutIn& p) { return std::pair{p.after, p.along_01}; });
  std::vector<Corner> out;
  auto next = change.put_in.begin();
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    if (!change.dropped.contains(i)) out.push_back(ring[i]);
    for (; next != change.put_in.end() && next->after == i; ++next) out.push_back(next->corner);
  }
  ring = std::move(out);
}

/// What lies at one place of the common outline: a corner of the piece, a vertex of the hole that
/// other tiles have, or both.
struct Station {
  double s_m = 0.0;  ///< from the first anchor, along the piece
  std::optional<std::size_t> piece;
  std::optional<std::size_t> hole;
};

class Substituter {
 public:
  Substituter(const TileLayout& layout, const Substitution& substitution)
      : out_(layout), piece_(*substitution.piece), what_(substitution) {}

  Expected<Substituted> run();

 private:
  [[nodiscard]] std::optional<Failure> find_outlines();
  void place();
  void mark_use();
  void pair_vertices();
  void order_stations();
  void join_piece();
  void join_neighbours();
  void drop_unmet();
  void hand_over_links();
  Substituted finish();

  [[nodiscard]] double ahead_m(double s) const {
    const double total = along_piece_->total_m();
    const double way = along_piece_->wrapped(s - map_->anchors().front().first);
    return way >= total ? 0.0 : way;
  }
  /// Whether a corner of the piece only divides a straight edge, where a neighbour will be.
  [[nodiscard]] bool is_dropped(std::size_t i) const;

  TileLayout out_;
  const TileLayout& piece_;
  const Substitution& what_;

  std::vector<std::uint32_t> piece_tiles_;
  std::vector<OutlineEdge> piece_outline_;
  std::vector<OutlineEdge> hole_outline_;
  EdgeMap beyond_;  ///< edges of tiles of the block that stay
  std::optional<ArcLength> along_piece_;
  std::optional<ArcLength> along_hole_;
  std::optional<ArcMap> map_;
  Affine motion_;

  std::vector<bool> is_loose_;                   ///< per outline corner of the piece
  std::vector<std::vector<EdgePlace>> used_by_;  ///< per hole vertex: corners of tiles that stay
  std::vector<std::optional<std::size_t>> paired_hole_;   ///< per corner of the piece
  std::vector<std::optional<std::size_t>> paired_piece_;  ///< per vertex of the hole
  std::vector<Station> stations_;
  std::vector<std::uint32_t> vertex_of_;  ///< per vertex of the piece: of the layout
  std::map<RingKey, RingChange> piece_changes_;
  std::map<RingKey, RingChange> layout_changes_;
  std::uint32_t first_new_ = 0;
};

std::optional<Failure> Substituter::find_outlines() {
  for (std::uint32_t i = 0; i < piece_.tiles.size(); ++i) piece_tiles_.push_back(i);
  const auto piece = outline_of(piece_, piece_tiles_);
  if (!piece) return Failure{FailureCode::kNoPlace, "the outline of what is pasted is no ring"};
  const auto hole = outline_of(out_, what_.replaced);
  if (!hole)
    return Failure{FailureCode::kNoPlace,
                   fmt::format("the outline of the {} tiles to be replaced is no ring",
                               what_.replaced.size())};
  piece_outline_ = *piece;
  hole_outline_ = *hole;
  const std::uint32_t block = out_.tiles[what_.replaced.front()].block;
  std::vector<std::uint32_t> staying;
  for (std::uint32_t i = 0; i < out_.tiles.size(); ++i) {
    if (out_.tiles[i].block == block && !std::ranges::binary_search(what_.replaced, i))
      staying.push_back(i);
  }
  beyond_ = edges_of(out_, staying);
  for (const auto& [edge, edge_place] : edges_of(out_, what_.replaced)) {
    if (edge_place.ring != 0 && beyond_.contains({edge.second, edge.first}))
      return Failure{FailureCode::kNoPlace, fmt::format("tile {} surrounds a tile that stays",
                                                        out_.tiles[edge_place.tile].id.value)};
  }
  return std::nullopt;
}

void Substituter::place() {
  const auto ring_of = [](const TileLayout& layout, const std::vector<OutlineEdge>& outline) {
    Ring ring;
    for (const OutlineEdge& edge : outline) ring.push_back(layout.vertices[edge.vertex].at);
    return ring;
  };
  along_piece_.emplace(ring_of(piece_, piece_outline_));
  along_hole_.emplace(ring_of(out_, hole_outline_));
  const OutlineMatch match =
      match_outlines(what_.comparison, *along_piece_, *along_hole_, what_.as_placed);
  motion_ = match.motion;
  map_.emplace(along_piece_->total_m(), along_hole_->total_m(), match.anchors);
}

void Substituter::mark_use() {
  std::map<std::uint32_t, std::size_t> hole_vertex;
  for (std::size_t j = 0; j < hole_outline_.size(); ++j)
    hole_vertex.emplace(hole_outline_[j].vertex, j);
  used_by_.resize(hole_outline_.size());
  for (const auto& [edge, edge_place] : beyond_) {
    if (const auto found = hole_vertex.find(edge.first); found != hole_vertex.end())
      used_by_[found->second].push_back(edge_place);
  }
  std::map<std::uint32_t, int> uses;
  for (const Tile& tile : piece_.tiles) {
    for (const auto& ring : tile.rings) {
      for (const Corner& corner : ring) ++uses[corner.vertex];
    }
  }
  for (const OutlineEdge& edge : piece_outline_) {
    const auto& ring = piece_.tiles[edge.place.tile].rings[edge.place.ring];
    is_loose_.push_back(uses[edge.vertex] == 1 && is_straight_at_rest(ring, edge.place.corner));
  }
}

/// Corners and vertices that are each other's nearest along the outline, and near, are one.
void Substituter::pair_vertices() {
  const std::size_t n = piece_outline_.size();
  const std::size_t m = hole_outline_.size();
  paired_hole_.assign(n, std::nullopt);
  paired_piece_.assign(m, std::nullopt);
  const double total = along_piece_->total_m();
  const auto apart = [&](std::size_t i, std::size_t j) {
    return std::abs(std::remainder(along_piece_->at(i) - map_->from(along_hole_->at(j)), total));
  };
  std::vector<std::optional<std::size_t>> nearest_hole(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < m; ++j) {
      if (used_by_[j].empty()) continue;
      if (!nearest_hole[i] || apart(i, j) < apart(i, *nearest_hole[i])) nearest_hole[i] = j;
    }
  }
  std::vector<ArcMap::Anchor> anchors;
  for (std::size_t j = 0; j < m; ++j) {
    if (used_by_[j].empty()) continue;
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < n; ++i) {
      if (apart(i, j) < apart(nearest, j)) nearest = i;
    }
    if (nearest_hole[nearest] != j) continue;
    if (apart(nearest, j) > (is_loose_[nearest] ? kNearOnEdge_m : kNear_m)) continue;
    anchors.emplace_back(along_piece_->at(nearest), along_hole_->at(j));
    paired_hole_[nearest] = j;
    paired_piece_[j] = nearest;
  }
  if (anchors.empty()) return;
  // The pairs hold exactly; what the similarity says between them stays where it agrees.
  map_.emplace(total, along_hole_->total_m(), anchors);
  for (std::size_t i = 0; i < n; ++i) {
    if (!paired_hole_[i]) continue;
    const bool is_kept = std::ranges::any_of(map_->anchors(), [&](const ArcMap::Anchor& anchor) {
      return anchor.first == along_piece_->at(i);
    });
    if (is_kept) continue;
    paired_piece_[*paired_hole_[i]] = std::nullopt;
    paired_hole_[i] = std::nullopt;
  }
}

bool Substituter::is_dropped(std::size_t i) const {
  if (paired_hole_[i] || !is_loose_[i]) return false;
  const std::size_t j = along_hole_->place(map_->to(along_piece_->at(i))).edge;
  const std::size_t next = (j + 1) % hole_outline_.size();
  return beyond_.contains({hole_outline_[next].vertex, hole_outline_[j].vertex});
}

void Substituter::order_stations() {
  for (std::size_t i = 0; i < piece_outline_.size(); ++i) {
    if (is_dropped(i)) continue;
    stations_.push_back({ahead_m(along_piece_->at(i)), i, paired_hole_[i]});
  }
  for (std::size_t j = 0; j < hole_outline_.size(); ++j) {
    if (used_by_[j].empty() || paired_piece_[j]) continue;
    stations_.push_back({ahead_m(map_->from(along_hole_->at(j))), std::nullopt, j});
  }
  std::ranges::stable_sort(stations_, {}, &Station::s_m);
}

/// The piece's vertices in the layout, and the hole's vertices in the piece's edges.
void Substituter::join_piece() {
  vertex_of_.assign(piece_.vertices.size(), 0);
  std::vector<bool> is_taken(piece_.vertices.size(), false);
  for (std::size_t i = 0; i < piece_outline_.size(); ++i) {
    const std::uint32_t own = piece_outline_[i].vertex;
    if (!paired_hole_[i]) continue;
    LayoutVertex& vertex = out_.vertices[hole_outline_[*paired_hole_[i]].vertex];
    vertex.is_joint = vertex.is_joint || piece_.vertices[own].is_joint;
    vertex_of_[own] = hole_outline_[*paired_hole_[i]].vertex;
    is_taken[own] = true;
  }
  for (std::uint32_t v = 0; v < piece_.vertices.size(); ++v) {
    if (is_taken[v]) continue;
    vertex_of_[v] = static_cast<std::uint32_t>(out_.vertices.size());
    out_.vertices.push_back({motion_(piece_.vertices[v].at), piece_.vertices[v].is_joint});
  }
  for (std::size_t i = 0; i < piece_outline_.size(); ++i) {
    const EdgePlace& at = piece_outline_[i].place;
    if (is_dropped(i)) piece_changes_[{at.tile, at.ring}].dropped.insert(at.corner);
  }
  // Stations between two corners of the piece are on the edge of the first: its part of the way
  // is that of the vertex's. Loose corners divide edges, and divide them still.
  for (const Station& station : stations_) {
    if (station.piece) continue;
    const auto on = along_piece_->place(station.s_m + map_->anchors().front().first);
    const EdgePlace& at = piece_outline_[on.edge].place;
    const auto& ring = piece_.tiles[at.tile].rings[at.ring];
    const Point rest =
        lerp(ring[at.corner].rest, ring[(at.corner + 1) % ring.size()].rest, on.along_01);
    piece_changes_[{at.tile, at.ring}].put_in.push_back(
        {at.corner, on.along_01, {hole_outline_[*station.hole].vertex, rest}});
  }
}

/// The piece's own corners in the edges of the neighbours.
void Substituter::join_neighbours() {
  std::vector<std::size_t> held;  // stations of vertices that neighbours have
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    if (stations_[k].hole) held.push_back(k);
  }
  for (std::size_t h = 0; h < held.size(); ++h) {
    const std::size_t first = held[h];
    const std::size_t last = held[(h + 1) % held.size()];
    const std::size_t j = *stations_[first].hole;
    const std::size_t next = (j + 1) % hole_outline_.size();
    if (stations_[last].hole != next) continue;
    const auto neighbour = beyond_.find({hole_outline_[next].vertex, hole_outline_[j].vertex});
    if (neighbour == beyond_.end()) continue;  // along a street
    const EdgePlace& at = neighbour->second;
    const auto& ring = out_.tiles[at.tile].rings[at.ring];
    const double start = stations_[first].s_m;
    const double way = along_piece_->wrapped(stations_[last].s_m - start);
    for (std::size_t k = (first + 1) % stations_.size(); k != last;
         k = (k + 1) % stations_.size()) {
      // The neighbour's edge runs the other way.
      const double share = 1.0 - along_piece_->wrapped(stations_[k].s_m - start) / way;
      const std::uint32_t vertex = vertex_of_[piece_outline_[*stations_[k].piece].vertex];
      out_.vertices[vertex].is_joint = true;
      const Point rest =
          lerp(ring[at.corner].rest, ring[(at.corner + 1) % ring.size()].rest, share);
      layout_changes_[{at.tile, at.ring}].put_in.push_back({at.corner, share, {vertex, rest}});
    }
  }
}

/// Vertices in a neighbour's straight edge that only the replaced had, and the piece has not.
void Substituter::drop_unmet() {
  if (what_.unmet == UnmetVertices::kKept) return;
  for (std::size_t j = 0; j < hole_outline_.size(); ++j) {
    if (used_by_[j].size() != 1 || paired_piece_[j]) continue;
    const EdgePlace& at = used_by_[j].front();
    const auto& ring = out_.tiles[at.tile].rings[at.ring];
    if (!is_straight_at_rest(ring, at.corner)) continue;
    RingChange& change = layout_changes_[{at.tile, at.ring}];
    if (ring.size() - change.dropped.size() <= 3) continue;
    change.dropped.insert(at.corner);
    const auto station =
        std::ranges::find_if(stations_, [&](const Station& s) { return !s.piece && s.hole == j; });
    for (auto& [key, piece_change] : piece_changes_) {
      std::erase_if(piece_change.put_in, [&](const PutIn& put_in) {
        return put_in.corner.vertex == hole_outline_[j].vertex;
      });
    }
    stations_.erase(station);
  }
}

void Substituter::hand_over_links() {
  const auto is_replaced = [&](std::uint32_t tile) {
    return std::ranges::binary_search(what_.replaced, tile);
  };
  const auto hand_over = [&](std::uint32_t& tile, Point& rest) {
    const Point now = out_.tiles[tile].placement(rest);
    const double t = along_hole_->nearest(now);
    const auto on = along_piece_->place(map_->from(t));
    const EdgePlace& at = piece_outline_[on.edge].place;
    const Tile& heir = piece_.tiles[at.tile];
    const auto& ring = heir.rings[at.ring];
    const Point foot =
        lerp(ring[at.corner].rest, ring[(at.corner + 1) % ring.size()].rest, on.along_01);
    const auto back = (motion_ * heir.placement).inverse();
    tile = first_new_ + at.tile;
    rest = foot + (back ? back->linear(now - along_hole_->point(t)) : Point{});
  };
  for (StreetLink& link : out_.links) {
    const bool a = is_replaced(link.a);
    const bool b = is_replaced(link.b);
    if (a && b) {
      link.b = link.a;  // to be dropped with the tiles
    } else if (a) {
      hand_over(link.a, link.rest_a);
    } else if (b) {
      hand_over(link.b, link.rest_b);
    }
  }
  for (StreetLink link : piece_.links) {
    link.a += first_new_;
    link.b += first_new_;
    out_.links.push_back(link);
  }
}

Substituted Substituter::finish() {
  for (const auto& [key, change] : layout_changes_)
    change_ring(out_.tiles[key.first].rings[key.second], change);
  const std::uint32_t block = out_.tiles[what_.replaced.front()].block;
  for (std::uint32_t i = 0; i < piece_.tiles.size(); ++i) {
    Tile tile = piece_.tiles[i];
    for (auto& ring : tile.rings) {
      for (Corner& corner : ring) corner.vertex = vertex_of_[corner.vertex];
    }
    for (std::uint32_t r = 0; r < tile.rings.size(); ++r) {
      if (const auto change = piece_changes_.find({i, r}); change != piece_changes_.end())
        change_ring(tile.rings[r], change->second);
    }
    tile.id = {out_.next_id++};
    tile.block = block;
    tile.is_pinned = false;
    tile.placement = motion_ * tile.placement;
    out_.tiles.push_back(std::move(tile));
  }
  const auto count = static_cast<std::uint32_t>(piece_.tiles.size());
  Substituted result{without_tiles(out_, what_.replaced), {}};
  const auto end = static_cast<std::uint32_t>(result.layout.tiles.size());
  for (std::uint32_t i = end - count; i < end; ++i) result.tiles.push_back(i);
  return result;
}

Expected<Substituted> Substituter::run() {
  if (auto failure = find_outlines()) return tl::unexpected(*std::move(failure));
  first_new_ = static_cast<std::uint32_t>(out_.tiles.size());
  place();
  mark_use();
  pair_vertices();
  order_stations();
  join_piece();
  join_neighbours();
  drop_unmet();
  hand_over_links();
  return finish();
}

}  // namespace

Expected<Substituted> substituted(const TileLayout& layout, const Substitution& substitution) {
  expects(substitution.piece != nullptr && !substitution.replaced.empty(),
          "something takes the place of something");
  return Substituter(layout, substitution).run();
}

}  // namespace plat::tiles::detail

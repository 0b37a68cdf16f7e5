#include "tiles/tile_destination_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "tiles/reconfiguration_internal.h"
#include "tiles/tile_outline_internal.h"

namespace plat::tiles::detail {
namespace {

/// Points across the piece's box, each way, by which it is seen what it lies on.
constexpr int kSamplesAcross = 16;
/// Less of a piece on tiles is a paste on a street, on water or across a border.
constexpr double kOnTiles_01 = 0.5;
/// Of unions that overlap the piece this much as well as the best does, the most similar is taken.
constexpr double kOverlap_01 = 0.75;
/// A neighbour of which less lies under the piece is not merged.
constexpr double kUnderPiece_01 = 0.3;
/// A union this many times as large as the piece is not grown further.
constexpr double kMuchLarger = 1.5;

similarity::LabelledShape labelled(const TileLayout& layout, std::span<const OutlineEdge> outline,
                                   const TileGroup& group) {
  similarity::LabelledShape out = shape_of(layout, outline, {});
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::pair edge{outline[i].vertex, outline[(i + 1) % outline.size()].vertex};
    if (std::ranges::binary_search(group.property_edges, edge))
      out.edges[i] = similarity::EdgeLabel::kProperty;
  }
  return out;
}

std::optional<Piece> piece_of(const TileGroup& group, const std::vector<std::uint32_t>& members) {
  const auto outline = outline_of(group.tiles, members);
  if (!outline) return std::nullopt;
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; i < group.tiles.tiles.size(); ++i) {
    if (!std::ranges::binary_search(members, i)) others.push_back(i);
  }
  return Piece{without_tiles(group.tiles, others), labelled(group.tiles, *outline, group), members};
}

std::vector<Point> points_in(const Polygon& shape) {
  std::vector<Point> out{interior_point(shape)};
  const Box box = plat::box_of(shape);
  for (int i = 0; i < kSamplesAcross; ++i) {
    for (int j = 0; j < kSamplesAcross; ++j) {
      const Point p{box.min.x + (i + 0.5) / kSamplesAcross * box.width(),
                    box.min.y + (j + 0.5) / kSamplesAcross * box.height()};
      if (locate(shape, p) == Side::kInside) out.push_back(p);
    }
  }
  return out;
}

/// How many of the points lie on each tile that may be replaced: not on pinned ones.
std::map<std::uint32_t, std::size_t> points_on(const TileLayout& layout,
                                               const std::vector<Point>& points,
                                               std::span<const TileId> kept) {
  const Box around = plat::box_of(points);
  std::map<std::uint32_t, std::size_t> out;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    const Tile& tile = layout.tiles[i];
    if (tile.is_pinned || std::ranges::binary_search(kept, tile.id) ||
        !box_of(layout, tile).intersects(around))
      continue;
    const Polygon shape = plat::tiles::shape_of(layout, tile);
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(points, [&](Point p) { return locate(shape, p) != Side::kOutside; }));
    if (count > 0) out.emplace(i, count);
  }
  return out;
}

/// The tile under the centre, else the one under most of the piece.
std::uint32_t seed_of(const TileLayout& layout, const std::map<std::uint32_t, std::size_t>& under,
                      Point center) {
  std::uint32_t best = under.begin()->first;
  for (const auto& [tile, count] : under) {
    if (locate(plat::tiles::shape_of(layout, layout.tiles[tile]), center) == Side::kInside)
      return tile;
    if (count > under.at(best)) best = tile;
  }
  return best;
}

/// The neighbour of the union of whose land most lies under the piece; none where that is little.
std::optional<std::uint32_t> next_of(const TileLayout& layout,
                                     const std::set<std::uint32_t>& members, const EdgeMap& edges,
                                     const std::map<std::uint32_t, std::size_t>& under,
                                     double area_of_point_m2) {
  std::optional<std::uint32_t> best;
  double most = kUnderPiece_01;
  for (const auto& [edge, place] : edges) {
    if (!members.contains(place.tile)) continue;
    const auto beyond = edges.find({edge.second, edge.first});
    if (beyond == edges.end() || members.contains(beyond->second.tile)) continue;
    const std::uint32_t tile = beyond->second.tile;
    const auto found = under.find(tile);
    if (found == under.end()) continue;
    const double share = static_cast<double>(found->second) * area_of_point_m2 /
                         area_m2(plat::tiles::shape_of(layout, layout.tiles[tile]));
    if (share > most || (best && share == most && tile < *best)) {
      best = tile;
      most = share;
    }
  }
  return best;
}

}  // namespace

similarity::AnyShapeSimilarity measure_of(const ReconfigurationOptions& options) {
  return similarity::shape_similarities().at(options.similarity).make(options.similarity_options);
}

Expected<std::vector<Piece>> pieces_of(const TileGroup& group) {
  std::vector<Piece> out;
  for (const auto& members : connected_tiles(group.tiles)) {
    if (auto piece = piece_of(group, members)) {
      out.push_back(*std::move(piece));
      continue;
    }
    for (const std::uint32_t member : members) {
      auto single = piece_of(group, {member});
      if (!single)
        return fail(FailureCode::kNoPlace, fmt::format("the outline of tile {} touches itself",
                                                       group.tiles.tiles[member].id.value));
      out.push_back(*std::move(single));
    }
  }
  return out;
}

Expected<Destination> find_destination(const TileLayout& layout, const Piece& piece,
                                       const Affine& to,
                                       const similarity::AnyShapeSimilarity& measure,
                                       std::span<const TileId> kept) {
  const Polygon placed = transformed(to, piece.shape.polygon);
  const std::vector<Point> points = points_in(placed);
  const auto under = points_on(layout, points, kept);
  std::size_t covered = 0;
  for (const auto& [tile, count] : under) covered += count;
  const double share = static_cast<double>(covered) / static_cast<double>(points.size());
  const Point center = centroid(placed);
  if (share < kOnTiles_01)
    return fail(
        FailureCode::kNoPlace,
        fmt::format("{:.0f} % of what is pasted at ({:.1f}, {:.1f}) would lie on tiles that "
                    "are not pinned, at least {:.0f} % have to",
                    100 * share, center.x, center.y, 100 * kOnTiles_01));

  const auto prepared = measure.prepare(piece.shape);
  if (!prepared) return tl::unexpected(prepared.error());
  const std::uint32_t seed = seed_of(layout, under, center);
  const EdgeMap edges = edges_of_block(layout, layout.tiles[seed].block);
  std::set<std::uint32_t> members{seed};
  struct Union {
    Destination destination;
    double overlap_01;  // intersection over union
  };
  std::vector<Union> unions;
  const double piece_area = area_m2(piece.shape.polygon);
  std::size_t common = 0;
  for (std::optional<std::uint32_t> next = seed; next;) {
    members.insert(*next);
    if (const auto found = under.find(*next); found != under.end()) common += found->second;
    const std::vector<std::uint32_t> candidate(members.begin(), members.end());
    double area = 0.0;
    for (const std::uint32_t i : candidate)
      area += area_m2(plat::tiles::shape_of(layout, layout.tiles[i]));
    if (const auto outline = outline_of(layout, candidate)) {
      const double both =
          piece_area * static_cast<double>(common) / static_cast<double>(points.size());
      if (const auto place = measure.prepare(shape_of(layout, *outline, edges)))
        unions.push_back(
            {{candidate, measure.compare(*prepared, *place)}, both / (area + piece_area - both)});
    }
    if (area > kMuchLarger * piece_area) break;
    next = next_of(layout, members, edges, under, piece_area / static_cast<double>(points.size()));
  }
  double most = 0.0;
  for (const Union& u : unions) most = std::max(most, u.overlap_01);
  std::optional<Destination> best;
  for (Union& u : unions) {
    if (u.overlap_01 < kOverlap_01 * most) continue;
    if (!best || u.destination.comparison.distance < best->comparison.distance)
      best = std::move(u.destination);
  }
  if (!best)
    return fail(FailureCode::kNoPlace,
                fmt::format("no tile at ({:.1f}, {:.1f}) has an outline that can be taken over",
                            center.x, center.y));
  return *std::move(best);
}

}  // namespace plat::tiles::detail

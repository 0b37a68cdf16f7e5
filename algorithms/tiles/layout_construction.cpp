#include "tiles/layout_construction.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/validity.h"
#include "tiles/joint_selection.h"
#include "tiles/layout_defects.h"
#include "tiles/settling.h"
#include "tiles/vertex_matching.h"

namespace plat::tiles {
namespace {

/// More than any parcel or block of a city has; a shape with more is a mistake.
constexpr std::size_t kVerticesMax = 20000;

/// What became of the pieces so far.
struct Pieces {
  std::span<const TilePiece> given;
  std::vector<Polygon> shapes;                   ///< admitted; empty where refused
  std::vector<std::optional<Failure>> failures;  ///< per piece

  [[nodiscard]] std::size_t size() const { return given.size(); }
};

std::optional<Failure> find_sliver(const Polygon& shape, double width_m) {
  // Of a long strip, twice the area over the perimeter is its width.
  const double mean_width_m = 2.0 * area_m2(shape) / perimeter_m(shape);
  if (mean_width_m > width_m) return std::nullopt;
  return Failure{FailureCode::kTooSmall, fmt::format("{:.2f} m wide: vertices match up to {:.2f} m",
                                                     mean_width_m, width_m)};
}

Pieces admitted(std::span<const TilePiece> given, double matching_m, Jobs jobs) {
  Pieces pieces{given, std::vector<Polygon>(given.size()),
                std::vector<std::optional<Failure>>(given.size())};
  parallel_for(given.size(), jobs, [&](std::size_t i) {
    auto shape = admit_polygon(given[i].shape, kVerticesMax);
    if (!shape) {
      pieces.failures[i] = shape.error();
    } else if (auto sliver = find_sliver(*shape, matching_m)) {
      pieces.failures[i] = std::move(sliver);
    } else {
      pieces.shapes[i] = std::move(*shape);
    }
  });
  return pieces;
}

/// A polygon's vertices in an order that does not depend on where its rings begin.
std::vector<Point> signature(const Polygon& polygon) {
  std::vector<Point> out;
  for_each_edge(polygon, [&](const Segment& s) { out.push_back(s.a); });
  std::ranges::sort(out);
  return out;
}

void refuse_repetitions(Pieces& pieces) {
  std::map<std::vector<Point>, std::size_t> seen;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces.failures[i]) continue;
    const auto [it, is_new] = seen.emplace(signature(pieces.shapes[i]), i);
    if (is_new) continue;
    pieces.failures[i] = Failure{FailureCode::kTilesOverlap,
                                 fmt::format("repeats {}", pieces.given[it->second].source_id)};
  }
}

/// The layout with its joints selected and its gaps closed.
TileLayout standing(TileLayout layout, const ConstructionOptions& options) {
  for (LayoutVertex& vertex : layout.vertices) vertex.is_joint = false;
  layout = settled(std::move(layout));  // joints are selected where vertices are
  return settled(with_joints_selected(std::move(layout), options.near_m, options.collinear_m));
}

/// The tiles of one block, ids their pieces' numbers; vertices stand nowhere yet.
TileLayout block_layout(const Pieces& pieces, std::span<const std::size_t> members,
                        double matching_m) {
  std::vector<Polygon> shapes;
  for (const std::size_t i : members) shapes.push_back(pieces.shapes[i]);
  MatchedRings matched = match_vertices(shapes, matching_m);
  TileLayout out;
  out.vertices.resize(matched.vertex_count);
  out.next_id = static_cast<std::uint32_t>(pieces.size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    const TilePiece& piece = pieces.given[members[k]];
    Tile tile;
    tile.id = {static_cast<std::uint32_t>(members[k])};
    tile.source_id = piece.source_id;
    tile.zone = piece.zone;
    tile.block = piece.block;
    tile.rings = std::move(matched.tiles[k]);
    out.tiles.push_back(std::move(tile));
  }
  return out;
}

/// The tile that has most defects, the smallest of several; with one of its defects.
std::pair<std::uint32_t, Failure> worst_of(const TileLayout& layout,
                                           const std::vector<TileDefect>& defects) {
  std::map<std::uint32_t, int> count;
  for (const TileDefect& defect : defects) {
    constexpr int kOwnDefect = 1000;  // a tile that is not simple goes before what it overlaps
    count[defect.tile] += defect.other ? 1 : kOwnDefect;
    if (defect.other) ++count[*defect.other];
  }
  const auto rank = [&](std::uint32_t t) {
    return std::tuple{-count[t], area_m2(rest_shape_of(layout.tiles[t])), t};
  };
  std::uint32_t worst = count.begin()->first;
  for (const auto& [tile, n] : count) {
    if (rank(tile) < rank(worst)) worst = tile;
  }
  for (const TileDefect& defect : defects) {
    if (defect.tile == worst || defect.other == worst) return {worst, defect.failure};
  }
  return {worst, defects.front().failure};
}

struct BlockResult {
  TileLayout layout;
  std::vector<std::pair<std::size_t, Failure>> refused;  ///< pieces
};

/// Lets tiles stand, and takes out tiles until none overlaps another. All that is wrong is taken
/// out before tiles stand anew: standing costs as much as the check.
BlockResult without_defects(TileLayout layout, const ConstructionOptions& options) {
  BlockResult out{standing(std::move(layout), options), {}};
  for (auto defects = find_tile_defects(out.layout); !defects.empty();
       defects = find_tile_defects(out.layout)) {
    std::set<TileId> refused;
    while (!defects.empty()) {
      const auto [tile, failure] = worst_of(out.layout, defects);
      refused.insert(out.layout.tiles[tile].id);
      out.refused.emplace_back(out.layout.tiles[tile].id.value, failure);
      std::erase_if(defects,
                    [&](const TileDefect& d) { return d.tile == tile || d.other == tile; });
    }
    std::erase_if(out.layout.tiles, [&](const Tile& tile) { return refused.contains(tile.id); });
    out.layout = standing(std::move(out.layout), options);
  }
  return out;
}

/// The tiles of one block. Where matching itself makes tiles overlap (a place narrower than the
/// tolerance), less of it may do: of the tolerances tried, the one that refuses fewest pieces.
BlockResult match_block(const Pieces& pieces, std::span<const std::size_t> members,
                        const ConstructionOptions& options) {
  BlockResult best = without_defects(block_layout(pieces, members, options.matching_m), options);
  for (const double share : {0.5, 0.25}) {
    if (best.refused.empty()) break;
    BlockResult finer =
        without_defects(block_layout(pieces, members, share * options.matching_m), options);
    if (finer.refused.size() < best.refused.size()) best = std::move(finer);
  }
  return best;
}

/// Pieces by block, blocks by their first piece.
std::vector<std::vector<std::size_t>> by_block(const Pieces& pieces) {
  std::map<std::uint32_t, std::size_t> place;
  std::vector<std::vector<std::size_t>> out;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces.failures[i]) continue;
    const auto [it, is_new] = place.emplace(pieces.given[i].block, out.size());
    if (is_new) out.emplace_back();
    out[it->second].push_back(i);
  }
  return out;
}

/// All blocks in one layout, tiles in the order of their pieces.
TileLayout joined(std::vector<BlockResult> blocks) {
  TileLayout out;
  for (BlockResult& block : blocks) {
    const auto offset = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.insert(out.vertices.end(), block.layout.vertices.begin(),
                        block.layout.vertices.end());
    for (Tile& tile : block.layout.tiles) {
      for (auto& ring : tile.rings) {
        for (Corner& corner : ring) corner.vertex += offset;
      }
      out.tiles.push_back(std::move(tile));
    }
  }
  std::ranges::sort(out.tiles, {}, &Tile::id);
  return out;
}

/// Tiles and vertices numbered without gaps.
TileLayout renumbered(TileLayout layout) {
  std::vector<bool> is_used(layout.vertices.size(), false);
  for (const Tile& tile : layout.tiles) {
    for (const auto& ring : tile.rings) {
      for (const Corner& corner : ring) is_used[corner.vertex] = true;
    }
  }
  std::vector<std::uint32_t> number(layout.vertices.size(), 0);
  std::vector<LayoutVertex> vertices;
  for (std::size_t v = 0; v < layout.vertices.size(); ++v) {
    number[v] = static_cast<std::uint32_t>(vertices.size());
    if (is_used[v]) vertices.push_back(layout.vertices[v]);
  }
  layout.vertices = std::move(vertices);
  layout.next_id = 0;
  for (Tile& tile : layout.tiles) {
    tile.id = {layout.next_id++};
    for (auto& ring : tile.rings) {
      for (Corner& corner : ring) corner.vertex = number[corner.vertex];
    }
  }
  return layout;
}

}  // namespace

LayoutConstruction construct_layout(std::span<const TilePiece> given,
                                    std::span<const StreetLine> streets,
                                    const ConstructionOptions& options, Jobs jobs) {
  Pieces pieces = admitted(given, options.matching_m, jobs);
  refuse_repetitions(pieces);
  const std::vector<std::vector<std::size_t>> members = by_block(pieces);
  auto blocks = parallel_map<BlockResult>(members.size(), jobs, [&](std::size_t b) {
    return match_block(pieces, members[b], options);
  });
  const auto take_refused = [&](const BlockResult& block) {
    for (const auto& [piece, failure] : block.refused) pieces.failures[piece] = failure;
  };
  for (const BlockResult& block : blocks) take_refused(block);

  TileLayout all = joined(std::move(blocks));
  all.next_id = static_cast<std::uint32_t>(given.size());
  BlockResult city = without_defects(std::move(all), options);
  take_refused(city);

  LayoutConstruction out;
  out.layout = renumbered(std::move(city.layout));
  out.layout.links = find_street_links(out.layout, streets, options.links);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (pieces.failures[i])
      out.failures.push_back({given[i].source_id, *pieces.failures[i], given[i].shape});
  }
  return out;
}

}  // namespace plat::tiles

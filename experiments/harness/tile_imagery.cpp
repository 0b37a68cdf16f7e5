#include "harness/tile_imagery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <string_view>
#include <utility>

#include "editing/street_following.h"
#include "tiles/reconfiguration.h"

namespace plat::harness {
namespace {

using tiles::Tile;
using tiles::TileLayout;

/// Points that tiles share were observed nearer to each other than this, metres: above what
/// matching vertices closes, below the distance of any two neighbours.
constexpr double kSamePlace_m = 2.0;
/// As many as `plat orthophoto` writes.
constexpr double kMostPixels = 4e9;
/// Asphalt, as light as the rendered orthophoto's, where the source shows nothing.
constexpr geodata::Colour kGround{122, 122, 120, 255};
constexpr geodata::Colour kBareEarth{150, 138, 118, 255};

/// Sets of tiles that were observed together.
class Groups {
 public:
  explicit Groups(const TileLayout& layout) : parent_(layout.tiles.size()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (const Tile& tile : layout.tiles) area_m2_.push_back(area_m2(tiles::rest_shape_of(tile)));
  }
  std::uint32_t root(std::uint32_t tile) {
    while (parent_[tile] != tile) tile = parent_[tile] = parent_[parent_[tile]];
    return tile;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    area_m2_[a] += area_m2_[b];
  }
  double area(std::uint32_t tile) { return area_m2_[root(tile)]; }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<double> area_m2_;
};

/// Calls visit(tile, rest, tile, rest) for every two tiles with a vertex in common.
template <class Visit>
void for_each_joint(const TileLayout& layout, Visit visit) {
  std::vector<std::vector<std::pair<std::uint32_t, Point>>> around(layout.vertices.size());
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    for (const auto& ring : layout.tiles[i].rings) {
      for (const tiles::Corner& corner : ring) around[corner.vertex].emplace_back(i, corner.rest);
    }
  }
  for (const auto& corners : around) {
    for (std::size_t k = 1; k < corners.size(); ++k) {
      for (std::size_t i = 0; i < k; ++i)
        visit(corners[i].first, corners[i].second, corners[k].first, corners[k].second);
    }
  }
}

/// Whether each tile was observed where one of a lower id was: the same land, there twice.
std::vector<bool> copies_of(const TileLayout& layout) {
  std::map<std::string_view, std::vector<std::uint32_t>> of_source;
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    if (const Tile& tile = layout.tiles[i]; !tile.source_id.empty())
      of_source[tile.source_id].push_back(i);
  }
  std::vector<bool> out(layout.tiles.size());
  for (const auto& [source, members] : of_source) {
    if (members.size() < 2) continue;
    for (const std::uint32_t i : members) {
      const Point inside = interior_point(tiles::rest_shape_of(layout.tiles[i]));
      out[i] = std::ranges::any_of(members, [&](std::uint32_t other) {
        return layout.tiles[other].id < layout.tiles[i].id &&
               locate(tiles::rest_shape_of(layout.tiles[other]), inside) == Side::kInside;
      });
    }
  }
  return out;
}

geodata::RasterGrid grid_of(const TileLayout& layout, const geodata::RasterGrid& source) {
  Box box;
  for (const Tile& tile : layout.tiles) box.add(box_of(tiles::shape_of(layout, tile)));
  box = box.expanded(kTileImageMargin_m);
  const double pixel_m = source.pixel_m;
  const double left = std::floor((box.min.x - source.left_m) / pixel_m);
  const double top = std::floor((source.top_m - box.max.y) / pixel_m);
  const double width = std::ceil((box.max.x - source.left_m) / pixel_m) - left;
  const double height = std::ceil((source.top_m - box.min.y) / pixel_m) - top;
  if (width * height > kMostPixels) {
    throw InputError(fmt::format("{:.0f} x {:.0f} pixels of {} m, at most {:.0f} million", width,
                                 height, pixel_m, kMostPixels / 1e6));
  }
  return {source.frame, source.left_m + left * pixel_m,  source.top_m - top * pixel_m,
          pixel_m,      static_cast<std::size_t>(width), static_cast<std::size_t>(height)};
}

}  // namespace

std::vector<bool> tiles_from_elsewhere(const TileLayout& layout) {
  Groups groups(layout);
  const auto is_same = [](Point a, Point b) { return distance(a, b) < kSamePlace_m; };
  for_each_joint(layout, [&](std::uint32_t a, Point rest_a, std::uint32_t b, Point rest_b) {
    if (is_same(rest_a, rest_b)) groups.join(a, b);
  });
  for (const tiles::StreetLink& link : layout.links) {
    if (is_same(link.rest_a, link.rest_b)) groups.join(link.a, link.b);
  }
  // Not by links: those of a closed cut join what was observed on two sides of the tile cut.
  std::vector<bool> has_come(layout.tiles.size());
  for_each_joint(layout, [&](std::uint32_t a, Point rest_a, std::uint32_t b, Point rest_b) {
    if (is_same(rest_a, rest_b) || groups.root(a) == groups.root(b)) return;
    has_come[groups.root(groups.area(a) < groups.area(b) ? a : b)] = true;
  });
  std::vector<bool> out = copies_of(layout);
  for (std::uint32_t i = 0; i < layout.tiles.size(); ++i) {
    if (has_come[groups.root(i)]) out[i] = true;
  }
  return out;
}

std::vector<imagery::CarriedPiece> carried_tiles(const TileLayout& layout) {
  std::vector<imagery::CarriedPiece> out;
  for (const Tile& tile : layout.tiles) {
    imagery::CarriedPiece piece{tiles::shape_of(layout, tile), kBareEarth};
    const auto to_rest = tile.placement.inverse();
    if (tile.zone != tiles::kVacantZone && to_rest) piece.shows = *to_rest;
    if (piece.shape.outer.size() >= 3) out.push_back(std::move(piece));
  }
  return out;
}

imagery::PointMap ground_at_rest(const TileLayout& layout) {
  const std::vector<bool> has_come = tiles_from_elsewhere(layout);
  TileLayout rest;
  for (std::size_t i = 0; i < layout.tiles.size(); ++i) {
    if (has_come[i] || layout.tiles[i].zone == tiles::kVacantZone) continue;
    rest.tiles.push_back(layout.tiles[i]);
    rest.tiles.back().placement = {};
  }
  const auto following = std::make_shared<const editing::StreetFollowing>(layout, rest);
  return [following](Point p) { return (*following)(p); };
}

geodata::RasterGrid write_tile_image(const std::string& path, const TileLayout& layout,
                                     const std::string& image, const geodata::LocalFrame& frame,
                                     Jobs jobs, Progress::Style progress) {
  const imagery::SharedImage source(image, {.frame = frame});
  Box rest;
  for (const Tile& tile : layout.tiles) rest.add(box_of(tiles::rest_shape_of(tile)));
  if (!rest.intersects(source.grid().box()))
    throw InputError(
        fmt::format("{}: shows none of the tiles; is it the image of this city?", image));
  const geodata::RasterGrid grid = grid_of(layout, source.grid());
  const std::vector<imagery::CarriedPiece> pieces = carried_tiles(layout);
  const imagery::CarriedInput input{
      pieces, &source,
      imagery::over_ground(imagery::carried_ground(source, ground_at_rest(layout), grid),
                           imagery::plain_ground(grid, kGround))};
  std::string description = "tiles carried by plat from an image of the city at rest";
  if (!source.description().empty()) description += "; " + source.description();
  imagery::write_carried_image(path, input, grid,
                               {.bands = geodata::RasterBands::kOpaque, .description = description},
                               jobs, progress);
  return grid;
}

}  // namespace plat::harness

#include "editing/tiled_city.h"

#include <fmt/format.h>

#include <bit>

#include "core/working_grid.h"
#include "editing/city_support.h"

namespace plat::testing {

using tiles::LayoutVertex;
using tiles::StreetLink;
using tiles::Tile;
using tiles::TileLayout;

namespace {

constexpr double kBlockX_m = 100.0;
constexpr double kBlockY_m = 80.0;
constexpr double kHalfStreet_m = 6.0;

class GridTiles {
 public:
  GridTiles(int columns, int rows) : columns_(columns - 1), rows_(rows - 1) {
    for (int by = 0; by < rows_; ++by) {
      for (int bx = 0; bx < columns_; ++bx) add_block(bx, by);
    }
    for (int by = 0; by < rows_; ++by) {
      for (int bx = 0; bx < columns_; ++bx) add_links(bx, by);
    }
    layout_.next_id = static_cast<std::uint32_t>(layout_.tiles.size());
  }
  TileLayout take() { return std::move(layout_); }

 private:
  static Point corner(int bx, int by, int column, int row) {
    return {kBlockX_m * bx + kHalfStreet_m + 0.5 * column * (kBlockX_m - 2.0 * kHalfStreet_m),
            kBlockY_m * by + kHalfStreet_m + 0.5 * row * (kBlockY_m - 2.0 * kHalfStreet_m)};
  }
  [[nodiscard]] std::uint32_t tile(int bx, int by, int column, int row) const {
    return static_cast<std::uint32_t>(4 * (by * columns_ + bx) + 2 * row + column);
  }

  void add_block(int bx, int by) {
    const auto first = static_cast<std::uint32_t>(layout_.vertices.size());
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        layout_.vertices.push_back({corner(bx, by, column, row), true});
    }
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) {
        Tile out;
        out.id = {tile(bx, by, column, row)};
        out.source_id = fmt::format("lot {}", out.id.value);
        out.zone = std::string(1, bx == 0 ? 'A' : 'B');
        out.block = static_cast<std::uint32_t>(by * columns_ + bx);
        auto& ring = out.rings.emplace_back();
        for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
          const int at = 3 * (row + dy) + column + dx;
          ring.push_back(
              {first + static_cast<std::uint32_t>(at), corner(bx, by, column + dx, row + dy)});
        }
        layout_.tiles.push_back(std::move(out));
      }
    }
  }

  void link(std::uint32_t a, std::uint32_t b, Point at) {
    layout_.links.push_back({a, at, b, at, 2.0 * kHalfStreet_m});
  }

  void add_links(int bx, int by) {
    for (int side = 0; side < 2; ++side) {
      for (int end = 0; end < 2; ++end) {
        if (bx + 1 < columns_) {
          link(tile(bx, by, 1, side), tile(bx + 1, by, 0, side),
               corner(bx + 1, by, 0, side + end) - Point{kHalfStreet_m, 0.0});
        }
        if (by + 1 < rows_) {
          link(tile(bx, by, side, 1), tile(bx, by + 1, side, 0),
               corner(bx, by + 1, side + end, 0) - Point{0.0, kHalfStreet_m});
        }
      }
    }
  }

  int columns_;
  int rows_;
  TileLayout layout_;
};

}  // namespace

TileLayout grid_tiles(int columns, int rows) { return GridTiles(columns, rows).take(); }

editing::City tiled_grid_city(int columns, int rows, const editing::CityOptions& options) {
  return editing::with_tiles(grid_city(columns, rows, options), grid_tiles(columns, rows));
}

std::string bytes_of(const TileLayout& layout) {
  std::string out;
  const auto add = [&](auto... values) {
    (fmt::format_to(std::back_inserter(out), "{:x} ", std::bit_cast<std::uint64_t>(values)), ...);
  };
  for (const Tile& tile : layout.tiles) {
    fmt::format_to(std::back_inserter(out), "\n{} {}|{}|{} {} ", tile.id.value, tile.source_id,
                   tile.zone, tile.block, tile.is_pinned);
    const Affine& at = tile.placement;
    add(at.xx, at.xy, at.yx, at.yy, at.shift.x, at.shift.y);
    for (const auto& ring : tile.rings) {
      for (const tiles::Corner& corner : ring) {
        fmt::format_to(std::back_inserter(out), "{}:", corner.vertex);
        add(corner.rest.x, corner.rest.y);
      }
      out += ';';
    }
  }
  for (const LayoutVertex& vertex : layout.vertices) {
    fmt::format_to(std::back_inserter(out), "\n{} ", vertex.is_joint);
    add(vertex.at.x, vertex.at.y);
  }
  for (const StreetLink& link : layout.links) {
    fmt::format_to(std::back_inserter(out), "\n{} {} ", link.a, link.b);
    add(link.rest_a.x, link.rest_a.y, link.rest_b.x, link.rest_b.y, link.width_m);
  }
  fmt::format_to(std::back_inserter(out), "\n{}", layout.next_id);
  return out;
}

TileLayout carried(TileLayout layout, const Affine& map) {
  for (Tile& tile : layout.tiles) tile.placement = map * tile.placement;
  for (LayoutVertex& vertex : layout.vertices) vertex.at = snap(map(vertex.at));
  return layout;
}

}  // namespace plat::testing

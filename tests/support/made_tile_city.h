#pragma once

#include <cstdint>
#include <vector>

#include "core/rng.h"
#include "tiles/tile_graph.h"

namespace plat::tiles {

/// A grid city as the constraint solver sees it: blocks of two rows of parcels, streets between.
struct MadeCity {
  int blocks_x = 3;
  int blocks_y = 3;
  int parcels_per_row = 5;
  double frontage_m = 15.0;
  double depth_m = 30.0;
  double street_m = 12.0;
  double jitter_m = 2.0;  ///< every corner and link is moved by up to this, each way
  std::uint64_t seed = 1;

  [[nodiscard]] int tiles() const { return blocks_x * blocks_y * 2 * parcels_per_row; }
};

namespace detail {

/// Builds the graph of a MadeCity: a parcel is known by its block, row (0 south, 1 north) and
/// place in the row.
class MadeCityBuilder {
 public:
  explicit MadeCityBuilder(const MadeCity& city) : city_(city), rng_(city.seed) {}

  TileGraph build() {
    for (int by = 0; by < city_.blocks_y; ++by) {
      for (int bx = 0; bx < city_.blocks_x; ++bx) add_block(bx, by);
    }
    for (int by = 0; by < city_.blocks_y; ++by) {
      for (int bx = 0; bx < city_.blocks_x; ++bx) {
        if (bx + 1 < city_.blocks_x) link_east(bx, by);
        if (by + 1 < city_.blocks_y) link_north(bx, by);
      }
    }
    return std::move(graph_);
  }

 private:
  [[nodiscard]] std::uint32_t tile(int bx, int by, int row, int place) const {
    const int block = by * city_.blocks_x + bx;
    return static_cast<std::uint32_t>((block * 2 + row) * city_.parcels_per_row + place);
  }
  [[nodiscard]] Point corner_of_block(int bx, int by) const {
    return {bx * (city_.parcels_per_row * city_.frontage_m + city_.street_m),
            by * (2 * city_.depth_m + city_.street_m)};
  }
  Point jittered(Point p) {
    return p + Point{rng_.uniform(-city_.jitter_m, city_.jitter_m),
                     rng_.uniform(-city_.jitter_m, city_.jitter_m)};
  }
  void join(std::uint32_t a, std::uint32_t b, Point at, JointKind kind) {
    graph_.joints.push_back({a, at, b, at, kind});
  }

  void add_block(int bx, int by) {
    const Point origin = corner_of_block(bx, by);
    const int n = city_.parcels_per_row;
    std::vector<Point> corner;  // three lines of n + 1
    for (int line = 0; line < 3; ++line) {
      for (int i = 0; i <= n; ++i)
        corner.push_back(jittered(origin + Point{i * city_.frontage_m, line * city_.depth_m}));
    }
    const auto at = [&](int line, int i) {
      return corner[static_cast<std::size_t>(line * (n + 1) + i)];
    };
    for (int row = 0; row < 2; ++row) {
      for (int i = 0; i < n; ++i) {
        const Point of[] = {at(row, i), at(row, i + 1), at(row + 1, i + 1), at(row + 1, i)};
        TileNode node{0.25 * (of[0] + of[1] + of[2] + of[3]), 0.0};
        for (const Point p : of) node.radius_m += squared_length(p - node.centroid) / 4.0;
        node.radius_m = std::sqrt(node.radius_m);
        graph_.tiles.push_back(node);
      }
    }
    for (int line = 0; line < 3; ++line) {
      for (int i = 0; i <= n; ++i) {
        std::vector<std::uint32_t> around;
        for (const int row : {line - 1, line}) {
          for (const int place : {i - 1, i}) {
            if (row >= 0 && row < 2 && place >= 0 && place < n)
              around.push_back(tile(bx, by, row, place));
          }
        }
        for (std::size_t a = 0; a < around.size(); ++a) {
          for (std::size_t b = a + 1; b < around.size(); ++b)
            join(around[a], around[b], at(line, i), JointKind::kProperty);
        }
      }
    }
  }

  void link_east(int bx, int by) {
    const Point south = corner_of_block(bx + 1, by) - Point{0.5 * city_.street_m, 0.0};
    for (int row = 0; row < 2; ++row) {
      for (int end = 0; end < 2; ++end)
        join(tile(bx, by, row, city_.parcels_per_row - 1), tile(bx + 1, by, row, 0),
             jittered(south + Point{0.0, (row + end) * city_.depth_m}), JointKind::kStreet);
    }
  }
  void link_north(int bx, int by) {
    const Point west = corner_of_block(bx, by + 1) - Point{0.0, 0.5 * city_.street_m};
    for (int i = 0; i < city_.parcels_per_row; ++i) {
      for (int end = 0; end < 2; ++end)
        join(tile(bx, by, 1, i), tile(bx, by + 1, 0, i),
             jittered(west + Point{(i + end) * city_.frontage_m, 0.0}), JointKind::kStreet);
    }
  }

  MadeCity city_;
  Rng rng_;
  TileGraph graph_;
};

}  // namespace detail

inline TileGraph graph_of(const MadeCity& city) { return detail::MadeCityBuilder(city).build(); }

}  // namespace plat::tiles

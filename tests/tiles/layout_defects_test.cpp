#include "tiles/layout_defects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/working_grid.h"
#include "support/property.h"
#include "tiles/settling.h"

namespace plat::tiles {
namespace {

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

/// Tiles that share nothing, each of a block of its own.
TileLayout apart(const std::vector<Polygon>& shapes) {
  TileLayout layout;
  for (const Polygon& shape : shapes) {
    Tile tile;
    tile.id = {layout.next_id};
    tile.block = layout.next_id++;
    const auto add = [&](const Ring& ring) {
      auto& corners = tile.rings.emplace_back();
      for (const Point p : ring) {
        corners.push_back({static_cast<std::uint32_t>(layout.vertices.size()), p});
        layout.vertices.push_back({p, false});
      }
    };
    add(shape.outer);
    for (const Ring& hole : shape.holes) add(hole);
    layout.tiles.push_back(std::move(tile));
  }
  return layout;
}

bool overlap(const Polygon& a, const Polygon& b) {
  return !find_tile_defects(apart({a, b})).empty();
}

TEST(LayoutDefects, TilesThatTouchDoNotOverlap) {
  const Polygon square = rectangle(0, 0, 10, 10);
  EXPECT_FALSE(overlap(square, rectangle(10, 0, 20, 10)));            // an edge
  EXPECT_FALSE(overlap(square, rectangle(10, 5, 20, 15)));            // part of an edge
  EXPECT_FALSE(overlap(square, rectangle(10, 10, 20, 20)));           // a corner
  EXPECT_FALSE(overlap(square, {{{10, 5}, {15, 0}, {15, 10}}, {}}));  // a corner on an edge
}

TEST(LayoutDefects, AnyCommonInsideIsAnOverlap) {
  const Polygon square = rectangle(0, 0, 10, 10);
  EXPECT_TRUE(overlap(square, rectangle(10 - kGridStep_m, 0, 20, 10)));
  EXPECT_TRUE(overlap(square, rectangle(2, 2, 4, 4)));      // inside
  EXPECT_TRUE(overlap(square, rectangle(-5, -5, 20, 20)));  // around
  EXPECT_TRUE(overlap(square, square));
  EXPECT_TRUE(overlap(square, rectangle(0, 0, 5, 10)));                  // along three sides
  EXPECT_TRUE(overlap(square, {{{0, 0}, {10, 10}, {0, 10}}, {}}));       // over the diagonal
  EXPECT_TRUE(overlap(rectangle(0, 4, 10, 6), rectangle(4, 0, 6, 10)));  // no corner inside
}

TEST(LayoutDefects, AHoleMayHoldAnotherTile) {
  Polygon around = rectangle(0, 0, 30, 30);
  around.holes.push_back({{10, 10}, {10, 20}, {20, 20}, {20, 10}});
  EXPECT_FALSE(overlap(around, rectangle(10, 10, 20, 20)));
  EXPECT_FALSE(overlap(around, rectangle(12, 12, 18, 18)));
  EXPECT_TRUE(overlap(around, rectangle(12, 12, 18, 20 + kGridStep_m)));
  EXPECT_TRUE(overlap(around, rectangle(5, 5, 25, 25)));
}

/// Whether the insides of two convex polygons meet, by separating lines: nothing of the code under
/// test.
bool convex_overlap(const Ring& a, const Ring& b) {
  const auto separates = [](const Ring& s, const Ring& t) {
    for (std::size_t i = 0; i < s.size(); ++i) {
      bool all_right = true;
      for (const Point p : t)
        all_right = all_right && orientation(s[i], s[(i + 1) % s.size()], p) <= 0.0;
      if (all_right) return true;
    }
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

TEST(LayoutDefects, AgreeWithSeparatingLinesOnRandomTriangles) {
  Rng rng = testing::property_rng("LayoutDefects.AgreeWithSeparatingLinesOnRandomTriangles");
  int overlapping = 0;
  int touching = 0;
  const int count = testing::iterations(4000);
  for (int k = 0; k < count; ++k) {
    const auto triangle = [&] {
      while (true) {  // whole metres: many touch
        Ring ring;
        for (int i = 0; i < 3; ++i)
          ring.push_back({static_cast<double>(rng.index(7)), static_cast<double>(rng.index(7))});
        if (signed_area_m2(ring) > 0.0) return ring;
      }
    };
    const Ring a = triangle();
    const Ring b = triangle();
    const bool expected = convex_overlap(a, b);
    EXPECT_EQ(overlap({a, {}}, {b, {}}), expected);
    overlapping += expected ? 1 : 0;
    touching += !expected && box_of(a).intersects(box_of(b)) ? 1 : 0;
  }
  EXPECT_GT(overlapping, count / 5);
  EXPECT_GT(touching, count / 20);
}

TEST(LayoutDefects, ATileTurnedInsideOutIsFound) {
  TileLayout layout = apart({rectangle(0, 0, 10, 10)});
  layout.tiles[0].placement = {.xx = -1.0};
  layout = settled(std::move(layout));
  const auto defect = find_layout_defect(layout);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->code, FailureCode::kTilesOverlap);
}

TEST(LayoutDefects, BrokenInvariantsAreFound) {
  const TileLayout good = apart({rectangle(0, 0, 10, 10), rectangle(20, 0, 30, 10)});
  ASSERT_EQ(find_layout_defect(good), std::nullopt);
  const auto code = [&](const auto& breaks) {
    TileLayout layout = good;
    breaks(layout);
    const auto defect = find_layout_defect(layout);
    return defect ? std::optional(defect->code) : std::nullopt;
  };
  EXPECT_EQ(code([](TileLayout& l) { l.tiles[1].id = {0}; }), FailureCode::kUnknownEntity);
  EXPECT_EQ(code([](TileLayout& l) { l.next_id = 1; }), FailureCode::kUnknownEntity);
  EXPECT_EQ(code([](TileLayout& l) { l.tiles[0].rings[0][0].vertex = 99; }),
            FailureCode::kUnknownEntity);
  EXPECT_EQ(code([](TileLayout& l) { l.tiles[1].rings[0][0].vertex = 0; }),
            FailureCode::kUnknownEntity);  // a vertex of two blocks
  EXPECT_EQ(code([](TileLayout& l) { l.links.push_back({0, {}, 2, {}, 10.0}); }),
            FailureCode::kUnknownEntity);
  EXPECT_EQ(code([](TileLayout& l) { l.tiles[0].rings.clear(); }), FailureCode::kEmptyGeometry);
  EXPECT_EQ(
      code([](TileLayout& l) { l.vertices[0].at.x = std::numeric_limits<double>::quiet_NaN(); }),
      FailureCode::kNotFinite);
}

}  // namespace
}  // namespace plat::tiles

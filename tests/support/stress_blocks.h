#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "blocks/block.h"
#include "core/rng.h"
#include "core/validity.h"
#include "support/synthetic_blocks.h"

namespace plat::testing {

/// Shapes that blocks come in, and those that break things.
enum class BlockFamily {
  kConvex,
  kStar,
  kCurved,
  kNearParallel,
  kSliver,
  kSpiked,
  kHoles,
  kComb,
  kStairs,
  kRound,
  kSmall,
};
inline constexpr std::array<std::string_view, 11> kFamilyNames{
    "convex", "star", "curved", "near_parallel", "sliver", "spiked",
    "holes",  "comb", "stairs", "round",         "small"};

inline constexpr int kMaxStressVertices = 400;

namespace detail {

inline Ring ellipse(Rng& rng, int n, double a, double b, double roughness) {
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.6 * rng.uniform_01()) / n;
    const double radius = 1.0 + roughness * rng.uniform(-1.0, 1.0);
    ring.push_back({a * radius * std::cos(angle), b * radius * std::sin(angle)});
  }
  return ring;
}

/// Two curves of n points each, `depth` apart, waves of both in or out of step.
inline Ring curved_strip(Rng& rng, int n, double length, double depth) {
  const double wave = rng.uniform(0.0, 0.4) * depth;
  const double turns = rng.uniform(0.5, 8.0);
  const double lag = rng.uniform(0.0, 1.0);
  Ring ring;
  for (int i = 0; i <= n; ++i) ring.push_back({length * i / n, wave * std::sin(turns * i / n)});
  for (int i = n; i >= 0; --i)
    ring.push_back({length * i / n, depth + wave * std::sin(turns * i / n + lag)});
  return ring;
}

/// A rectangle whose sides have vertices a hair off the straight line.
inline Ring near_parallel(Rng& rng, double length, double depth) {
  const auto hair = [&] { return std::exp(rng.uniform(-7.0, 0.5)) * (rng.index(2) == 0 ? 1 : -1); };
  const int n = 1 + static_cast<int>(rng.index(12));
  Ring ring;
  for (int i = 0; i <= n; ++i) ring.push_back({length * i / n, hair()});
  for (int i = n; i >= 0; --i) ring.push_back({length * i / n + hair(), depth + hair()});
  return ring;
}

inline Ring comb(Rng& rng, double length, double depth) {
  const int teeth = 1 + static_cast<int>(rng.index(12));
  const double step = length / (2 * teeth + 1);
  Ring ring{{0, 0}, {length, 0}};
  for (int i = 2 * teeth + 1; i > 0; --i) {
    const double y = i % 2 == 1 ? depth : depth * rng.uniform(0.15, 0.9);
    ring.push_back({step * i, y});
    ring.push_back({step * (i - 1) + rng.uniform(0.0, 0.4) * step * (i > 1 ? 1 : 0), y});
  }
  return ring;
}

inline Ring stairs(Rng& rng, double length, double depth) {
  const int n = 1 + static_cast<int>(rng.index(20));
  Ring ring{{0, 0}, {length, 0}};
  for (int i = n; i > 0; --i) {
    ring.push_back({length * i / n, depth * (n - i + 1) / n});
    ring.push_back({length * (i - 1) / n, depth * (n - i + 1) / n});
  }
  return ring;
}

inline Polygon raw_block(Rng& rng, BlockFamily family) {
  const double length = std::exp(rng.uniform(std::log(30.0), std::log(500.0)));
  const double depth = length * rng.uniform(0.15, 1.0);
  switch (family) {
    case BlockFamily::kConvex:
      return {convex_hull(ellipse(rng, 4 + static_cast<int>(rng.index(30)), length / 2, depth / 2,
                                  rng.uniform(0.0, 0.3))),
              {}};
    case BlockFamily::kStar:
      return {star_ring(rng, 5 + static_cast<int>(rng.index(60)), 0.3 * length, 0.6 * length, {}),
              {}};
    case BlockFamily::kCurved:
      return {curved_strip(rng, 3 + static_cast<int>(rng.index(196)), length, depth), {}};
    case BlockFamily::kNearParallel:
      return {near_parallel(rng, length, depth), {}};
    case BlockFamily::kSliver:
      return {curved_strip(rng, 1 + static_cast<int>(rng.index(20)), length,
                           std::exp(rng.uniform(std::log(0.3), std::log(8.0)))),
              {}};
    case BlockFamily::kSpiked: {
      Ring ring{{0, 0}, {length, 0}, {length, depth}, {0, depth}};
      const double at = rng.uniform(0.1, 0.9) * length;
      const double half = std::exp(rng.uniform(-5.0, 1.0));
      const double tip = rng.index(2) == 0 ? -rng.uniform(0.2, 2.0) * depth  // out of the block
                                           : rng.uniform(0.2, 0.98) * depth;
      ring.insert(ring.begin() + 1,
                  {{at - half, 0}, {at + rng.uniform(-20.0, 20.0), tip}, {at + half, 0}});
      return {ring, {}};
    }
    case BlockFamily::kHoles: {
      Polygon polygon{{{0, 0}, {length, 0}, {length, depth}, {0, depth}}, {}};
      const int holes = 1 + static_cast<int>(rng.index(4));
      for (int i = 0; i < holes; ++i) {
        const Point c{length * (i + rng.uniform(0.4, 0.6)) / holes, depth * rng.uniform(0.3, 0.7)};
        Ring hole = star_ring(rng, 3 + static_cast<int>(rng.index(12)), 0.03 * depth,
                              0.45 * std::min(depth, length / holes), c);
        std::reverse(hole.begin(), hole.end());
        polygon.holes.push_back(std::move(hole));
      }
      return polygon;
    }
    case BlockFamily::kComb:
      return {comb(rng, length, depth), {}};
    case BlockFamily::kStairs:
      return {stairs(rng, length, depth), {}};
    case BlockFamily::kRound:
      return {ellipse(rng, 20 + static_cast<int>(rng.index(380)), length / 2, depth / 2,
                      rng.index(2) == 0 ? 0.0 : 0.002),
              {}};
    case BlockFamily::kSmall:
      return {star_ring(rng, 3 + static_cast<int>(rng.index(10)), rng.uniform(0.2, 4.0),
                        rng.uniform(4.0, 9.0), {}),
              {}};
  }
  return {};
}

}  // namespace detail

/// Family of the block with this number: each in its turn.
inline BlockFamily family_of(std::uint32_t number) {
  return static_cast<BlockFamily>(number % kFamilyNames.size());
}

/// A strictly simple block of 3 to 400 vertices, turned and moved at random; all, some or none of
/// its edges face streets. A function of seed and number alone.
inline blocks::Block stress_block(std::uint64_t seed, std::uint32_t number) {
  Rng rng(derive_seed(seed, {number}));
  for (;;) {
    Polygon raw = detail::raw_block(rng, family_of(number));
    const double turn = rng.index(4) == 0 ? 0.0 : rng.uniform(0.0, 2.0 * std::numbers::pi);
    const Point shift{rng.uniform(-2000.0, 2000.0), rng.uniform(-2000.0, 2000.0)};
    const Point u{std::cos(turn), std::sin(turn)};
    const auto place = [&](Ring& ring) {
      for (Point& p : ring) p = shift + p.x * u + p.y * perpendicular(u);
    };
    place(raw.outer);
    for (Ring& hole : raw.holes) place(hole);
    auto admitted = admit_polygon(raw, kMaxStressVertices);
    if (!admitted) continue;
    blocks::Block block = blocks::block_from_contour(BlockId{number}, *std::move(admitted));
    const std::uint64_t labels = rng.index(4);
    for (auto& edge : block.edges[0]) {
      if (labels == 1 && rng.index(2) == 0) edge = {};
      if (labels == 2 && rng.index(50) == 0) edge = {};
      if (labels == 3 && rng.index(8) == 0) edge.logical_street = 100;
    }
    if (labels == 0 && rng.index(8) == 0) {
      for (auto& edge : block.edges[0]) edge = {};
    }
    return block;
  }
}

}  // namespace plat::testing

#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "core/affine.h"
#include "core/rng.h"
#include "core/validity.h"
#include "core/working_grid.h"
#include "similarity/labelled_shape.h"
#include "support/synthetic_blocks.h"

namespace plat::testing {

/// Shapes that tiles come in, and those that break measures: ties, thin parts, many vertices.
enum class ShapeFamily : std::uint8_t {
  kTriangle,
  kSquare,
  kRectangle,
  kLShape,
  kStar,
  kRegular,
  kCurved,
  kSliver,
  kSpiked,
  kHoled,
};
inline constexpr int kShapeFamilies = 10;

namespace detail {

inline Ring oval(Rng& rng, int n, double height) {
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.7 * rng.uniform_01()) / n;
    const double radius = 0.5 + 0.06 * std::sin(3.0 * angle);
    ring.push_back({radius * std::cos(angle), height * radius * std::sin(angle)});
  }
  return ring;
}

/// About one metre across.
inline Polygon unit_polygon(Rng& rng, ShapeFamily family) {
  const double w = rng.uniform(0.2, 0.9);
  const double at = rng.uniform(0.3, 0.6);
  switch (family) {
    case ShapeFamily::kTriangle:
      return {{{0, 0}, {1, 0}, {rng.uniform(-0.3, 1.3), w}}, {}};
    case ShapeFamily::kSquare:
      return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}};
    case ShapeFamily::kRectangle:
      return {{{0, 0}, {1, 0}, {1, w}, {0, w}}, {}};
    case ShapeFamily::kLShape:
      return {{{0, 0}, {1, 0}, {1, at * w}, {at, at * w}, {at, w}, {0, w}}, {}};
    case ShapeFamily::kStar:
      return {star_ring(rng, 5 + static_cast<int>(rng.index(20)), 0.2, 0.5, {}), {}};
    case ShapeFamily::kRegular: {
      const int n = 3 + static_cast<int>(rng.index(10));
      Ring ring;
      for (int i = 0; i < n; ++i)
        ring.push_back({0.5 * std::cos(2.0 * std::numbers::pi * i / n),
                        0.5 * std::sin(2.0 * std::numbers::pi * i / n)});
      return {ring, {}};
    }
    case ShapeFamily::kCurved:
      return {oval(rng, 300, w), {}};
    case ShapeFamily::kSliver:
      return {{{0, 0}, {1, 0.01}, {1.01, 0.03}, {at, 0.02}}, {}};
    case ShapeFamily::kSpiked:
      return {{{0, 0},
               {at, 0},
               {at + 0.01, rng.uniform(0.1, 0.9) * w},
               {at + 0.02, 0},
               {1, 0},
               {1, w},
               {0, w}},
              {}};
    case ShapeFamily::kHoled:
      return {{{0, 0}, {1, 0}, {1, w}, {0, w}},
              {{{0.2, 0.3 * w}, {0.25, 0.6 * w}, {0.4, 0.5 * w}},
               {{0.6, 0.3 * w}, {0.6, 0.7 * w}, {0.8, 0.6 * w}, {0.8, 0.3 * w}}}};
  }
  return {};
}

inline void label_edges(Rng& rng, similarity::LabelledShape& shape) {
  using similarity::EdgeLabel;
  const std::uint64_t how = rng.index(4);
  if (how == 0) return;
  for (std::size_t i = 0; i < shape.polygon.outer.size(); ++i) {
    const std::uint64_t label = how == 1 ? 1 : rng.index(how == 2 ? 3 : 2) + (how == 3 ? 1 : 0);
    shape.edges.push_back(static_cast<EdgeLabel>(label));
  }
  constexpr std::array<std::string_view, 3> kZones{"", "residential", "commercial"};
  shape.zone = kZones[rng.index(kZones.size())];
}

}  // namespace detail

/// A valid shape of this family on the working grid, 1 m to 5 km across, turned, near the origin or
/// a thousand kilometres away, with or without labels.
inline similarity::LabelledShape made_shape(Rng& rng, ShapeFamily family) {
  for (;;) {
    const double size_m = std::exp(rng.uniform(0.0, std::log(5000.0)));
    const double turn = rng.index(3) == 0 ? 0.0 : rng.uniform(0.0, 2.0 * std::numbers::pi);
    const double reach_m = rng.index(3) == 0 ? 1e6 : 500.0;
    const Affine grow{size_m, 0.0, 0.0, size_m, {}};
    const Affine place =
        Affine::translation({rng.uniform(-reach_m, reach_m), rng.uniform(-reach_m, reach_m)});
    auto admitted = admit_polygon(
        transformed(place * Affine::rotation(turn) * grow, detail::unit_polygon(rng, family)),
        1000);
    if (!admitted) continue;
    similarity::LabelledShape shape{*std::move(admitted), {}, ""};
    detail::label_edges(rng, shape);
    return shape;
  }
}

inline similarity::LabelledShape made_shape(Rng& rng) {
  return made_shape(rng, static_cast<ShapeFamily>(rng.index(kShapeFamilies)));
}

// ---- the same shape otherwise told ----

/// The same polygon, its rings begun elsewhere.
inline similarity::LabelledShape begun_elsewhere(Rng& rng, similarity::LabelledShape shape) {
  const auto by = static_cast<std::ptrdiff_t>(1 + rng.index(shape.polygon.outer.size() - 1));
  std::ranges::rotate(shape.polygon.outer, shape.polygon.outer.begin() + by);
  if (!shape.edges.empty()) std::ranges::rotate(shape.edges, shape.edges.begin() + by);
  for (Ring& hole : shape.polygon.holes)
    std::ranges::rotate(hole, hole.begin() + static_cast<std::ptrdiff_t>(rng.index(hole.size())));
  return shape;
}

/// The image of the shape; every edge keeps its label.
inline similarity::LabelledShape image_of(const Affine& map, similarity::LabelledShape shape) {
  shape.polygon = transformed(map, shape.polygon);
  if (map.determinant() < 0.0 && !shape.edges.empty()) {
    // Vertex i was vertex n-1-i, so that edge i was the edge that ended there.
    std::ranges::reverse(shape.edges);
    std::ranges::rotate(shape.edges, shape.edges.begin() + 1);
  }
  return shape;
}

/// The same region with another vertex on some edges.
inline similarity::LabelledShape with_more_vertices(Rng& rng,
                                                    const similarity::LabelledShape& shape) {
  similarity::LabelledShape out;
  out.zone = shape.zone;
  out.polygon.holes = shape.polygon.holes;
  const Ring& ring = shape.polygon.outer;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const bool is_split = i == 0 || rng.index(3) == 0;
    out.polygon.outer.push_back(ring[i]);
    if (is_split)
      out.polygon.outer.push_back(
          lerp(ring[i], ring[(i + 1) % ring.size()], rng.uniform(0.2, 0.8)));
    if (shape.edges.empty()) continue;
    out.edges.insert(out.edges.end(), is_split ? 2 : 1, shape.edges[i]);
  }
  return out;
}

/// Around the origin; vertex differences stay what they are, to the last bit.
inline similarity::LabelledShape centred(const similarity::LabelledShape& shape) {
  return image_of(Affine::translation(-snap(box_of(shape.polygon).center())), shape);
}

}  // namespace plat::testing

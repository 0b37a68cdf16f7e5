#include "tile_similarity/perturbation.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>
#include <vector>

#include "core/affine.h"
#include "core/validity.h"
#include "core/working_grid.h"

namespace plat::tile_similarity {
namespace {

using similarity::LabelledShape;

constexpr int kMostDraws = 20;

std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

void add_vertex(LabelledShape& shape, Rng& rng) {
  Ring& ring = shape.polygon.outer;
  double at = rng.uniform_01() * perimeter_m(ring);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    const double edge_m = distance(a, b);
    if (at < edge_m) {
      ring.insert(ring.begin() + offset(i + 1), a + (at / edge_m) * (b - a));
      if (!shape.edges.empty())
        shape.edges.insert(shape.edges.begin() + offset(i + 1), shape.edges[i]);
      return;
    }
    at -= edge_m;
  }
}

/// The edge that is left has the label of the longer one of the two that met.
void drop_vertex(LabelledShape& shape, Rng& rng) {
  Ring& ring = shape.polygon.outer;
  if (ring.size() <= 3) return;
  const std::size_t i = rng.index(ring.size());
  const std::size_t before = (i + ring.size() - 1) % ring.size();
  if (!shape.edges.empty()) {
    const bool is_longer =
        distance(ring[i], ring[(i + 1) % ring.size()]) > distance(ring[before], ring[i]);
    if (is_longer) shape.edges[before] = shape.edges[i];
    shape.edges.erase(shape.edges.begin() + offset(i));
  }
  ring.erase(ring.begin() + offset(i));
}

LabelledShape drawn(LabelledShape shape, const Perturbation& how, Rng& rng) {
  for (int i = 0; i < how.added; ++i) add_vertex(shape, rng);
  for (int i = 0; i < how.dropped; ++i) drop_vertex(shape, rng);
  if (how.noise_m > 0.0) {
    for (Point& p : shape.polygon.outer) {
      p.x += rng.normal(0.0, how.noise_m);
      p.y += rng.normal(0.0, how.noise_m);
    }
  }
  if (how.is_turned)
    shape.polygon = transformed(
        Affine::rotation(rng.uniform(0.0, 2.0 * std::numbers::pi), centroid(shape.polygon)),
        shape.polygon);
  return shape;
}

}  // namespace

std::span<const Perturbation> perturbations() {
  static constexpr std::array kAll{
      Perturbation{.name = "noise_0.25_m", .noise_m = 0.25},
      Perturbation{.name = "noise_1_m", .noise_m = 1.0},
      Perturbation{.name = "noise_2_m", .noise_m = 2.0},
      Perturbation{.name = "turned", .is_turned = true},
      Perturbation{.name = "three_added", .added = 3},
      Perturbation{.name = "one_dropped", .dropped = 1},
      Perturbation{.name = "all", .noise_m = 1.0, .is_turned = true, .added = 3, .dropped = 1}};
  return kAll;
}

std::optional<LabelledShape> perturbed(const LabelledShape& shape, const Perturbation& how,
                                       Rng& rng) {
  if (how.dropped > 0 && shape.polygon.outer.size() + static_cast<std::size_t>(how.added) <
                             static_cast<std::size_t>(how.dropped) + 3)
    return std::nullopt;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    LabelledShape out = drawn(shape, how, rng);
    for (Point& p : out.polygon.outer) p = snap(p);
    for (Ring& hole : out.polygon.holes) {
      for (Point& p : hole) p = snap(p);
    }
    if (area_m2(out.polygon) > 0.0 && !find_ogc_defect(out.polygon)) return out;
  }
  return std::nullopt;
}

}  // namespace plat::tile_similarity

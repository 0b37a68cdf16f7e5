#pragma once

#include <cmath>

#include "imagery/picture_style.h"
#include "imagery/plot.h"
#include "imagery/scene.h"

namespace plat::imagery {

/// Draws what lies between a plot's boundary and its buildings: front and back garden, drive,
/// paths, fences, sheds and pools on a small plot; parking, lawns or fields on a large one; and its
/// trees. Each plot draws from its own stream, so neighbours can be told apart.
void add_plot_ground(Scene& scene, const Plot& plot, const PictureStyle& style, Rng& rng);

/// Trees and shrubs at random places of a region, about one per `spacing_m` squared, none where
/// `is_taken(place, radius)`.
template <class IsTaken>
void scatter_trees(Scene& scene, const Polygon& shape, double spacing_m, double largest_m,
                   const PictureStyle& style, Rng& rng, IsTaken is_taken) {
  const Box box = plat::box_of(shape);
  const double count = box.width() * box.height() / (spacing_m * spacing_m);
  for (double i = rng.uniform_01(); i < count; i += 1.0) {
    Tree tree;
    tree.place = {rng.uniform(box.min.x, box.max.x), rng.uniform(box.min.y, box.max.y)};
    // Many small ones, few large.
    const double size = rng.uniform_01();
    tree.radius_m = 0.8 + (largest_m - 0.8) * size * std::sqrt(size);
    tree.height_m = 1.4 * tree.radius_m + rng.uniform(0.8, 2.6);
    tree.tint = crown_tint(rng, style.climate);
    tree.variation = static_cast<std::uint32_t>(rng.index(1000000));
    if (locate(shape, tree.place) == Side::kInside && !is_taken(tree.place, tree.radius_m))
      scene.add(tree);
  }
}

}  // namespace plat::imagery

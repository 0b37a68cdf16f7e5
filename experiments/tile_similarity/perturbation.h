#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/rng.h"
#include "similarity/labelled_shape.h"

namespace plat::tile_similarity {

/// A way to change a shape a little.
struct Perturbation {
  std::string_view name;
  double noise_m = 0.0;    ///< standard deviation of each vertex, both coordinates
  bool is_turned = false;  ///< about its middle, by any angle
  int added = 0;           ///< vertices on its edges, each anywhere on an edge drawn by length
  int dropped = 0;         ///< vertices, drawn alike
};

/// noise of 0.25, 1 and 2 m; turned; three vertices added; one dropped; all of it at once.
std::span<const Perturbation> perturbations();

/// The changed shape on the working grid; none where twenty draws gave no valid one (a triangle
/// that is to lose a vertex, an edge shorter than the noise).
std::optional<similarity::LabelledShape> perturbed(const similarity::LabelledShape& shape,
                                                   const Perturbation& how, Rng& rng);

}  // namespace plat::tile_similarity

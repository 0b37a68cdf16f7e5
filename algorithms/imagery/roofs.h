#pragma once

#include "core/rng.h"
#include "imagery/map_layers.h"
#include "imagery/picture_style.h"
#include "imagery/scene.h"
#include "imagery/shadows.h"

namespace plat::imagery {

/// Draws one building's roof: pitched, its facets by the straight skeleton and lit by their
/// direction, or flat with a parapet and what stands on it. Small buildings are more often pitched.
void add_roof(Scene& scene, const Footprint& footprint, const PictureStyle& style, const Sun& sun,
              Rng& rng);

/// The light on a slope that falls off towards `downhill` (unit vector), where flat ground has 1.
double slope_light(Point downhill, const Sun& sun);

}  // namespace plat::imagery

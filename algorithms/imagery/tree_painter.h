#pragma once

#include "imagery/canvas.h"
#include "imagery/ground_texture.h"
#include "imagery/shadows.h"

namespace plat::imagery {

/// Draws the crowns of the scene's trees: ragged domes of leaves, light towards the sun, whose
/// height casts a shadow.
void paint_trees(Canvas& canvas, const Scene& scene, const PictureNoise& noise, const Sun& sun);

}  // namespace plat::imagery

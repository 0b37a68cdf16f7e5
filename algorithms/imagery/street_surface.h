#pragma once

#include <cstdint>

#include "imagery/map_layers.h"
#include "imagery/picture_style.h"
#include "imagery/scene.h"

namespace plat::imagery {

/// The width between the kerbs of a street that is `width_m` wide from plot to plot.
double carriageway_m(double width_m);

/// The pavements of all streets: what lies between the plots, drawn before them.
void add_pavements(Scene& scene, const MapLayers& layers);

/// Where the map has no streets: asphalt around the plots, so that the gaps between them are
/// streets.
void add_gaps(Scene& scene, const MapLayers& layers);

/// Kerbs, asphalt, lane lines, crossings and cars, drawn after the plots.
void add_carriageways(Scene& scene, const MapLayers& layers, std::uint64_t seed);

/// Trees along the kerbs of streets that have room for them.
void add_street_trees(Scene& scene, const MapLayers& layers, const PictureStyle& style,
                      std::uint64_t seed);

/// A car, at rest or not.
void add_car(Scene& scene, Point center, Point along, Rng& rng);

}  // namespace plat::imagery

#pragma once

#include <cstdint>

#include "imagery/map_layers.h"
#include "imagery/picture_style.h"
#include "imagery/scene.h"
#include "imagery/shadows.h"

namespace plat::imagery {

/// What is done where the map has no footprints at all.
enum class MissingFootprints {
  kAssume,  ///< a house is assumed on every parcel that has room (assume_houses())
  kLeave,   ///< parcels stay empty
};

struct SceneOptions {
  PictureStyle style{};
  MissingFootprints missing = MissingFootprints::kAssume;
  Sun sun{};
  std::uint64_t seed = 0;
};

struct MapScene {
  Scene scene;
  std::size_t assumed_footprints = 0;
  std::size_t assumed_heights = 0;  ///< of footprints that the map has
};

/// Everything that the picture shows, from the ground up: open land, parks, pavements, plots,
/// water, streets, buildings from the lowest to the highest, trees.
MapScene make_scene(const MapLayers& layers, const SceneOptions& options);

}  // namespace plat::imagery

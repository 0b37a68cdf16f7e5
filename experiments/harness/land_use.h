#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/polygon.h"
#include "geodata/dataset_catalogue.h"

namespace plat::harness {

/// The zones of [ABVA08, Sec. 5].
inline constexpr std::string_view kZones[] = {"residential", "commercial", "industrial", "park",
                                              "other"};

/// The zone of each shape, from the land-use layer of a data set: that of the use that lies at a
/// point well inside the shape; else that of the largest mapped use that lies in it (a building);
/// else empty: unknown. What each data set's values mean is said in docs/tiles.md.
/// @throws InputError where a mapped layer cannot be read
std::vector<std::string> zones_of(const geodata::Dataset& dataset, std::span<const Polygon> shapes,
                                  const geodata::LocalFrame& frame,
                                  const std::filesystem::path& folder = geodata::data_dir());

}  // namespace plat::harness

#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/box.h"
#include "core/parallel.h"
#include "tile_displacement/displacement_config.h"

namespace plat::displacement {

/// Tiles by where their middles are, in the CRS that the data set is read in.
struct Region {
  Point center_m;
  double from_m = 0.0;         ///< no nearer to the centre than this
  std::optional<double> to_m;  ///< no farther
  std::optional<Box> box;      ///< instead of a distance
  [[nodiscard]] bool holds(Point middle) const;
};

/// A piece of the layout that is carried somewhere.
struct Piece {
  Region where;
  Point shift_m;
  double turn_rad = 0.0;  ///< about the region's centre, counter-clockwise
  /// Only so many tiles, those nearest to the centre, are held there, the others of the piece are
  /// free; none: all are held.
  std::optional<std::size_t> held_tiles;
};

/// One displacement of several pieces, made in several ways: what a figure shows.
struct Scene {
  CityChoice city;
  std::vector<Piece> pieces;
  std::vector<Region> held;       ///< that stay
  std::optional<double> reach_m;  ///< what is farther from all held pieces stays; none: is free
  std::vector<Way> ways;
};

/// @throws InputError that names file, key, value and what is allowed
Scene parse_scene(const nlohmann::json& object, const std::string& source);

/// Writes `tiles.gpkg`, with the layer `observed` and, for each way, layers NAME (tiles as their
/// maps place them) and NAME_closed (gaps closed), and `measures.json`, errors by way.
/// @returns whether every way has a solution
bool show_scene(const Scene& scene, const std::filesystem::path& out, Jobs jobs);

}  // namespace plat::displacement

#pragma once

#include <string>
#include <vector>

#include "core/parallel.h"
#include "core/polygon.h"
#include "geodata/layer.h"
#include "harness/synthesis_script.h"
#include "streets/street_network.h"
#include "synthesis/point_set.h"

namespace plat::harness {

/// What the places of a script mean in one frame.
struct ScriptFrame {
  std::string source;  ///< of the script, for messages
  geodata::LocalFrame frame;
  Point anchor;  ///< that offsets are counted from, in the frame, on the working grid
};

/// In the frame.
Point place_in(const ScriptFrame& frame, const ScriptPlace& place);

/// The polygons of a region, in the frame; those of a layer are reprojected.
/// @throws InputError for a layer that cannot be read
std::vector<Polygon> polygons_in(const ScriptFrame& frame, const ScriptRegion& region);

/// The one polygon of a region, on the working grid.
/// @throws InputError where it is none, or several, or not simple
Polygon polygon_in(const ScriptFrame& frame, const ScriptRegion& region);

/// An example as it was read, in a frame of its own.
struct ReadExample {
  geodata::LocalFrame frame;
  synthesis::PointSet points;
};

/// The points of an example: taken from all the streets of its source, then those in its region.
/// @throws InputError with the path of the source for what cannot be read, or holds no point
ReadExample read_example(const ScriptSource& source, const std::string& script, Jobs jobs);

/// The streets of a city that stay.
struct ReadCity {
  geodata::LocalFrame frame;
  streets::StreetNetwork network;  ///< every street has a width
  std::vector<Polygon> parcels;
};

/// The streets of a source that lie in its region with all their points.
/// @throws InputError as read_example
ReadCity read_city_streets(const ScriptSource& source, const std::string& script, Jobs jobs);

}  // namespace plat::harness

#pragma once

#include <utility>
#include <vector>

#include "editing/city.h"

namespace plat::editing {

/// A city taken apart: what has to be kept in a file to have the same city again.
struct CityParts {
  CityOptions options;
  IdCounters counters;  ///< `walk` is not needed
  std::vector<std::pair<NodeId, Point>> nodes;
  std::vector<std::pair<StreetId, CityStreet>> streets;  ///< lines are not needed
  std::vector<CityBlock> blocks;                         ///< edges are not needed
  std::shared_ptr<const tiles::TileLayout> tiles;
};

CityParts parts_of(const City& city);

/// The city with these parts, ids included; nothing is divided again.
///
/// Guarantees: restore_city(parts_of(city)) is the same city but for the ids of walks.
/// @returns Failure of Editor::apply() where the streets do not make a network, kNotCovered where
///          a face has a block that is not among the parts, or the other way round
Expected<City> restore_city(const CityParts& parts);

}  // namespace plat::editing

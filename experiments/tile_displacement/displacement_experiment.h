#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/parallel.h"
#include "tile_displacement/displacement_config.h"

namespace plat::displacement {

/// A group moved by one displacement, the rest found in one way.
struct DisplacementRow {
  std::size_t city = 0;
  int group = 0;
  double displacement_m = 0.0;
  std::string way;
  std::string similarity;     ///< empty without replacement
  std::string status = "ok";  ///< or the name of a failure
  std::size_t moved_tiles = 0;
  Errors errors;
  double objective = 0.0;
  std::size_t replacements = 0;
  std::size_t replacements_refused = 0;
  std::size_t rounds = 0;
};

/// What a city's layout was.
struct CityRow {
  std::size_t city = 0;
  std::size_t tiles = 0;
  std::size_t blocks = 0;
  std::size_t joints = 0;
  std::size_t links = 0;
  std::size_t failures = 0;  ///< pieces that did not become tiles
};

struct DisplacementResult {
  std::vector<CityRow> cities;
  std::vector<DisplacementRow> rows;  ///< by city, group, displacement, way
};

/// One number of a row, as tables and curves name it.
struct Measure {
  std::string_view name;
  std::string_view unit;
  double (*of)(const DisplacementRow&);
};
const std::vector<Measure>& measures();

/// Every city, group, displacement and way. Independent of the number of threads.
/// @throws InputError for a data set that cannot be read
DisplacementResult run_displacements(const DisplacementConfig& config, Jobs jobs);

}  // namespace plat::displacement

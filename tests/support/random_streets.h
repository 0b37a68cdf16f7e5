#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/rng.h"
#include "streets/raw_street.h"

namespace plat::testing {

/// Streets that cross, meet, bend and end anywhere in a square; some have names, some are bridges.
inline std::vector<streets::RawStreet> random_streets(Rng& rng, std::size_t count, double side_m) {
  std::vector<streets::RawStreet> out;
  for (std::size_t i = 0; i < count; ++i) {
    streets::RawStreet street;
    street.source_id = std::to_string(i);
    street.attributes.street_class = "residential";
    if (rng.index(3) == 0) street.attributes.name = std::string(1, "ABC"[rng.index(3)]);
    if (rng.index(12) == 0) {
      street.attributes.level = 1;
      street.attributes.structure = streets::Structure::kBridge;
    }
    Point at{rng.uniform(0.0, side_m), rng.uniform(0.0, side_m)};
    double heading = rng.uniform(0.0, 6.3);
    street.line.push_back(at);
    for (std::uint64_t left = 1 + rng.index(6); left > 0; --left) {
      heading += rng.normal(0.0, 0.4);
      at = at + rng.uniform(0.05, 0.3) * side_m * Point{std::cos(heading), std::sin(heading)};
      street.line.push_back(at);
    }
    if (rng.index(8) == 0) street.line.push_back(street.line.front());  // a loop
    out.push_back(std::move(street));
  }
  return out;
}

}  // namespace plat::testing

#pragma once

#include <string>

#include "streets/street_network.h"

namespace plat::streets {

/// A street as it was observed: neither snapped nor noded.
struct RawStreet {
  std::string source_id;
  Polyline line;
  StreetAttributes attributes;
};

}  // namespace plat::streets

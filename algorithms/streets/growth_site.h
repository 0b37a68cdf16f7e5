#pragma once

#include <optional>

#include "core/failure.h"
#include "streets/street_grower.h"

namespace plat::streets {

/// Why nothing can be grown on a site, or nullopt: a coordinate that is not finite, an attribute
/// that is not or is negative, a street or an open end at no node, a street whose line does not
/// join its nodes. The boundary is not looked at.
std::optional<Failure> find_defect(const GrowthSite& site);

}  // namespace plat::streets

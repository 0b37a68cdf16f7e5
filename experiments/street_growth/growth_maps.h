#pragma once

#include <vector>

#include "geodata/layer.h"
#include "street_growth/growth_cell.h"

namespace plat::growth {

/// The edges of a city regrown by the variant's first seed, straight from end to end: a layer named
/// by the variant with fields `kind` (recovered, missing, false), `level` and `length_m`.
/// @returns a layer without features where the growth failed
geodata::Layer edge_map(const KnownCity& city, const Variant& variant, const GrowthConfig& config);

}  // namespace plat::growth

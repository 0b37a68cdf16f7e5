#pragma once

#include <nlohmann/json_fwd.hpp>

#include "geodata/layer.h"
#include "streets/network_measures.h"

namespace plat::harness {

/// A network's measures with what they were taken from, as JSON: `scalars` by name (null where a
/// network has none), `samples` by name, `nodes` (x, y, degree, betweenness), `edges` (from, to,
/// length_m), `faces`, and the `sources` and `routes` that were drawn (from, to, network_m,
/// straight_m). Nodes are numbered from 0; x and y are coordinates in the frame's CRS.
nlohmann::json network_report(const streets::NetworkMeasures& measures,
                              const geodata::LocalFrame& frame);

}  // namespace plat::harness

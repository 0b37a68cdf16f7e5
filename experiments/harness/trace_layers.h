#pragma once

#include <span>
#include <vector>

#include "blocks/block.h"
#include "geodata/layer.h"
#include "parcels/subdivision_trace.h"

namespace plat::harness {

/// The inner steps of every block as layers, one per kind of step, all of them also where a
/// strategy has no such step: block_id, number (what it numbers: parcels/subdivision_trace.h) and
/// order.
/// @param traces  one per block
std::vector<geodata::Layer> trace_layers(std::span<const blocks::Block> blocks,
                                         std::span<const parcels::SubdivisionTrace> traces,
                                         const geodata::LocalFrame& frame);

}  // namespace plat::harness

#pragma once

#include <span>
#include <vector>

#include "blocks/block.h"
#include "core/parallel.h"
#include "streets/street_network.h"

namespace plat::blocks {

struct LabelOptions {
  double max_street_distance_m = 35.0;  ///< from an edge to the centreline that it may front
  double max_turn_rad = 0.6;            ///< between an edge and the street that runs along it
  double min_gap_m = 2.0;               ///< a narrower gap is a joint between plots
  double max_gap_m = 60.0;              ///< beyond it lies open land
  double corner_edge_m = 5.0;           ///< a shorter edge faces what its longer neighbour faces
  double assumed_width_m = 12.0;        ///< around a block that would face no street at all
};

/// Labels the edges of blocks that came from land (parcels), not from the network: each faces
/// 1. the nearest street that runs roughly along it outside, seen from the edge without another
///    block in between (a short edge: the nearest in sight, whatever its direction);
/// 2. else a street as wide as the gap between the edge and the land opposite, kGap, where that is
///    min_gap_m to max_gap_m; the sides of a hole only where another block lies in it;
/// 3. else nothing: joints between plots, and the outer rim of the city without a centreline at
///    hand, are open land.
/// A block that would face no street at all is taken to face one all around, kAssumed: its plots
/// are reached somehow. `network` may be empty; its tunnels are not fronted.
void label_edges(std::span<Block> blocks, const streets::StreetNetwork& network,
                 const LabelOptions& options = {}, Jobs jobs = {});

/// Numbers the logical streets of a block whose edges have their streets and widths
/// [VKW12, Sec. 4.2.1]: consecutive edges of one street name share a number; without names, those
/// of one class that turn by less than `same_street_turn_rad`.
void number_logical_streets(Block& block, const streets::StreetNetwork& network,
                            double same_street_turn_rad = 0.5);

}  // namespace plat::blocks

#pragma once

#include <cstddef>
#include <vector>

#include "geodata/layer.h"
#include "harness/tile_shapes.h"
#include "similarity/similarity_matrix.h"
#include "similarity/weighted_k_means.h"

namespace plat::harness {

/// Clusters and the most similar tiles, to look at in a GIS:
///   tiles     a polygon per tile: source_id, zone, block, cluster, cluster_size,
///   is_representative,
///             nearest_1, distance_1, ... (source ids; empty where the cluster has no more);
///   nearest   a line from the middle of each tile to each of its nearest, with rank and distance;
///   failures  features that are no tile, and tiles that the measure cannot prepare.
std::vector<geodata::Layer> similarity_layers(const ReadTileShapes& tiles,
                                              const similarity::Clusters& clusters,
                                              const similarity::SimilarityMatrix& matrix,
                                              std::size_t nearest);

}  // namespace plat::harness

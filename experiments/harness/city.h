#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "blocks/block.h"
#include "blocks/blocks_from_parcels.h"
#include "core/parallel.h"
#include "geodata/dataset_catalogue.h"
#include "streets/repair.h"
#include "streets/street_network.h"

namespace plat::harness {

/// A block with the plots that were observed (or tessellated) in it.
struct ObservedBlock {
  blocks::Block block;
  std::vector<Polygon> parcels;         ///< in the city's frame, on the working grid; at least one
  std::vector<std::string> parcel_ids;  ///< of the cadastre, or of the footprints
};

/// An observed place, ready for experiments: one frame for all geometry.
struct City {
  std::string dataset;
  geodata::LocalFrame frame;
  geodata::PlotOrigin plots = geodata::PlotOrigin::kObserved;
  streets::StreetNetwork network;  ///< what the blocks' street ids point into; may be empty
  std::vector<ObservedBlock> blocks;
  std::vector<streets::Repair> repairs;
  std::vector<blocks::BlockFailure> failures;  ///< refused parcels and blocks
};

/// @throws InputError where the files are not in `folder`, or the data set has no plots
void expect_present(const geodata::Dataset& dataset,
                    const std::filesystem::path& folder = geodata::data_dir());

/// Reads a data set of the catalogue by its `observed` mapping: where parcels are observed, blocks
/// are their unions, labelled from the centrelines or from the gaps between blocks; where plots are
/// to be tessellated, blocks are faces of the street network, and plots are cells around the
/// footprints in each. Blocks keep the order of their first parcel; ids are 0 .. n-1.
/// @throws InputError as expect_present, and for files that cannot be read
City load_city(const geodata::Dataset& dataset, Jobs jobs = {},
               const std::filesystem::path& folder = geodata::data_dir());

}  // namespace plat::harness

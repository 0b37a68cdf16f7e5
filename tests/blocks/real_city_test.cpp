#include <gtest/gtest.h>

#include <set>

#include "blocks/block_extraction.h"
#include "blocks/blocks_from_parcels.h"
#include "blocks/edge_labels.h"
#include "core/validity.h"
#include "geodata/layer_io.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"
#include "streets/street_width.h"
#include "support/data_folder.h"

namespace plat::blocks {
namespace {

std::vector<ObservedParcel> read_parcels(const std::string& file, const geodata::Layer& layer) {
  std::vector<ObservedParcel> out;
  for (const geodata::Feature& feature : layer.features) {
    for (const Polygon& part : feature.polygons) out.push_back({feature.id, part});
  }
  EXPECT_FALSE(out.empty()) << file;
  return out;
}

/// Blocks from parcels against the file's own `blocks` layer: counts and total area.
void expect_the_blocks_of(const std::string& file, std::size_t count_slack) {
  const geodata::Layer parcels = geodata::read_layer({file, "parcels"});
  const geodata::Layer given = geodata::read_layer({file, "blocks"}, {.frame = parcels.frame});
  const BlocksFromParcels found = blocks_from_parcels(read_parcels(file, parcels));
  double given_m2 = 0.0;
  for (const geodata::Feature& feature : given.features) {
    for (const Polygon& part : feature.polygons) given_m2 += area_m2(part);
  }
  double found_m2 = 0.0;
  for (const Block& block : found.blocks) {
    found_m2 += area_m2(block.contour);
    EXPECT_FALSE(find_defect(block.contour));
  }
  EXPECT_NEAR(static_cast<double>(found.blocks.size()), static_cast<double>(given.features.size()),
              static_cast<double>(count_slack));
  EXPECT_NEAR(found_m2, given_m2, 2e-3 * given_m2);
}

TEST(RealCity, CambridgeBlocksAreThoseOfItsBlocksLayer) {
  PLAT_REAL_DATA_OR_SKIP(file, "cambridge_ma/cambridge_ma.gpkg");
  expect_the_blocks_of(file, 1);
}

TEST(RealCity, SanRomanBlocksAreThoseOfItsBlocksLayer) {
  PLAT_REAL_DATA_OR_SKIP(file, "san_roman_es/san_roman_es.gpkg");
  expect_the_blocks_of(file, 2);
}

TEST(RealCity, PragueBlocksAreThoseOfItsBlocksLayer) {
  PLAT_REAL_DATA_OR_SKIP(file, "prague_bubenec_cz/prague_bubenec_cz.gpkg");
  expect_the_blocks_of(file, 1);
}

TEST(RealCity, MontevideoNetworkGivesItsBlocks) {
  PLAT_REAL_DATA_OR_SKIP(file, "montevideo_uy/montevideo_osm.gpkg");
  const geodata::Layer layer = geodata::read_layer({file, "roads"});
  streets::CleanNetwork clean = streets::build_network(streets::import_streets(layer).streets);
  EXPECT_GT(clean.repairs.size(), 500U);  // ways cut at tile borders
  streets::assign_widths(clean.network, {});
  const BlocksOfNetwork found = extract_blocks(clean.network);
  EXPECT_GT(found.blocks.size(), 9000U);
  for (const BlockFailure& row : found.failures)
    EXPECT_EQ(row.failure.code, FailureCode::kTooSmall) << row.failure.message;
  for (const Block& block : found.blocks) {
    ASSERT_FALSE(find_defect(block.contour));
    ASSERT_TRUE(block.edges[0][0].is_street());
  }
}

TEST(RealCity, CambridgeEdgesFaceStreetsOfPlausibleWidth) {
  PLAT_REAL_DATA_OR_SKIP(file, "cambridge_ma/cambridge_ma.gpkg");
  const geodata::Layer parcels = geodata::read_layer({file, "parcels"});
  const geodata::Layer lines = geodata::read_layer({file, "streets"}, {.frame = parcels.frame});
  streets::StreetNetwork network =
      streets::build_network(streets::import_streets(lines).streets).network;
  BlocksFromParcels found = blocks_from_parcels(read_parcels(file, parcels));
  std::vector<Polygon> land;
  for (const Block& block : found.blocks) land.push_back(block.contour);
  streets::assign_widths(network, land);
  label_edges(found.blocks, network);
  double total_m = 0.0;
  double named_m = 0.0;
  double plausible_m = 0.0;
  for (const Block& block : found.blocks) {
    const Ring& ring = block.contour.outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const BlockEdge& edge = block.edges[0][i];
      const double length = distance(ring[i], ring[(i + 1) % ring.size()]);
      total_m += length;
      if (edge.street) named_m += length;
      if (edge.street_width_m > 5.0 && edge.street_width_m < 40.0) plausible_m += length;
    }
  }
  EXPECT_GT(named_m, 0.8 * total_m);
  EXPECT_GT(plausible_m, 0.8 * total_m);
}

}  // namespace
}  // namespace plat::blocks

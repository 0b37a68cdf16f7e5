#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "geodata/layer_io.h"
#include "streets/exemplar.h"
#include "streets/network_cleaning.h"
#include "streets/street_classes.h"
#include "streets/street_import.h"
#include "streets/street_width.h"
#include "support/data_folder.h"

namespace plat::streets {
namespace {

struct City {
  std::string_view name;
  std::string_view source;
  std::size_t min_points;
  std::size_t max_points;
};

void PrintTo(const City& city, std::ostream* out) { *out << city.name; }

class ExemplarOfCity : public ::testing::TestWithParam<City> {};

StreetNetwork network_of(const std::string& source) {
  geodata::ReadOptions reading;
  reading.kind = geodata::GeometryKind::kLine;
  RawStreets raw =
      import_streets(geodata::read_layer(geodata::parse_layer_source(source), reading));
  std::erase_if(raw.streets, [](const RawStreet& street) {
    return !bounds_blocks(street.attributes.street_class, BoundingClasses::kStreets);
  });
  StreetNetwork network = build_network(raw.streets).network;
  assign_widths(network, {});
  return network;
}

TEST_P(ExemplarOfCity, CoversEveryPassageAndEnd) {
  const std::string source(GetParam().source);
  PLAT_REAL_DATA_OR_SKIP(file, source.substr(0, source.find(':')));
  const StreetNetwork network = network_of(file + source.substr(source.find(':')));
  const auto start = std::chrono::steady_clock::now();
  const Exemplar exemplar = exemplar_of(network, {});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(took.count(), 5.0);
  EXPECT_GE(exemplar.points.size(), GetParam().min_points);
  EXPECT_LE(exemplar.points.size(), GetParam().max_points);
  std::size_t pieces = 0;
  std::map<int, std::size_t> chains_per_level;
  for (const StreetChain& chain : exemplar.chains) {
    pieces += chain.pieces.size();
    ++chains_per_level[chain.hierarchy];
  }
  EXPECT_EQ(pieces, network.streets.size());
  std::size_t ends = 0;
  for (const IntersectionPoint& point : exemplar.points) {
    for (const PassingStreet& street : streets_of(point)) ends += street.connections == 1 ? 1 : 0;
  }
  EXPECT_EQ(ends, open_ends_of(network, exemplar).size());
  RecordProperty("points", static_cast<int>(exemplar.points.size()));
  RecordProperty("chains", static_cast<int>(exemplar.chains.size()));
  RecordProperty("levels", static_cast<int>(chains_per_level.size()));
}

INSTANTIATE_TEST_SUITE_P(
    Cities, ExemplarOfCity,
    ::testing::Values(
        City{"Cambridge", "cambridge_ma/cambridge_ma.gpkg:streets", 1500, 2300},
        City{"SanFrancisco", "san_francisco_us/san_francisco_us.gpkg:road", 100, 2000},
        City{"Montevideo", "montevideo_uy/montevideo_osm.gpkg:roads", 8000, 30000},
        City{"CampoGrande", "campo_grande_br/campo-grande.osm.gz:lines", 1000, 20000}),
    [](const auto& city) { return std::string(city.param.name); });

}  // namespace
}  // namespace plat::streets

#include "harness/land_use.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/box.h"
#include "geodata/layer_io.h"
#include "harness/observed_layers.h"

namespace plat::harness {
namespace {

struct Use {
  std::string_view value;  ///< of the field
  std::string_view zone;
};

/// What a field of a layer says of the land. Values that are not listed say nothing.
struct LandUse {
  std::string_view dataset;
  std::string_view layer;  ///< "path:layer"
  std::string_view field;  ///< empty: every feature is of the first zone listed
  std::span<const Use> uses;
};

constexpr Use kOpenSpace[] = {{"", "park"}};
constexpr Use kCadastre[] = {{"1_residential", "residential"}, {"2_agriculture", "other"},
                             {"3_industrial", "industrial"},   {"4_1_office", "commercial"},
                             {"4_2_retail", "commercial"},     {"4_3_publicServices", "other"}};
constexpr Use kTiles[] = {{"park", "park"},    {"pitch", "park"},   {"wood", "park"},
                          {"grass", "park"},   {"school", "other"}, {"hospital", "other"},
                          {"parking", "other"}};
constexpr Use kOpenStreetMap[] = {{"residential", "residential"},
                                  {"commercial", "commercial"},
                                  {"retail", "commercial"},
                                  {"industrial", "industrial"},
                                  {"garages", "industrial"},
                                  {"railway", "industrial"},
                                  {"grass", "park"},
                                  {"forest", "park"},
                                  {"recreation_ground", "park"},
                                  {"cemetery", "other"},
                                  {"military", "other"},
                                  {"construction", "other"}};
constexpr Use kLeisure[] = {{"park", "park"},          {"pitch", "park"},  {"playground", "park"},
                            {"golf_course", "park"},   {"garden", "park"}, {"stadium", "other"},
                            {"sports_centre", "other"}};

/// The first that says something of a place wins.
constexpr LandUse kLandUses[] = {
    {"cambridge_ma", "cambridge_ma/cambridge_ma.gpkg:open_space", "", kOpenSpace},
    {"san_roman_es", "san_roman_es/san_roman_es.gpkg:buildings", "currentUse", kCadastre},
    {"san_francisco_us", "san_francisco_us/san_francisco_us.gpkg:landuse", "class", kTiles},
    {"montevideo_uy", "montevideo_uy/montevideo_osm.gpkg:landuse", "leisure", kLeisure},
    {"montevideo_uy", "montevideo_uy/montevideo_osm.gpkg:landuse", "landuse", kOpenStreetMap}};

struct ZonedArea {
  Polygon shape;
  std::string_view zone;
  Box box;
  Point inside;
};

std::optional<std::string_view> zone_of(const LandUse& land_use, const std::string& value) {
  if (land_use.field.empty()) return land_use.uses.front().zone;
  const auto use = std::ranges::find(land_use.uses, std::string_view(value), &Use::value);
  if (use == land_use.uses.end()) return std::nullopt;
  return use->zone;
}

std::vector<ZonedArea> read_areas(const LandUse& land_use, const geodata::LocalFrame& frame,
                                  const std::filesystem::path& folder) {
  geodata::ReadOptions reading;
  reading.kind = geodata::GeometryKind::kPolygon;
  reading.frame = frame;
  if (!land_use.field.empty()) reading.fields = {std::string(land_use.field)};
  const geodata::LayerMapping mapping{std::string(land_use.layer), {}, {}, {}};
  const geodata::Layer layer = geodata::read_layer(geodata::source_of(mapping, folder), reading);
  std::vector<ZonedArea> areas;
  for (const geodata::Feature& feature : layer.features) {
    const std::string value = land_use.field.empty() ? "" : text_of(feature.attributes.at(0));
    const auto zone = zone_of(land_use, value);
    if (!zone) continue;
    for (const Polygon& shape : feature.polygons) {
      if (area_m2(shape) > 0.0)
        areas.push_back({shape, *zone, box_of(shape), interior_point(shape)});
    }
  }
  std::ranges::sort(areas, {}, [](const ZonedArea& area) { return area.box.min.x; });
  return areas;
}

std::string zone_at(const Polygon& shape, std::span<const ZonedArea> areas) {
  const Box box = box_of(shape);
  const Point inside = interior_point(shape);
  const ZonedArea* largest = nullptr;
  for (const ZonedArea& area : areas) {
    if (area.box.min.x > box.max.x) break;
    if (!area.box.intersects(box)) continue;
    if (area.box.contains(inside) && locate(area.shape, inside) == Side::kInside)
      return std::string(area.zone);
    if (box.contains(area.inside) && locate(shape, area.inside) == Side::kInside &&
        (largest == nullptr || area_m2(area.shape) > area_m2(largest->shape))) {
      largest = &area;
    }
  }
  return largest == nullptr ? std::string() : std::string(largest->zone);
}

}  // namespace

std::vector<std::string> zones_of(const geodata::Dataset& dataset, std::span<const Polygon> shapes,
                                  const geodata::LocalFrame& frame,
                                  const std::filesystem::path& folder) {
  std::vector<std::string> zones(shapes.size());
  for (const LandUse& land_use : kLandUses) {
    if (land_use.dataset != dataset.name) continue;
    const std::vector<ZonedArea> areas = read_areas(land_use, frame, folder);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (zones[i].empty() && !shapes[i].outer.empty()) zones[i] = zone_at(shapes[i], areas);
    }
  }
  return zones;
}

}  // namespace plat::harness

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "editing/city_parts.h"
#include "geodata/layer_io.h"
#include "harness/city_file.h"
#include "harness/layer_rows_internal.h"
#include "harness/tile_document.h"
#include "parcels/block_subdivider.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"
#include "streets/street_width.h"

namespace plat::harness {
namespace {

using geodata::Feature;
using geodata::GeometryKind;
using geodata::Layer;

editing::Style style_of(const LayerRows& rows, const Feature& feature, std::string_view strategy,
                        std::string_view options) {
  editing::Style out{rows.text(feature, strategy), {}};
  const std::string given = options.empty() ? std::string() : rows.text(feature, options);
  for (std::size_t start = 0; start < given.size();) {
    const std::size_t end = std::min(given.find(';', start), given.size());
    auto [key, value] = parse_option(std::string_view(given).substr(start, end - start));
    out.options.insert_or_assign(std::move(key), std::move(value));
    start = end + 1;
  }
  try {
    static_cast<void>(parcels::block_subdividers().make(out.strategy, out.options));
  } catch (const InputError& error) {
    rows.refuse(feature, error.what());
  }
  return out;
}

streets::WidthSource width_source_named(std::string_view name) {
  using streets::WidthSource;
  for (const WidthSource source :
       {WidthSource::kAttribute, WidthSource::kLanes, WidthSource::kGap, WidthSource::kClass,
        WidthSource::kAssumed, WidthSource::kExample}) {
    if (streets::width_source_name(source) == name) return source;
  }
  return WidthSource::kNone;
}

void read_document(const LayerRows& rows, editing::CityParts& parts) {
  const Feature& feature = rows.layer().features.front();
  parts.options.seed = rows.seed(feature);
  parts.options.style = style_of(rows, feature, "strategy", "options");
  const std::string matching = rows.text(feature, "matching");
  const auto known = parcels::matching_named(matching);
  if (!known) rows.refuse(feature, fmt::format("matching \"{}\" is not known", matching));
  parts.options.matching = *known;
  parts.counters = {rows.needed_id(feature, "next_node"), rows.needed_id(feature, "next_street"), 0,
                    rows.needed_id(feature, "next_block"), rows.needed_id(feature, "next_parcel")};
}

void read_streets(const LayerRows& rows, editing::CityParts& parts) {
  std::map<editing::NodeId, Point> nodes;
  std::set<StreetId> seen;
  for (const Feature& feature : rows.layer().features) {
    if (feature.lines.size() != 1 || feature.lines.front().size() < 2)
      rows.refuse(feature, "must be one line");
    const Polyline& line = feature.lines.front();
    const StreetId id{rows.needed_id(feature, "street")};
    if (!seen.insert(id).second) rows.refuse(feature, "its street id comes twice");
    editing::CityStreet street;
    street.from = editing::NodeId{rows.needed_id(feature, "from_node")};
    street.to = editing::NodeId{rows.needed_id(feature, "to_node")};
    for (const auto& [node, place] :
         {std::pair(street.from, line.front()), std::pair(street.to, line.back())}) {
      const auto [it, is_new] = nodes.emplace(node, place);
      if (!is_new && it->second != place)
        rows.refuse(feature, fmt::format("node {} has several places", node.value));
    }
    street.name = rows.text(feature, "name");
    street.street_class = rows.text(feature, "class");
    street.source_id = rows.text(feature, "source");
    street.width_source = width_source_named(rows.text(feature, "width_source"));
    street.width_m = rows.real(feature, "width_m").value_or(0.0);
    if (!(street.width_m > 0.0)) rows.refuse(feature, "width_m must be above 0");
    const auto x1 = rows.real(feature, "control1_x");
    const auto y1 = rows.real(feature, "control1_y");
    const auto x2 = rows.real(feature, "control2_x");
    const auto y2 = rows.real(feature, "control2_y");
    const Point origin = rows.layer().frame.origin;
    if (x1 && y1 && x2 && y2)
      street.curve = editing::Curve{Point{*x1, *y1} - origin, Point{*x2, *y2} - origin};
    parts.streets.emplace_back(id, std::move(street));
  }
  parts.nodes.assign(nodes.begin(), nodes.end());
}

void read_blocks(const LayerRows& rows, editing::CityParts& parts) {
  for (const Feature& feature : rows.layer().features) {
    if (feature.polygons.size() != 1) rows.refuse(feature, "must be one polygon");
    editing::CityBlock block;
    block.block.id = BlockId{rows.needed_id(feature, "block")};
    block.block.contour = feature.polygons.front();
    block.style = style_of(rows, feature, "strategy", "options");
    block.seed = rows.seed(feature);
    if (const auto code = rows.id(feature, "code"))
      block.failure = Failure{static_cast<FailureCode>(*code), rows.text(feature, "message")};
    parts.blocks.push_back(std::move(block));
  }
}

void read_parcels(const LayerRows& rows, editing::CityParts& parts) {
  std::map<std::uint32_t, editing::CityBlock*> homes;
  for (editing::CityBlock& block : parts.blocks) {
    if (!homes.emplace(block.block.id.value, &block).second)
      throw InputError(fmt::format("block id {} comes twice", block.block.id.value));
  }
  for (const Feature& feature : rows.layer().features) {
    if (feature.polygons.size() != 1) rows.refuse(feature, "must be one polygon");
    const auto home = homes.find(rows.needed_id(feature, "block"));
    if (home == homes.end()) rows.refuse(feature, "its block is not there");
    editing::ParcelRecord record;
    if (const auto id = rows.id(feature, "predecessor")) record.predecessor = ParcelId{*id};
    if (const std::string attributes = rows.text(feature, "attributes"); !attributes.empty()) {
      try {
        record.attributes = nlohmann::json::parse(attributes).get<editing::TextAttributes>();
      } catch (const nlohmann::json::exception&) {
        rows.refuse(feature, "attributes must be a JSON object of texts");
      }
    }
    home->second->parcels.push_back(
        {ParcelId{rows.needed_id(feature, "parcel")}, feature.polygons.front()});
    home->second->records.push_back(std::move(record));
  }
}

PlacedCity restore(const std::string& file, const editing::CityOptions& options) {
  const LayerRows document = read_rows(file, "document", GeometryKind::kPoint, std::nullopt);
  const geodata::LocalFrame frame = document.layer().frame;
  editing::CityParts parts;
  parts.options.jobs = options.jobs;
  read_document(document, parts);
  if (has_features(file, "streets"))
    read_streets(read_rows(file, "streets", GeometryKind::kLine, frame), parts);
  if (has_features(file, "blocks"))
    read_blocks(read_rows(file, "blocks", GeometryKind::kPolygon, frame), parts);
  if (has_features(file, "parcels"))
    read_parcels(read_rows(file, "parcels", GeometryKind::kPolygon, frame), parts);
  if (const auto next_tile = document.has("next_tile")
                                 ? document.id(document.layer().features.front(), "next_tile")
                                 : std::nullopt)
    parts.tiles =
        std::make_shared<const tiles::TileLayout>(read_tile_document(file, frame, *next_tile));
  auto city = editing::restore_city(parts);
  if (!city) {
    throw InputError(
        fmt::format("{}: is no city any more: {}; streets and blocks are changed by "
                    "edits only",
                    file, city.error().message));
  }
  return {*std::move(city), frame};
}

/// The style of the feature of the file's blocks that a block's inner point lies in.
editing::StyleOf styles_of(const LayerRows& rows, const CityReading& reading) {
  struct Known {
    Box box;
    Polygon shape;
    editing::Style style;
  };
  auto known = std::make_shared<std::vector<Known>>();
  for (const Feature& feature : rows.layer().features) {
    for (const Polygon& shape : feature.polygons) {
      known->push_back({box_of(shape), shape,
                        style_of(rows, feature, reading.strategy_field, reading.options_field)});
    }
  }
  return [known](const blocks::Block& block) -> std::optional<editing::Style> {
    const Point p = interior_point(block.contour);
    for (const Known& each : *known) {
      if (each.box.contains(p) && locate(each.shape, p) == Side::kInside) return each.style;
    }
    return std::nullopt;
  };
}

}  // namespace

PlacedCity read_city(const std::string& file, const CityReading& reading) {
  if (has_features(file, "document")) return restore(file, reading.options);
  const Layer layer = geodata::read_layer({file, "streets"}, {.kind = GeometryKind::kLine});
  streets::StreetNetwork network =
      streets::build_network(streets::import_streets(layer).streets).network;
  streets::assign_widths(network, {}, {}, reading.options.jobs);
  editing::StyleOf style_of;
  if (!reading.strategy_field.empty()) {
    style_of = styles_of(read_rows(file, "blocks", GeometryKind::kPolygon, layer.frame), reading);
  }
  return {
      editing::make_city(network, reading.options, streets::BoundingClasses::kStreets, style_of),
      layer.frame};
}

}  // namespace plat::harness

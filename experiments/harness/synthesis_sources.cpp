#include "harness/synthesis_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/box.h"
#include "core/validity.h"
#include "core/working_grid.h"
#include "geodata/dataset_catalogue.h"
#include "harness/observed_layers.h"
#include "harness/observed_streets.h"
#include "streets/intersection_point_layer.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"
#include "streets/street_width.h"

namespace plat::harness {
namespace {

using geodata::GeometryKind;
using geodata::Layer;
using streets::StreetNetwork;

[[noreturn]] void refuse(const std::string& script, const std::string& path,
                         std::string_view what) {
  throw InputError(fmt::format("{}: {}: {}", script, path, what));
}

/// Calls `read`, and puts script and path before what it refuses.
template <class Read>
auto naming(const std::string& script, const std::string& path, Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    refuse(script, path, error.what());
  }
}

ObservedStreets read_files(const ScriptSource& source, Jobs jobs) {
  ObservedStreets out;
  geodata::ReadOptions reading;
  if (source.parcels) {
    reading.kind = GeometryKind::kPolygon;
    const Layer layer = geodata::read_layer(*source.parcels, reading);
    reading.frame = layer.frame;
    for (const blocks::ObservedParcel& parcel : parcels_of(layer)) {
      Polygon shape = snap_polygon(parcel.shape);
      if (!shape.outer.empty()) out.parcels.push_back(std::move(shape));
    }
  }
  reading.kind = GeometryKind::kLine;
  const Layer layer = geodata::read_layer(*source.streets, reading);
  out.frame = layer.frame;
  const streets::RawStreets raw = streets::import_streets(layer, source.fields);
  out.network = streets::build_network(raw.streets).network;
  streets::assign_widths(out.network, out.parcels, {}, jobs);
  return out;
}

ObservedStreets read_streets_of(const ScriptSource& source, Jobs jobs) {
  if (source.dataset) return load_streets(geodata::dataset(*source.dataset), jobs);
  return read_files(source, jobs);
}

/// The frame of a source, offsets counted from the centre of what it holds.
ScriptFrame frame_of(const std::string& script, const geodata::LocalFrame& frame, const Box& box) {
  return {script, frame, box.is_empty() ? Point{} : snap(box.center())};
}

bool is_inside(const Polygon& region, std::span<const Point> line) {
  return std::all_of(line.begin(), line.end(),
                     [&](Point p) { return locate(region, p) != Side::kOutside; });
}

StreetNetwork streets_inside(const StreetNetwork& network, const Polygon& region) {
  StreetNetwork out;
  for (const streets::Street& street : network.streets) {
    if (!is_inside(region, street.line)) continue;
    out.streets.push_back(street);
    out.nodes.push_back(street.line.front());
    out.nodes.push_back(street.line.back());
  }
  std::sort(out.nodes.begin(), out.nodes.end());
  out.nodes.erase(std::unique(out.nodes.begin(), out.nodes.end()), out.nodes.end());
  const auto node_at = [&](Point p) {
    return static_cast<std::uint32_t>(std::lower_bound(out.nodes.begin(), out.nodes.end(), p) -
                                      out.nodes.begin());
  };
  for (std::size_t s = 0; s < out.streets.size(); ++s) {
    streets::Street& street = out.streets[s];
    street.id = {static_cast<std::uint32_t>(s)};
    street.from = node_at(street.line.front());
    street.to = node_at(street.line.back());
  }
  return out;
}

}  // namespace

Point place_in(const ScriptFrame& frame, const ScriptPlace& place) {
  return snap(place.is_offset ? frame.anchor + place.value : place.value - frame.frame.origin);
}

std::vector<Polygon> polygons_in(const ScriptFrame& frame, const ScriptRegion& region) {
  if (!region.layer) {
    Polygon polygon;
    for (const ScriptPlace& place : region.ring) polygon.outer.push_back(place_in(frame, place));
    if (signed_area_m2(polygon.outer) < 0.0)
      std::reverse(polygon.outer.begin(), polygon.outer.end());
    return {polygon};
  }
  return naming(frame.source, region.path, [&] {
    const Layer layer =
        geodata::read_layer(*region.layer, {.frame = frame.frame, .kind = GeometryKind::kPolygon});
    std::vector<Polygon> out;
    for (const geodata::Feature& feature : layer.features) {
      for (const Polygon& shape : feature.polygons) {
        if (Polygon snapped = snap_polygon(shape); !snapped.outer.empty())
          out.push_back(std::move(snapped));
      }
    }
    return out;
  });
}

Polygon polygon_in(const ScriptFrame& frame, const ScriptRegion& region) {
  const std::vector<Polygon> polygons = polygons_in(frame, region);
  if (polygons.size() != 1) {
    refuse(frame.source, region.path,
           fmt::format("must be one polygon, {} has {}", geodata::to_string(*region.layer),
                       polygons.size()));
  }
  constexpr std::size_t kMaxVertices = 100000;
  auto admitted = admit_polygon(polygons.front(), kMaxVertices);
  if (!admitted) refuse(frame.source, region.path, "is no polygon: " + admitted.error().message);
  return *std::move(admitted);
}

ReadExample read_example(const ScriptSource& source, const std::string& script, Jobs jobs) {
  ReadExample out = naming(script, source.path, [&]() -> ReadExample {
    if (source.points) {
      streets::ReadPoints read = streets::read_intersection_points(*source.points);
      return {read.frame, std::move(read.points)};
    }
    const ObservedStreets read = read_streets_of(source, jobs);
    return {read.frame, streets::exemplar_of(read.network, read.parcels, source.exemplar).points};
  });
  Box box;
  for (const streets::IntersectionPoint& point : out.points) box.add(point.place);
  if (source.region) {
    const Polygon region = polygon_in(frame_of(script, out.frame, box), *source.region);
    std::erase_if(out.points, [&](const streets::IntersectionPoint& point) {
      return locate(region, point.place) == Side::kOutside;
    });
  }
  if (out.points.empty()) {
    refuse(script, source.path,
           source.region
               ? fmt::format("no point lies in its region; points lie in x {:.0f}..{:.0f}, y "
                             "{:.0f}..{:.0f}",
                             box.min.x + out.frame.origin.x, box.max.x + out.frame.origin.x,
                             box.min.y + out.frame.origin.y, box.max.y + out.frame.origin.y)
               : std::string("holds no intersection point"));
  }
  return out;
}

ReadCity read_city_streets(const ScriptSource& source, const std::string& script, Jobs jobs) {
  ObservedStreets read = naming(script, source.path, [&] { return read_streets_of(source, jobs); });
  if (source.region) {
    const ScriptFrame frame = frame_of(script, read.frame, box_of(read.network.nodes));
    read.network = streets_inside(read.network, polygon_in(frame, *source.region));
    if (read.network.streets.empty()) refuse(script, source.region->path, "no street lies in it");
  }
  return {read.frame, std::move(read.network), std::move(read.parcels)};
}

}  // namespace plat::harness

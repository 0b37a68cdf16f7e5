#include "tile_similarity/tile_gallery.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/failure.h"
#include "core/rng.h"
#include "geodata/dataset_catalogue.h"
#include "geodata/layer_io.h"
#include "harness/observed_layers.h"
#include "harness/tile_shapes.h"

namespace plat::tile_similarity {
namespace {

/// Gives every tile the value of the largest feature whose middle lies in it.
void set_zones(harness::ReadTileShapes& tiles, const geodata::LayerSource& source,
               const std::string& field) {
  const geodata::Layer layer = geodata::read_layer(
      source, {.frame = tiles.frame, .fields = {field}, .kind = geodata::GeometryKind::kPolygon});
  std::vector<double> largest(tiles.shapes.size(), 0.0);
  std::vector<Box> boxes;
  for (const auto& shape : tiles.shapes) boxes.push_back(box_of(shape.polygon));
  for (const geodata::Feature& feature : layer.features) {
    for (const Polygon& part : feature.polygons) {
      const double area = area_m2(part);
      const Point middle = centroid(part);
      for (std::size_t i = 0; i < boxes.size() && area > 0.0; ++i) {
        if (area <= largest[i] || !boxes[i].contains(middle) ||
            locate(tiles.shapes[i].polygon, middle) != Side::kInside)
          continue;
        largest[i] = area;
        tiles.shapes[i].zone = harness::text_of(feature.attributes.front());
      }
    }
  }
}

/// Fisher and Yates.
template <class T>
void shuffle(std::vector<T>& values, Rng& rng) {
  for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[rng.index(i)]);
}

}  // namespace

std::string file_of(const std::string& name) {
  const geodata::Dataset& dataset = geodata::dataset(name);
  if (!dataset.observed || !dataset.observed->parcels) throw InputError(name + ": has no parcels");
  const std::string& layer = dataset.observed->parcels->layer;
  return (geodata::data_dir() / layer.substr(0, layer.rfind(':'))).string();
}

TileGallery read_gallery(const PlaceChoice& place, const SimilarityConfig& config, Jobs jobs) {
  const std::string file = file_of(place.dataset);
  harness::ParcelShapeSources sources;
  sources.parcels = {file, place.layer};
  harness::ReadTileShapes tiles = harness::read_tile_shapes(sources, jobs);
  if (place.zones) set_zones(tiles, {file, place.zones->layer}, place.zones->field);

  std::map<std::uint32_t, std::vector<std::uint32_t>> of_block;
  for (std::uint32_t i = 0; i < tiles.shapes.size(); ++i) {
    if (place.layer == "blocks") {
      of_block[i] = {i};
    } else if (tiles.blocks[i]) {
      of_block[*tiles.blocks[i]].push_back(i);
    }
  }
  std::vector<std::uint32_t> order;
  for (const auto& [block, members] : of_block) order.push_back(block);
  Rng rng(derive_seed(config.seed, {seed_key(place.name), seed_key("gallery")}));
  shuffle(order, rng);
  TileGallery out;
  out.tiles = tiles.shapes.size();
  out.refused = tiles.failures.size();
  for (const std::uint32_t block : order) {
    if (out.shapes.size() >= static_cast<std::size_t>(config.gallery)) break;
    for (const std::uint32_t i : of_block[block]) {
      out.shapes.push_back(tiles.shapes[i]);
      out.ids.push_back(tiles.ids[i]);
      out.blocks.push_back(block);
    }
  }
  for (std::uint32_t i = 0; i < out.shapes.size(); ++i) out.queries.push_back(i);
  shuffle(out.queries, rng);
  out.queries.resize(std::min(out.queries.size(), static_cast<std::size_t>(config.queries)));
  std::sort(out.queries.begin(), out.queries.end());
  return out;
}

}  // namespace plat::tile_similarity

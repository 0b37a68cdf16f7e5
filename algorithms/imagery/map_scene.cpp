#include "imagery/map_scene.h"

#include <algorithm>

#include "imagery/plot.h"
#include "imagery/plot_ground.h"
#include "imagery/roofs.h"
#include "imagery/street_surface.h"

namespace plat::imagery {
namespace {

class SceneMaker {
 public:
  SceneMaker(const MapLayers& layers, const SceneOptions& options)
      : layers_(layers), options_(options), plots_(make_plots(layers)) {
    if (layers.footprints.empty() && options.missing == MissingFootprints::kAssume) {
      assume_houses(plots_, options.seed);
      for (const Plot& plot : plots_) out_.assumed_footprints += plot.buildings.size();
    }
  }

  MapScene make() {
    const bool is_dry = options_.style.is_dry();
    out_.scene.set_ground(is_dry ? tints::kDrySoil : tints::kDryLawn,
                          is_dry ? Material::kSoil : Material::kMeadow);
    add_open_space();
    if (layers_.streets.streets.empty()) add_gaps(out_.scene, layers_);
    add_pavements(out_.scene, layers_);
    for (std::size_t i = 0; i < plots_.size(); ++i) {
      Rng rng = stream("plot", i);
      add_plot_ground(out_.scene, plots_[i], options_.style, rng);
    }
    for (const Polygon& water : layers_.water)
      out_.scene.add(region(water, tints::kWater, Material::kWater));
    add_carriageways(out_.scene, layers_, options_.seed);
    add_buildings();
    add_street_trees(out_.scene, layers_, options_.style, options_.seed);
    out_.scene.index();
    return std::move(out_);
  }

 private:
  [[nodiscard]] Rng stream(std::string_view what, std::size_t number) const {
    return Rng(derive_seed(options_.seed, {seed_key(what), number}));
  }

  void add_open_space() {
    for (std::size_t i = 0; i < layers_.open_space.size(); ++i) {
      Rng rng = stream("open space", i);
      const Polygon& shape = layers_.open_space[i];
      const Tint lawn = options_.style.is_dry() ? tints::kDryLawn : tints::kLawn;
      out_.scene.add(region(shape, varied(rng, lawn, 0.14), Material::kGrass));
      const double spacing = rng.uniform(8.0, 22.0) * (options_.style.is_dry() ? 1.5 : 1.0);
      scatter_trees(out_.scene, shape, spacing, 6.0, options_.style, rng, [&](Point p, double r) {
        return std::any_of(layers_.water.begin(), layers_.water.end(), [&](const Polygon& water) {
          return plat::box_of(water).expanded(r).contains(p) && locate(water, p) != Side::kOutside;
        });
      });
    }
  }

  /// From the lowest to the highest: a tower's roof covers the hall that it rises from.
  void add_buildings() {
    std::vector<Footprint> all = layers_.footprints;
    for (const Footprint& building : all) {
      out_.assumed_heights += building.height_source == HeightSource::kAssumed ? 1 : 0;
    }
    if (all.empty()) {
      for (const Plot& plot : plots_)
        all.insert(all.end(), plot.buildings.begin(), plot.buildings.end());
    }
    std::vector<std::size_t> order(all.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return all[a].height_m < all[b].height_m;
    });
    for (const std::size_t i : order) {
      Rng rng = stream("roof", i);
      add_roof(out_.scene, all[i], options_.style, options_.sun, rng);
    }
  }

  const MapLayers& layers_;
  const SceneOptions& options_;
  std::vector<Plot> plots_;
  MapScene out_;
};

}  // namespace

MapScene make_scene(const MapLayers& layers, const SceneOptions& options) {
  return SceneMaker(layers, options).make();
}

}  // namespace plat::imagery

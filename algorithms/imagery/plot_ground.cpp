#include "imagery/plot_ground.h"

#include <algorithm>
#include <cmath>

#include "imagery/street_surface.h"

namespace plat::imagery {
namespace {

/// Up to this area a plot is a house's garden; a villa's, up to the next, where no building is
/// larger than a villa.
constexpr double kGardenPlot_m2 = 1300.0;
constexpr double kVillaPlot_m2 = 4500.0;
constexpr double kVilla_m2 = 420.0;
/// From this area on, without a building on a twentieth of it, it is a field.
constexpr double kField_m2 = 4000.0;
constexpr double kStall_m = 2.6;
constexpr double kBayDepth_m = 5.2;

struct Cover {
  Tint tint;
  Material material;
};

Cover garden_cover(const PictureStyle& style, Rng& rng) {
  const double kind = rng.uniform_01();
  if (style.is_dry()) {
    if (kind < 0.30) return {varied(rng, tints::kDrySoil, 0.12), Material::kSoil};
    if (kind < 0.55) return {varied(rng, tints::kLawn, 0.16), Material::kGrass};
    if (kind < 0.75) return {varied(rng, tints::kDryLawn, 0.14), Material::kGrass};
    if (kind < 0.90) return {varied(rng, {0.66, 0.56, 0.47}, 0.10), Material::kConcrete};
    return {varied(rng, tints::kGravel, 0.10), Material::kGravel};
  }
  if (kind < 0.50) return {varied(rng, tints::kLawn, 0.18), Material::kGrass};
  if (kind < 0.63) return {varied(rng, tints::kDryLawn, 0.14), Material::kGrass};
  if (kind < 0.76) return {varied(rng, tints::kShrubs, 0.15), Material::kMeadow};
  if (kind < 0.86) return {varied(rng, tints::kSoil, 0.14), Material::kSoil};
  if (kind < 0.95) return {varied(rng, tints::kOldAsphalt, 0.12), Material::kAsphalt};
  return {varied(rng, tints::kConcrete, 0.10), Material::kConcrete};
}

/// Draws one plot.
class Gardener {
 public:
  Gardener(Scene& scene, const Plot& plot, const PictureStyle& style, Rng& rng)
      : scene_(scene), plot_(plot), style_(style), rng_(rng), extent_(plot.extent()) {
    house_front_ = extent_.front;
    house_back_ = extent_.front;
    const Point side = perpendicular(plot.front);
    for (const Footprint& building : plot.buildings) {
      for (const Point p : building.shape.outer) {
        const double y = dot(p, plot.front);
        house_front_ = is_first_ ? y : std::max(house_front_, y);
        house_back_ = is_first_ ? y : std::min(house_back_, y);
        house_right_ = is_first_ ? dot(p, side) : std::min(house_right_, dot(p, side));
        house_left_ = is_first_ ? dot(p, side) : std::max(house_left_, dot(p, side));
        is_first_ = false;
      }
    }
  }

  void add_garden() {
    const Cover back = garden_cover(style_, rng_);
    cover(plot_.shape, back);
    if (plot_.has_front && !plot_.buildings.empty()) {
      const Cover front = garden_cover(style_, rng_);
      const double limit = house_front_ - rng_.uniform(0.5, 3.0);
      add_part(clipped(plot_.shape.outer, -plot_.front, -limit), front);
      add_drive();
      add_path();
    }
    if (back.material != Material::kAsphalt) {
      add_beds();
      add_patio();
      add_shed();
      if (style_.is_dry() && rng_.uniform_01() < 0.42) add_pool();
    }
    add_fence();
    const bool is_green = back.material == Material::kGrass || back.material == Material::kMeadow;
    const double spacing = (is_green ? 6.5 : 10.5) * (style_.is_dry() ? 1.25 : 1.0);
    add_trees(spacing * rng_.uniform(0.7, 1.6), rng_.uniform(2.4, 5.6));
  }

  void add_yard() {
    const double kind = rng_.uniform_01();
    if (kind < 0.45) {
      cover(plot_.shape, {varied(rng_, tints::kLawn, 0.15), Material::kGrass});
      add_walks();
      add_trees(rng_.uniform(10.0, 17.0), 5.5);
    } else if (kind < 0.85) {
      cover(plot_.shape, {varied(rng_, tints::kOldAsphalt, 0.10), Material::kAsphalt});
      add_parking();
      add_trees(26.0, 3.5);
    } else {
      cover(plot_.shape, {varied(rng_, tints::kConcrete, 0.08), Material::kConcrete});
      add_trees(22.0, 3.0);
    }
  }

  void add_field() {
    const double kind = rng_.uniform_01();
    const Tint ground = style_.is_dry() ? mix(tints::kDrySoil, tints::kDryLawn, rng_.uniform_01())
                                        : mix(tints::kLawn, tints::kDryLawn, rng_.uniform_01());
    cover(plot_.shape, {varied(rng_, ground, 0.12), Material::kMeadow});
    if (kind < 0.35) add_furrows(ground);
    const bool is_wood = kind > 0.82;
    add_trees(is_wood ? 6.0 : (kind > 0.55 ? 14.0 : 40.0), is_wood ? 4.5 : 3.8);
  }

 private:
  void cover(const Polygon& shape, const Cover& with) {
    scene_.add(region(shape, with.tint, with.material));
  }
  void add_part(Ring ring, const Cover& with) {
    if (ring.size() >= 3) scene_.add(region(std::move(ring), with.tint, with.material));
  }
  /// The part of the plot between two distances to the street side and two to the left.
  [[nodiscard]] Ring strip(double back, double front, double right, double left) const {
    const Point side = perpendicular(plot_.front);
    Ring ring = clipped(plot_.shape.outer, plot_.front, front);
    ring = clipped(ring, -plot_.front, -back);
    ring = clipped(ring, side, left);
    return clipped(ring, -side, -right);
  }
  [[nodiscard]] Point at(double y, double x) const {
    return y * plot_.front + x * perpendicular(plot_.front);
  }

  void add_drive() {
    if (rng_.uniform_01() < 0.25) return;
    const bool is_left = extent_.left - house_left_ > house_right_ - extent_.right;
    const double room = is_left ? extent_.left - house_left_ : house_right_ - extent_.right;
    const double width = std::clamp(room, 2.4, 3.6);
    const double outer = is_left ? extent_.left - 0.2 : extent_.right + 0.2;
    const double back = room > 2.3 ? house_back_ + rng_.uniform(0.0, 4.0) : house_front_ - 0.5;
    const Tint tint =
        varied(rng_, rng_.uniform_01() < 0.5 ? tints::kConcrete : tints::kOldAsphalt, 0.10);
    add_part(strip(back, extent_.front + 1.0, is_left ? outer - width : outer,
                   is_left ? outer : outer + width),
             {tint, Material::kConcrete});
    const Point place = at(rng_.uniform(house_front_ - 3.0, extent_.front - 3.0),
                           is_left ? outer - width / 2.0 : outer + width / 2.0);
    if (rng_.uniform_01() < 0.45 && locate(plot_.shape, place) == Side::kInside &&
        !plot_.is_built(place, 1.2))
      add_car(scene_, place, plot_.front, rng_);
  }

  void add_path() {
    const double x =
        rng_.uniform(house_right_ + 1.0, std::max(house_right_ + 1.1, house_left_ - 1));
    add_part(strip(house_front_ - 0.5, extent_.front + 1.0, x - 0.6, x + 0.6),
             {varied(rng_, tints::kConcrete, 0.08), Material::kConcrete});
  }

  /// A strip of shrubs along the back.
  void add_beds() {
    if (rng_.uniform_01() < 0.5) return;
    add_part(
        strip(extent_.back, extent_.back + rng_.uniform(1.0, 3.0), extent_.right, extent_.left),
        {varied(rng_, tints::kShrubs, 0.15), Material::kMeadow});
  }

  void add_patio() {
    if (plot_.buildings.empty() || rng_.uniform_01() < 0.35) return;
    const double width = rng_.uniform(0.35, 0.8) * (house_left_ - house_right_);
    const double x = rng_.uniform(house_right_, house_left_ - width);
    add_part(strip(house_back_ - rng_.uniform(2.0, 4.5), house_back_ + 0.5, x, x + width),
             {varied(rng_, rng_.uniform_01() < 0.4 ? tints::kWood : tints::kConcrete, 0.12),
              Material::kConcrete});
  }

  void add_box(Point center, double half_length, double half_width, Tint tint, Material material,
               double height_m) {
    const Ring box = rectangle(center, plot_.front, half_length, half_width);
    const bool fits = std::all_of(box.begin(), box.end(), [&](Point p) {
      return locate(plot_.shape, p) == Side::kInside && !plot_.is_built(p, 0.8);
    });
    if (fits) scene_.add(region(box, tint, material, height_m));
  }

  void add_shed() {
    if (rng_.uniform_01() < 0.5) return;
    const Point place = at(extent_.back + rng_.uniform(2.2, 4.0),
                           rng_.uniform(extent_.right + 2.0, extent_.left - 2.0));
    add_box(place, rng_.uniform(1.2, 2.6), rng_.uniform(1.2, 2.2),
            pitched_roof_tint(rng_, style_.roofs), Material::kPitchedRoof, 2.4);
  }

  void add_pool() {
    const double y = rng_.uniform(extent_.back, std::max(extent_.back + 1.0, house_back_));
    const Point place = at(y, rng_.uniform(extent_.right, extent_.left));
    const double half_length = rng_.uniform(2.0, 4.2);
    const double half_width = rng_.uniform(1.3, 2.1);
    add_box(place, half_length + 0.9, half_width + 0.9, tints::kConcrete, Material::kConcrete, 0.0);
    add_box(place, half_length, half_width, varied(rng_, tints::kPool, 0.08), Material::kWater,
            0.0);
  }

  void add_fence() {
    const double kind = rng_.uniform_01();
    if (kind < 0.2) return;
    const bool is_hedge = kind < 0.5;
    Ring ring = plot_.shape.outer;
    ring.push_back(ring.front());
    Shape fence = line(std::move(ring), is_hedge ? rng_.uniform(0.6, 1.2) : 0.25,
                       varied(rng_, is_hedge ? tints::kHedge : tints::kFence, 0.12),
                       is_hedge ? Material::kMeadow : Material::kConcrete);
    fence.height_m = is_hedge ? 1.6 : 1.2;
    scene_.add(std::move(fence));
  }

  void add_trees(double spacing_m, double largest_m) {
    scatter_trees(scene_, plot_.shape, spacing_m, largest_m, style_, rng_, [&](Point p, double r) {
      return plot_.is_built(p, 0.55 * r) || boundary_distance_m(plot_.shape, p) < 0.4 * r;
    });
  }

  void add_walks() {
    const double width = rng_.uniform(1.5, 2.6);
    const Cover walk{varied(rng_, tints::kConcrete, 0.06), Material::kConcrete};
    const double x = rng_.uniform(extent_.right, extent_.left);
    const double y = rng_.uniform(extent_.back, extent_.front);
    add_part(strip(extent_.back, extent_.front, x, x + width), walk);
    add_part(strip(y, y + width, extent_.right, extent_.left), walk);
  }

  /// Bays in pairs of rows, some of them taken.
  void add_parking() {
    const double fullness = rng_.uniform(0.2, 0.85);
    const Point side = perpendicular(plot_.front);
    const double pitch = 2.0 * kBayDepth_m + 6.5;
    for (double y = extent_.back + 1.5; y + kBayDepth_m < extent_.front; y += pitch) {
      for (const double row : {y + kBayDepth_m / 2.0, y + 1.5 * kBayDepth_m}) {
        for (double x = extent_.right + 2.0; x < extent_.left - 2.0; x += kStall_m) {
          const Point place = at(row, x);
          const bool is_taken = rng_.uniform_01() < fullness;
          if (locate(plot_.shape, place) != Side::kInside ||
              boundary_distance_m(plot_.shape, place) < 2.8 || plot_.is_built(place, 3.0))
            continue;
          scene_.add(region(
              rectangle(place + kStall_m / 2.0 * side, plot_.front, kBayDepth_m / 2.0 - 0.1, 0.06),
              tints::kWhitePaint, Material::kPaint));
          if (is_taken) add_car(scene_, place, plot_.front, rng_);
        }
      }
    }
  }

  void add_furrows(Tint ground) {
    const double pitch = rng_.uniform(2.5, 6.0);
    const Tint tint = rng_.uniform(0.82, 0.94) * ground;
    for (double x = extent_.right; x < extent_.left; x += pitch)
      add_part(strip(extent_.back, extent_.front, x, x + 0.45 * pitch), {tint, Material::kMeadow});
  }

  Scene& scene_;
  const Plot& plot_;
  const PictureStyle& style_;
  Rng& rng_;
  Plot::Extent extent_;
  bool is_first_ = true;
  double house_front_ = 0.0;
  double house_back_ = 0.0;
  double house_right_ = 0.0;
  double house_left_ = 0.0;
};

}  // namespace

namespace {

bool is_garden(const Plot& plot, double plot_m2) {
  if (plot_m2 <= kGardenPlot_m2) return true;
  return plot_m2 <= kVillaPlot_m2 && !plot.buildings.empty() &&
         std::all_of(plot.buildings.begin(), plot.buildings.end(),
                     [](const Footprint& b) { return area_m2(b.shape) < kVilla_m2; });
}

}  // namespace

void add_plot_ground(Scene& scene, const Plot& plot, const PictureStyle& style, Rng& rng) {
  const double area = area_m2(plot.shape);
  Gardener gardener(scene, plot, style, rng);
  if (area > kField_m2 && plot.built_m2() < 0.05 * area) {
    gardener.add_field();
  } else if (is_garden(plot, area)) {
    gardener.add_garden();
  } else {
    gardener.add_yard();
  }
}

}  // namespace plat::imagery

#include "imagery/street_surface.h"

#include <algorithm>
#include <cmath>

#include "core/polygon.h"

namespace plat::imagery {
namespace {

using streets::Street;
using streets::StreetNetwork;

/// Narrower than this is a path: gravel, no kerbs, no cars.
constexpr double kPath_m = 4.0;
/// Carriageways from this width on have a line in the middle, cars on both sides, zebras.
constexpr double kLined_m = 7.5;
/// And from this on two lanes each way.
constexpr double kFourLanes_m = 13.0;
constexpr double kKerb_m = 0.3;
/// Around plots of at most this area, this far, there is street where the map has none.
constexpr double kTownPlot_m2 = 8000.0;
constexpr double kGap_m = 7.0;
constexpr double kGapPavement_m = 1.5;
constexpr double kParkedOffset_m = 1.15;  ///< of a parked car's middle from the kerb
constexpr double kCarPitch_m = 6.2;
constexpr double kTreePitch_m = 9.5;

/// A place on a street and the way it runs there.
struct Station {
  Point place;
  Point along;
};

/// Where one is after so many metres.
Station station(const Polyline& line, double at_m) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double size = distance(line[i], line[i + 1]);
    if (at_m <= size || i + 2 == line.size()) {
      const Point along = normalized(line[i + 1] - line[i]);
      return {line[i] + std::min(at_m, size) * along, along};
    }
    at_m -= size;
  }
  return {line.front(), {1.0, 0.0}};
}

/// The piece of a line between two lengths, moved to the left.
Polyline piece(const Polyline& line, double from_m, double to_m, double left_m) {
  Polyline out;
  const auto add = [&](const Station& s) {
    out.push_back(s.place + left_m * perpendicular(s.along));
  };
  add(station(line, from_m));
  double passed = 0.0;
  for (std::size_t i = 0; i + 2 < line.size(); ++i) {
    passed += distance(line[i], line[i + 1]);
    if (passed <= from_m || passed >= to_m) continue;
    const Point along = normalized(line[i + 2] - line[i]);
    out.push_back(line[i + 1] + left_m * perpendicular(along));
  }
  add(station(line, to_m));
  return out;
}

/// How far the streets that meet at each node reach into each other, metres.
std::vector<double> junction_radii(const StreetNetwork& network) {
  std::vector<double> radii(network.nodes.size(), 0.0);
  const std::vector<std::uint32_t> degrees = streets::node_degrees(network);
  for (const Street& street : network.streets) {
    for (const std::uint32_t node : {street.from, street.to}) {
      if (degrees[node] > 2)
        radii[node] = std::max(radii[node], carriageway_m(street.width_m) / 2.0 + 1.5);
    }
  }
  return radii;
}

bool is_hidden(const Street& street) {
  return street.attributes.structure == streets::Structure::kTunnel;
}

/// What is drawn on one street's asphalt.
class Markings {
 public:
  Markings(Scene& scene, const Street& street, double start_m, double end_m, Rng& rng)
      : scene_(scene),
        line_(street.line),
        width_m_(carriageway_m(street.width_m)),
        from_m_(start_m),
        to_m_(length_m(street.line) - end_m),
        rng_(rng) {}

  void add(bool has_zebra_at_start, bool has_zebra_at_end) {
    if (width_m_ < kLined_m || to_m_ - from_m_ < 12.0) return;
    if (has_zebra_at_start) add_zebra(from_m_ + 1.6);
    if (has_zebra_at_end) add_zebra(to_m_ - 1.6);
    const double margin = 4.5;
    if (width_m_ >= kFourLanes_m) {
      for (const double left : {-0.12, 0.12}) add_line(margin, left, 0.12, tints::kYellowPaint);
      for (const double left : {-0.25, 0.25}) add_dashes(margin, left * width_m_);
      for (const double left : {-0.47, 0.47})
        add_line(margin, left * width_m_, 0.12, tints::kWhitePaint);
    } else if (width_m_ >= 9.0) {
      add_line(margin, 0.0, 0.2, tints::kYellowPaint);
    } else {
      add_dashes(margin, 0.0);
    }
  }

  /// Parked along the kerbs, and a few on the way.
  void add_cars() {
    if (width_m_ < 6.0) return;
    const double kerb = width_m_ / 2.0 - kParkedOffset_m;
    const double fullness = rng_.uniform(0.15, 0.65);
    for (const double side : {-1.0, 1.0}) {
      for (double at = from_m_ + 5.0; at < to_m_ - 5.0; at += kCarPitch_m) {
        const double jitter = rng_.uniform(-0.4, 0.4);
        if (rng_.uniform_01() < fullness) add_car_at(at + jitter, side * kerb);
      }
      if (width_m_ < kLined_m) return;  // one side only
    }
    const double lane = width_m_ >= kFourLanes_m ? 0.13 * width_m_ : 0.2 * width_m_;
    for (double at = from_m_ + rng_.uniform(5.0, 70.0); at < to_m_ - 5.0;
         at += rng_.uniform(15.0, 110.0))
      add_car_at(at, rng_.uniform_01() < 0.5 ? lane : -lane);
  }

 private:
  void add_line(double margin_m, double left_m, double line_width_m, Tint tint) {
    scene_.add(line(piece(line_, from_m_ + margin_m, to_m_ - margin_m, left_m), line_width_m, tint,
                    Material::kPaint));
  }
  void add_dashes(double margin_m, double left_m) {
    for (double at = from_m_ + margin_m; at + 3.0 < to_m_ - margin_m; at += 9.0)
      scene_.add(
          line(piece(line_, at, at + 3.0, left_m), 0.14, tints::kWhitePaint, Material::kPaint));
  }
  void add_zebra(double at_m) {
    const Station s = station(line_, at_m);
    for (double left = -width_m_ / 2.0 + 0.6; left < width_m_ / 2.0 - 0.3; left += 1.1)
      scene_.add(region(rectangle(s.place + left * perpendicular(s.along), s.along, 1.3, 0.27),
                        tints::kWhitePaint, Material::kPaint));
  }
  void add_car_at(double at_m, double left_m) {
    const Station s = station(line_, at_m);
    add_car(scene_, s.place + left_m * perpendicular(s.along), s.along, rng_);
  }

  Scene& scene_;
  const Polyline& line_;
  double width_m_, from_m_, to_m_;
  Rng& rng_;
};

}  // namespace

double carriageway_m(double width_m) {
  if (width_m < kPath_m) return width_m;
  return width_m - 2.0 * std::clamp(0.19 * width_m, 0.6, 4.0);
}

void add_car(Scene& scene, Point center, Point along, Rng& rng) {
  const Point u = rng.uniform_01() < 0.5 ? along : -along;
  const double half_length = rng.uniform(2.05, 2.5);
  const double half_width = rng.uniform(0.85, 0.97);
  const Tint tint = car_tint(rng);
  scene.add(region(rectangle(center, u, half_length, half_width), tint, Material::kMetal, 0.9));
  const Tint glass{0.16, 0.18, 0.20};
  scene.add(region(rectangle(center - 0.2 * u, u, 0.58 * half_length, 0.82 * half_width), glass,
                   Material::kMetal, 1.3));
  scene.add(region(rectangle(center - 0.25 * u, u, 0.34 * half_length, 0.80 * half_width), tint,
                   Material::kMetal, 1.5));
}

void add_pavements(Scene& scene, const MapLayers& layers) {
  for (const Street& street : layers.streets.streets) {
    if (!is_hidden(street) && street.width_m >= kPath_m)
      scene.add(line(street.line, street.width_m, tints::kPavement, Material::kConcrete));
  }
}

void add_gaps(Scene& scene, const MapLayers& layers) {
  const auto outline = [&](double width_m, double most_m2, Tint tint, Material material) {
    for (const Polygon& parcel : layers.parcels) {
      if (area_m2(parcel) > most_m2) continue;
      Polyline closed = parcel.outer;
      closed.push_back(closed.front());
      scene.add(line(std::move(closed), 2.0 * width_m, tint, material));
    }
  };
  outline(kGap_m, kTownPlot_m2, tints::kAsphalt, Material::kAsphalt);
  outline(kGapPavement_m, kTownPlot_m2, tints::kPavement, Material::kConcrete);
}

void add_carriageways(Scene& scene, const MapLayers& layers, std::uint64_t seed) {
  const std::vector<Street>& all = layers.streets.streets;
  const auto stream = [&](const Street& street, std::string_view what) {
    return Rng(derive_seed(seed, {seed_key(what), street.id.value}));
  };
  for (const Street& street : all) {
    if (is_hidden(street)) continue;
    const double width = carriageway_m(street.width_m);
    if (street.width_m < kPath_m) {
      scene.add(line(street.line, width, tints::kGravel, Material::kGravel));
    } else {
      scene.add(line(street.line, width + 2.0 * kKerb_m, tints::kConcrete, Material::kConcrete));
    }
  }
  for (const Street& street : all) {
    if (is_hidden(street) || street.width_m < kPath_m) continue;
    Rng rng = stream(street, "asphalt");
    const Tint asphalt = mix(tints::kAsphalt, tints::kOldAsphalt, rng.uniform(0.3, 0.7));
    scene.add(line(street.line, carriageway_m(street.width_m), asphalt, Material::kAsphalt));
  }
  const std::vector<double> radii = junction_radii(layers.streets);
  for (const Street& street : all) {
    if (is_hidden(street) || street.width_m < kPath_m) continue;
    Rng rng = stream(street, "markings");
    const double start = radii[street.from];
    const double end = radii[street.to];
    Markings markings(scene, street, start, end, rng);
    markings.add(start > 0.0, end > 0.0);
    markings.add_cars();
  }
}

void add_street_trees(Scene& scene, const MapLayers& layers, const PictureStyle& style,
                      std::uint64_t seed) {
  const std::vector<double> radii = junction_radii(layers.streets);
  for (const Street& street : layers.streets.streets) {
    const double carriageway = carriageway_m(street.width_m);
    if (is_hidden(street) || street.width_m - carriageway < 2.4) continue;
    Rng rng(derive_seed(seed, {seed_key("street trees"), street.id.value}));
    // Some streets are avenues, others are bare.
    const double fullness = std::max(0.0, rng.uniform(-0.2, style.is_dry() ? 0.5 : 0.85));
    const double end = length_m(street.line) - radii[street.to] - 6.0;
    for (const double side : {-1.0, 1.0}) {
      for (double at = radii[street.from] + 6.0; at < end; at += kTreePitch_m) {
        if (rng.uniform_01() >= fullness) continue;
        const Station s = station(street.line, at + rng.uniform(-1.5, 1.5));
        Tree tree;
        tree.place = s.place + side * (carriageway / 2.0 + 1.0) * perpendicular(s.along);
        tree.radius_m = rng.uniform(1.8, 4.2);
        tree.height_m = 1.4 * tree.radius_m + rng.uniform(1.5, 3.5);
        tree.tint = crown_tint(rng, style.climate);
        tree.variation = static_cast<std::uint32_t>(rng.index(1000000));
        scene.add(tree);
      }
    }
  }
}

}  // namespace plat::imagery

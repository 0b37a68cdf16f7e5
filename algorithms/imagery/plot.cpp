#include "imagery/plot.h"

#include <algorithm>
#include <limits>

#include "imagery/box_grid.h"
#include "streets/segment_index.h"

namespace plat::imagery {
namespace {

/// Farther from its middle than this a plot has no street.
constexpr double kStreetReach_m = 120.0;
constexpr double kLeastHouse_m2 = 22.0;
/// A plot of this area has a house and a garden; above it one large building; above the next
/// several.
constexpr double kHousePlot_m2 = 1300.0;
constexpr double kLargePlot_m2 = 5500.0;

streets::SegmentIndex street_index(const streets::StreetNetwork& network) {
  std::vector<Segment> segments;
  for (const streets::Street& street : network.streets) {
    for (std::size_t i = 0; i + 1 < street.line.size(); ++i)
      segments.push_back({street.line[i], street.line[i + 1]});
  }
  return streets::SegmentIndex(std::move(segments));
}

void find_front(Plot& plot, const streets::SegmentIndex& streets) {
  const Point middle = centroid(plot.shape);
  const auto hit = streets.nearest(middle, kStreetReach_m, [](std::uint32_t) { return true; });
  const Point u = plot.box.axis;
  const Point v = perpendicular(u);
  plot.front = -v;
  if (!hit) return;
  plot.has_front = true;
  const Point to_street = nearest_point(streets.segments()[hit->segment], middle) - middle;
  for (const Point side : {u, -u, v, -v}) {
    if (dot(side, to_street) > dot(plot.front, to_street)) plot.front = side;
  }
}

bool is_inside(const Polygon& shape, const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point next = ring[(i + 1) % ring.size()];
    if (locate(shape, ring[i]) == Side::kOutside ||
        locate(shape, midpoint(ring[i], next)) == Side::kOutside)
      return false;
  }
  return true;
}

/// The largest box of these proportions about `center` that lies on the plot.
Ring fitted_box(const Polygon& shape, Point center, Point along, double half_length,
                double half_width) {
  constexpr int kTries = 7;
  for (int i = 0; i < kTries; ++i) {
    const Point u = half_length * along;
    const Point v = half_width * perpendicular(along);
    Ring box{center - u - v, center + u - v, center + u + v, center - u + v};
    if (is_inside(shape, box)) return box;
    half_length *= 0.88;
    half_width *= 0.88;
  }
  return {};
}

void add_house(Plot& plot, Ring ring, double height_m) {
  const Polygon shape{std::move(ring), {}};
  if (shape.outer.size() < 3 || area_m2(shape) < kLeastHouse_m2) return;
  plot.buildings.push_back({shape, height_m, HeightSource::kAssumed});
}

void assume_one_house(Plot& plot, Rng& rng) {
  const Plot::Extent e = plot.extent();
  const double depth = e.front - e.back;
  const double width = e.left - e.right;
  const bool is_row = width < 7.5;
  const double setback = std::clamp(rng.uniform(0.06, 0.16) * depth, 1.0, 7.0);
  const double margin = is_row ? 0.1 : std::clamp(rng.uniform(0.08, 0.17) * width, 0.7, 4.0);
  const double house_width = std::min(width - 2.0 * margin, rng.uniform(9.0, 15.0));
  const double house_depth = std::min(rng.uniform(0.38, 0.55) * depth, rng.uniform(11.0, 18.0));
  const double side = (width - 2.0 * margin - house_width) * rng.uniform(-0.5, 0.5);
  const Point left = perpendicular(plot.front);
  const Point center = (e.front - setback - house_depth / 2.0) * plot.front +
                       ((e.left + e.right) / 2.0 + side) * left;
  const double height = rng.uniform(5.5, 10.0);
  add_house(plot, fitted_box(plot.shape, center, plot.front, house_depth / 2.0, house_width / 2.0),
            height);
  if (rng.uniform_01() > 0.45 || is_row) return;
  // A lower wing behind it.
  const double wing = rng.uniform(3.5, 6.0);
  const Point behind = center - (house_depth / 2.0 + wing / 2.0 - 0.3) * plot.front +
                       rng.uniform(-0.2, 0.2) * house_width * left;
  add_house(plot, fitted_box(plot.shape, behind, plot.front, wing / 2.0, 0.32 * house_width),
            0.6 * height);
}

void assume_large_buildings(Plot& plot, Rng& rng) {
  const Plot::Extent e = plot.extent();
  const double depth = e.front - e.back;
  const double width = e.left - e.right;
  const Point left = perpendicular(plot.front);
  const bool is_one = area_m2(plot.shape) < kLargePlot_m2;
  const double step = is_one ? std::max(depth, width) + 1.0 : rng.uniform(45.0, 75.0);
  const double fullness = rng.uniform(0.45, 1.0);
  const double height = is_one ? rng.uniform(8.0, 14.0) : rng.uniform(9.0, 24.0);
  for (double y = std::min(step, depth) / 2.0; y < depth; y += step) {
    for (double x = std::min(step, width) / 2.0; x < width; x += step) {
      if (!is_one && rng.uniform_01() > fullness) continue;
      const Point center = (e.back + y) * plot.front + (e.right + x) * left;
      const double half_depth = 0.5 * std::min(step, depth) * rng.uniform(0.5, 0.78);
      const double half_width = 0.5 * std::min(step, width) * rng.uniform(0.5, 0.78);
      add_house(plot, fitted_box(plot.shape, center, plot.front, half_depth, half_width),
                height * rng.uniform(0.7, 1.2));
    }
  }
}

}  // namespace

Plot::Extent Plot::extent() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extent e{kInfinity, -kInfinity, kInfinity, -kInfinity};
  const Point side = perpendicular(front);
  for (const Point p : shape.outer) {
    e.back = std::min(e.back, dot(p, front));
    e.front = std::max(e.front, dot(p, front));
    e.right = std::min(e.right, dot(p, side));
    e.left = std::max(e.left, dot(p, side));
  }
  return e;
}

bool Plot::is_built(Point p, double margin_m) const {
  return std::any_of(buildings.begin(), buildings.end(), [&](const Footprint& building) {
    return locate(building.shape, p) != Side::kOutside ||
           boundary_distance_m(building.shape, p) < margin_m;
  });
}

double Plot::built_m2() const {
  double sum = 0.0;
  for (const Footprint& building : buildings) sum += area_m2(building.shape);
  return sum;
}

std::vector<Plot> make_plots(const MapLayers& layers) {
  std::vector<Plot> plots;
  std::vector<Box> boxes;
  const streets::SegmentIndex streets = street_index(layers.streets);
  for (const Polygon& parcel : layers.parcels) {
    if (parcel.outer.size() < 3 || !(area_m2(parcel) > 1.0)) continue;
    Plot plot;
    plot.shape = parcel;
    plot.box = minimum_area_box(parcel);
    find_front(plot, streets);
    boxes.push_back(plat::box_of(parcel));
    plots.push_back(std::move(plot));
  }
  const BoxGrid grid(std::move(boxes));
  for (const Footprint& footprint : layers.footprints) {
    if (footprint.shape.outer.size() < 3 || !(area_m2(footprint.shape) > 0.0)) continue;
    const Point inside = interior_point(footprint.shape);
    for (const std::uint32_t i : grid.near({inside, inside})) {
      if (locate(plots[i].shape, inside) == Side::kOutside) continue;
      plots[i].buildings.push_back(footprint);
      break;
    }
  }
  return plots;
}

void assume_houses(std::vector<Plot>& plots, std::uint64_t seed) {
  for (std::size_t i = 0; i < plots.size(); ++i) {
    Plot& plot = plots[i];
    if (!plot.buildings.empty() || plot.box.width_m < 4.0) continue;
    Rng rng(derive_seed(seed, {seed_key("assumed house"), i}));
    if (area_m2(plot.shape) < kHousePlot_m2) {
      assume_one_house(plot, rng);
    } else {
      assume_large_buildings(plot, rng);
    }
  }
}

Ring clipped(const Ring& ring, Point normal, double limit) {
  Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    const double da = dot(a, normal) - limit;
    const double db = dot(b, normal) - limit;
    if (da <= 0.0) out.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) out.push_back(lerp(a, b, da / (da - db)));
  }
  return out;
}

}  // namespace plat::imagery

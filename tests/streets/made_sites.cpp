#include "streets/made_sites.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/box.h"
#include "core/planar_graph.h"
#include "core/validity.h"
#include "core/working_grid.h"
#include "support/synthetic_blocks.h"

namespace plat::testing {
namespace {

using streets::GrowthSite;
using streets::IntersectionPoint;
using streets::OpenEnd;
using streets::PassingStreet;
using streets::Street;
using streets::StreetNetwork;

constexpr std::size_t kMostVertices = 1000;

bool one_in(Rng& rng, std::uint64_t n) { return rng.index(n) == 0; }

Point unit_vector(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }
double random_angle_rad(Rng& rng) { return rng.uniform(0.0, 2.0 * std::numbers::pi); }
Point random_place(Rng& rng, double half_m) {
  return {rng.uniform(-half_m, half_m), rng.uniform(-half_m, half_m)};
}

/// The places of a grid of about `count` points around the origin.
std::vector<Point> grid(std::size_t count, double step_m) {
  const auto side = std::max<int>(1, static_cast<int>(std::sqrt(static_cast<double>(count))));
  std::vector<Point> out;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      out.push_back(step_m * Point{x - 0.5 * (side - 1), y - 0.5 * (side - 1)});
  return out;
}

std::vector<Point> places_of(Rng& rng, SiteFamily family, std::size_t count, double step_m) {
  const double half_m = 0.5 * step_m * std::sqrt(static_cast<double>(count));
  std::vector<Point> out;
  switch (family) {
    case SiteFamily::kJitteredGrid:
      out = grid(count, step_m);
      for (Point& p : out) p = p + random_place(rng, 0.2 * step_m);
      break;
    case SiteFamily::kExactGrid:
      out = grid(count, std::floor(step_m));
      break;
    case SiteFamily::kScattered:
      for (std::size_t i = 0; i < count; ++i) out.push_back(random_place(rng, half_m));
      break;
    case SiteFamily::kClustered: {
      std::vector<Point> centers;
      for (int i = 0; i < 4; ++i) centers.push_back(random_place(rng, 3.0 * half_m));
      for (std::size_t i = 0; i < count; ++i)
        out.push_back(centers[rng.index(4)] + random_place(rng, 0.3 * half_m));
      break;
    }
    case SiteFamily::kCollinear: {
      const Point step{std::floor(rng.uniform(-step_m, step_m)),
                       std::floor(rng.uniform(1, step_m))};
      for (std::size_t i = 0; i < count; ++i)
        out.push_back(static_cast<double>(rng.index(2 * count)) * (one_in(rng, 8) ? 0.5 : 1.0) *
                      step);
      break;
    }
    case SiteFamily::kNearCollinear: {
      const Point along = step_m * unit_vector(random_angle_rad(rng));
      for (std::size_t i = 0; i < count; ++i)
        out.push_back(static_cast<double>(i) * along + random_place(rng, 2.0 * kGridStep_m));
      break;
    }
    case SiteFamily::kCoincident:
      while (out.size() < count) {
        const Point place = random_place(rng, half_m);
        for (std::uint64_t k = 1 + rng.index(4); k > 0; --k) out.push_back(place);
      }
      break;
    case SiteFamily::kDense:
      for (std::size_t i = 0; i < count; ++i)
        out.push_back(kGridStep_m *
                      Point{static_cast<double>(rng.index(8)), static_cast<double>(rng.index(8))});
      break;
    case SiteFamily::kFewPoints:
      for (std::uint64_t k = rng.index(3); k > 0; --k) out.push_back(random_place(rng, half_m));
      break;
  }
  for (Point& p : out) p = snap(p);
  return out;
}

/// How the attributes of a whole site are drawn.
struct StyleRange {
  double distance_m = 80.0;
  int first_level = 0;
  int levels = 3;
  bool has_variances = true;
  bool is_curved = true;
};

StyleRange random_styles(Rng& rng, double distance_m) {
  StyleRange out;
  out.distance_m = distance_m;
  out.first_level = one_in(rng, 4) ? 3 : 0;
  out.levels = 1 + static_cast<int>(rng.index(4));
  out.has_variances = !one_in(rng, 4);
  out.is_curved = one_in(rng, 2);
  return out;
}

PassingStreet random_street(Rng& rng, const StyleRange& range) {
  PassingStreet out;
  out.hierarchy =
      range.first_level + static_cast<int>(rng.index(static_cast<std::uint64_t>(range.levels)));
  out.tortuosity = range.is_curved ? 1.0 + 0.5 * rng.uniform_01() * rng.uniform_01() : 1.0;
  out.distance_mean_m = range.distance_m * rng.uniform(0.7, 1.6);
  out.angle_mean_rad = rng.uniform(0.0, 0.4);
  if (range.has_variances && !one_in(rng, 6)) {
    out.distance_variance_m2 = std::pow(range.distance_m * rng.uniform(0.05, 0.7), 2);
    out.angle_variance_rad2 = std::pow(rng.uniform(0.02, 0.8), 2);
  }
  out.width_m = rng.uniform(4.0, 30.0);
  out.connections = one_in(rng, 5) ? 1 : 2;
  return out;
}

IntersectionPoint random_point(Rng& rng, Point place, const StyleRange& range) {
  IntersectionPoint out;
  out.place = place;
  out.a = random_street(rng, range);
  if (!one_in(rng, 5)) out.b = random_street(rng, range);
  if (out.b && out.b->hierarchy < out.a.hierarchy) std::swap(out.a, *out.b);
  if (one_in(rng, 2)) out.parcel_area_m2 = rng.uniform(100.0, 2000.0);
  return out;
}

/// The network of noded segments. Some nodes of two streets are taken out, so that streets have
/// bends.
StreetNetwork network_of(Rng& rng, const std::vector<Segment>& segments) {
  const PlanarGraph graph = node_segments(segments);
  std::vector<std::vector<std::uint32_t>> edges_at(graph.nodes.size());
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    edges_at[graph.edges[e].from].push_back(e);
    edges_at[graph.edges[e].to].push_back(e);
  }
  std::vector<bool> is_used(graph.edges.size(), false);
  std::vector<Polyline> lines;
  for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
    if (edges_at[n].size() != 2 || one_in(rng, 2)) continue;
    const std::uint32_t first = edges_at[n][0];
    const std::uint32_t second = edges_at[n][1];
    const auto far = [&](std::uint32_t e) {
      return graph.edges[e].from == n ? graph.edges[e].to : graph.edges[e].from;
    };
    if (is_used[first] || is_used[second] || far(first) == far(second)) continue;
    is_used[first] = is_used[second] = true;
    lines.push_back({graph.nodes[far(first)], graph.nodes[n], graph.nodes[far(second)]});
  }
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (!is_used[e])
      lines.push_back({graph.nodes[graph.edges[e].from], graph.nodes[graph.edges[e].to]});
  }
  StreetNetwork out;
  for (const Polyline& line : lines) {
    out.nodes.push_back(line.front());
    out.nodes.push_back(line.back());
  }
  std::ranges::sort(out.nodes);
  const auto [first, last] = std::ranges::unique(out.nodes);
  out.nodes.erase(first, last);
  const auto node = [&](Point p) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(out.nodes, p) - out.nodes.begin());
  };
  for (Polyline& line : lines) {
    Street street;
    street.id = StreetId{static_cast<std::uint32_t>(out.streets.size())};
    street.from = node(line.front());
    street.to = node(line.back());
    street.line = std::move(line);
    street.attributes.street_class = "residential";
    street.width_m = rng.uniform(5.0, 20.0);
    street.width_source = streets::WidthSource::kClass;
    street.source_id = "existing " + std::to_string(street.id.value);
    out.streets.push_back(std::move(street));
  }
  return out;
}

/// Streets from node to node whatever they cross, and a loop at a node.
void add_bridges(Rng& rng, StreetNetwork& network, double step_m) {
  const auto add = [&](std::uint32_t from, std::uint32_t to, Polyline line) {
    Street street = network.streets.front();
    street.id = StreetId{static_cast<std::uint32_t>(network.streets.size())};
    street.from = from;
    street.to = to;
    street.line = std::move(line);
    street.attributes.structure = streets::Structure::kBridge;
    network.streets.push_back(std::move(street));
  };
  if (network.streets.empty()) return;
  for (int i = 0; i < 3; ++i) {
    const auto from = static_cast<std::uint32_t>(rng.index(network.nodes.size()));
    const auto to = static_cast<std::uint32_t>(rng.index(network.nodes.size()));
    if (from != to) add(from, to, {network.nodes[from], network.nodes[to]});
  }
  const auto node = static_cast<std::uint32_t>(rng.index(network.nodes.size()));
  const Point at = network.nodes[node];
  add(node, node,
      {at, snap(at + Point{0.3 * step_m, 0.2 * step_m}), snap(at + Point{0.3 * step_m, -step_m}),
       at});
}

std::vector<Segment> existing_segments(Rng& rng, ExistingNetwork kind,
                                       const std::vector<Point>& places, const Box& box,
                                       double step_m) {
  std::vector<Segment> out;
  switch (kind) {
    case ExistingNetwork::kNone:
      break;
    case ExistingNetwork::kBeside: {
      const Point corner{box.min.x - 3.3 * step_m, box.min.y};
      const int rows = 1 + static_cast<int>(rng.index(4));
      for (int i = 0; i < rows; ++i) {
        const Point start = corner + i * step_m * Point{0.0, 1.0};
        out.push_back({start, start + rng.uniform(1.1, 3.2) * step_m * Point{1.0, 0.0}});
      }
      out.push_back({corner + step_m * Point{1.0, -0.5}, corner + step_m * Point{1.1, rows - 0.4}});
      break;
    }
    case ExistingNetwork::kAcross:
    case ExistingNetwork::kBridges:
      for (std::uint64_t k = 1 + rng.index(3); k > 0; --k) {
        Point at = box.center() + random_place(rng, box.width() + step_m);
        for (std::uint64_t n = 1 + rng.index(3); n > 0; --n) {
          const Point next =
              at + rng.uniform(0.5, 4.0) * step_m * unit_vector(random_angle_rad(rng));
          out.push_back({at, next});
          at = next;
        }
      }
      break;
    case ExistingNetwork::kThroughPoints:
      for (std::uint64_t k = 1 + rng.index(4); k > 0 && places.size() > 1; --k)
        out.push_back({places[rng.index(places.size())], places[rng.index(places.size())]});
      break;
  }
  for (Segment& s : out) s = {snap(s.a), snap(s.b)};
  std::erase_if(out, [](const Segment& s) { return s.a == s.b; });
  return out;
}

std::vector<OpenEnd> random_open_ends(Rng& rng, const StreetNetwork& network,
                                      const StyleRange& range) {
  std::vector<OpenEnd> out;
  const auto degrees = node_degrees(network);
  const auto add = [&](std::uint32_t node, Point from) {
    out.push_back({node, random_street(rng, range), normalized(network.nodes[node] - from)});
    if (one_in(rng, 10)) out.push_back(out.back());
  };
  for (const Street& street : network.streets) {
    const std::uint64_t rarity = degrees[street.from] == 1 ? 1 : 6;
    if (one_in(rng, rarity)) add(street.from, street.line[1]);
    const std::uint64_t rarity_to = degrees[street.to] == 1 ? 1 : 6;
    if (one_in(rng, rarity_to)) add(street.to, street.line[street.line.size() - 2]);
  }
  return out;
}

/// The polygon on the grid; none where it is not simple there.
std::optional<Polygon> admitted(const Polygon& raw) {
  auto out = admit_polygon(raw, kMostVertices);
  if (!out) return std::nullopt;
  return *std::move(out);
}

Ring box_ring(const Box& box) {
  return {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
}

std::optional<Polygon> random_boundary(Rng& rng, BoundaryKind kind,
                                       const std::vector<Point>& places, const Box& box,
                                       double step_m) {
  const double half_m = 0.5 * std::max(box.width(), box.height()) + step_m;
  switch (kind) {
    case BoundaryKind::kNone:
      break;
    case BoundaryKind::kAround:
      return admitted({box_ring(box.expanded(rng.uniform(-0.2, 0.6) * step_m)), {}});
    case BoundaryKind::kThroughPoints:
      return one_in(rng, 2) ? admitted({box_ring(box), {}}) : admitted({convex_hull(places), {}});
    case BoundaryKind::kStar:
      return admitted({star_ring(rng, 5 + static_cast<int>(rng.index(15)), 0.3 * half_m,
                                 1.3 * half_m, box.center()),
                       {}});
    case BoundaryKind::kHoles: {
      Polygon raw{box_ring(box.expanded(0.5 * step_m)), {}};
      Ring hole = star_ring(rng, 3 + static_cast<int>(rng.index(8)), 0.1 * half_m, 0.5 * half_m,
                            box.center());
      std::ranges::reverse(hole);
      raw.holes.push_back(std::move(hole));
      return admitted(raw);
    }
    case BoundaryKind::kExcludesAll:
      return admitted({box_ring(Box{box.max + Point{10.0 * step_m, 0.0},
                                    box.max + Point{12.0 * step_m, step_m}}),
                       {}});
  }
  return std::nullopt;
}

std::vector<Polygon> random_obstacles(Rng& rng, ObstacleKind kind, const std::vector<Point>& places,
                                      const Box& box, double step_m) {
  const double half_m = 0.5 * std::max(box.width(), box.height()) + step_m;
  std::vector<Polygon> raw;
  switch (kind) {
    case ObstacleKind::kNone:
      break;
    case ObstacleKind::kRiver: {
      const Point along = unit_vector(random_angle_rad(rng));
      const Point across = rng.uniform(0.05, 0.8) * step_m * perpendicular(along);
      Ring ring;
      for (int i = -3; i <= 3; ++i)
        ring.push_back(box.center() + 0.4 * i * half_m * along + (i % 2) * across);
      for (int i = 3; i >= -3; --i)
        ring.push_back(box.center() + 0.4 * i * half_m * along + (1 + i % 2) * across);
      raw.push_back({std::move(ring), {}});
      break;
    }
    case ObstacleKind::kScattered:
      for (std::uint64_t k = 1 + rng.index(4); k > 0; --k)
        raw.push_back({star_ring(rng, 3 + static_cast<int>(rng.index(6)), 0.1 * step_m, step_m,
                                 box.center() + random_place(rng, half_m)),
                       {}});
      break;
    case ObstacleKind::kIsland: {
      Ring hole = star_ring(rng, 6, 0.3 * half_m, 0.6 * half_m, box.center());
      std::ranges::reverse(hole);
      raw.push_back({star_ring(rng, 12, 0.7 * half_m, half_m, box.center()), {std::move(hole)}});
      break;
    }
    case ObstacleKind::kAtPoints:
      for (std::uint64_t k = 1 + rng.index(3); k > 0 && places.size() > 2; --k) {
        Polygon triangle;
        for (int i = 0; i < 3; ++i) triangle.outer.push_back(places[rng.index(places.size())]);
        raw.push_back(std::move(triangle));
      }
      break;
    case ObstacleKind::kCoversAll:
      raw.push_back({box_ring(box.expanded(step_m)), {}});
      break;
  }
  std::vector<Polygon> out;
  for (const Polygon& polygon : raw)
    if (auto good = admitted(polygon)) out.push_back(*std::move(good));
  return out;
}

/// None in half of the cases, else any of the others.
template <class Enum>
Enum random_kind(Rng& rng, Enum last) {
  if (one_in(rng, 2)) return Enum{};
  return static_cast<Enum>(1 + rng.index(static_cast<std::uint64_t>(last)));
}

}  // namespace

MadeSite made_site(std::uint64_t seed, std::uint32_t number, std::size_t most_points) {
  Rng rng(derive_seed(seed, {number}));
  MadeSite out;
  out.family = static_cast<SiteFamily>(number % kSiteFamilyNames.size());
  out.existing = random_kind(rng, ExistingNetwork::kBridges);
  out.boundary = random_kind(rng, BoundaryKind::kExcludesAll);
  out.obstacles = random_kind(rng, ObstacleKind::kCoversAll);

  const double step_m = rng.uniform(20.0, 150.0);
  std::vector<Point> places = places_of(rng, out.family, 3 + rng.index(most_points - 2), step_m);
  const Point shift = one_in(rng, 4) ? snap(random_place(rng, 200'000.0)) : Point{};
  for (Point& p : places) p = p + shift;
  Box box = box_of(places);
  if (places.empty()) box.add(shift);

  const StyleRange styles =
      random_styles(rng, out.family == SiteFamily::kDense ? 2.0 * kGridStep_m : step_m);
  for (const Point place : places) out.site.points.push_back(random_point(rng, place, styles));
  out.site.existing = network_of(rng, existing_segments(rng, out.existing, places, box, step_m));
  if (out.existing == ExistingNetwork::kBridges) add_bridges(rng, out.site.existing, step_m);
  out.site.open_ends = random_open_ends(rng, out.site.existing, styles);
  out.site.boundary = random_boundary(rng, out.boundary, places, box, step_m);
  out.site.obstacles = random_obstacles(rng, out.obstacles, places, box, step_m);
  return out;
}

GrowthSite made_town(std::uint64_t seed, Town town, std::size_t points) {
  constexpr double kStep_m = 80.0;
  Rng rng(derive_seed(seed, {points}));
  std::vector<Point> places = grid(points, kStep_m);
  const double half_m = 0.5 * kStep_m * std::sqrt(static_cast<double>(points));
  for (Point& p : places) {
    p = town == Town::kRegular ? p + random_place(rng, 0.1 * kStep_m) : random_place(rng, half_m);
    p = snap(p);
  }
  const StyleRange styles{.distance_m = kStep_m};
  GrowthSite out;
  for (const Point place : places) out.points.push_back(random_point(rng, place, styles));
  return out;
}

}  // namespace plat::testing

#include "imagery/imagery_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/failure.h"

namespace plat::imagery {
namespace {

/// Samples per column and direction for what is told of a warp's stretch.
constexpr int kStretchSamples = 6;
/// Samples along each side of the box for what a box warp shows beyond the source.
constexpr int kOutsideSamples = 24;

struct Weighted {
  double value;
  double weight;
};

double weighted_median(std::vector<Weighted>& values) {
  std::sort(values.begin(), values.end(),
            [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double all = 0.0;
  for (const Weighted& v : values) all += v.weight;
  double sum = 0.0;
  for (const Weighted& v : values) {
    sum += v.weight;
    if (2.0 * sum >= all) return v.value;
  }
  return values.back().value;
}

void measure_stretch(const WarpGrid& grid, ImageryRow& row) {
  const WarpMap map(grid);
  std::vector<Weighted> ratios;
  for (std::size_t k = 0; k < grid.target.size(); ++k) {
    const Quad& quad = grid.target[k];
    for (int i = 0; i < kStretchSamples; ++i) {
      for (int j = 0; j < kStretchSamples; ++j) {
        const double a = (i + 0.5) / kStretchSamples;
        const double b = (j + 0.5) / kStretchSamples;
        const Point along = lerp(quad[1] - quad[0], quad[2] - quad[3], b);
        const Point across = lerp(quad[3] - quad[0], quad[2] - quad[1], a);
        std::size_t column = k;
        const SourcePoint at = map.source_of(bilinear(quad, a, b), column);
        ratios.push_back({stretch_at(at).singular_ratio, cross(along, across)});
      }
    }
  }
  row.stretch_median = weighted_median(ratios);
  row.stretch_max = ratios.back().value;  // sorted
}

/// Only the box warp can leave the source.
double share_outside(const WarpGrid& grid, const ParcelShape& source, const ParcelShape& target) {
  if (grid.kind != WarpKind::kBox) return 0.0;
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < kOutsideSamples; ++i) {
    for (int j = 0; j < kOutsideSamples; ++j) {
      const double a = (i + 0.5) / kOutsideSamples;
      const double b = (j + 0.5) / kOutsideSamples;
      if (locate(target.polygon, bilinear(grid.target[0], a, b)) == Side::kOutside) continue;
      ++inside;
      if (locate(source.polygon, bilinear(grid.source[0], a, b)) == Side::kOutside) ++outside;
    }
  }
  return inside > 0 ? static_cast<double>(outside) / inside : 0.0;
}

ImageryRow row_of(const ParcelShape& target, const ParcelShape& source, const WarpGrid& grid) {
  ImageryRow row;
  row.area_log_difference = std::log(target.box.area_m2() / source.box.area_m2());
  row.aspect_log_difference = std::log(target.box.aspect_ratio() / source.box.aspect_ratio());
  row.is_target_monotone = is_monotone(target, ScanAxis::kMain);
  row.is_source_monotone = is_monotone(source, ScanAxis::kMain);
  row.area_ratio = area_m2(target.polygon) / area_m2(source.polygon);
  row.outside_01 = share_outside(grid, source, target);
  measure_stretch(grid, row);
  return row;
}

using SourceKey = std::pair<std::size_t, std::size_t>;  // example, parcel

/// Targets that show the same source, from west to east: the nearest is looked for in x.
void measure_repetition(std::span<const ParcelShape> targets, std::vector<std::size_t>& users,
                        std::vector<std::optional<ImageryRow>>& rows) {
  const auto centre = [&](std::size_t user) { return targets[user].box.center; };
  std::sort(users.begin(), users.end(),
            [&](std::size_t a, std::size_t b) { return centre(a) < centre(b); });
  for (std::size_t i = 0; i < users.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    const Point at = centre(users[i]);
    for (std::size_t j = i + 1; j < users.size() && centre(users[j]).x - at.x < nearest; ++j)
      nearest = std::min(nearest, distance(at, centre(users[j])));
    for (std::size_t j = i; j-- > 0 && at.x - centre(users[j]).x < nearest;)
      nearest = std::min(nearest, distance(at, centre(users[j])));
    ImageryRow& row = *rows[users[i]];
    row.uses = static_cast<std::uint32_t>(users.size());
    if (users.size() > 1) row.repeat_m = nearest;
  }
}

geodata::Layer grid_layer(std::string name, const geodata::LocalFrame& frame) {
  geodata::Layer layer;
  layer.name = std::move(name);
  layer.kind = geodata::GeometryKind::kPoint;
  layer.frame = frame;
  layer.fields = {{"parcel", geodata::FieldType::kText},
                  {"line", geodata::FieldType::kInteger},
                  {"sample", geodata::FieldType::kInteger}};
  return layer;
}

void add_points(geodata::Layer& layer, const std::string& parcel, std::span<const Point> points,
                std::size_t samples) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    geodata::Feature feature;
    feature.points.push_back(points[i]);
    feature.attributes = {parcel, static_cast<std::int64_t>(i / samples),
                          static_cast<std::int64_t>(i % samples)};
    layer.features.push_back(std::move(feature));
  }
}

}  // namespace

geodata::Layer target_grid_layer(const geodata::LocalFrame& frame,
                                 std::span<const ParcelShape> targets,
                                 std::span<const std::optional<ParcelImage>> plan,
                                 std::size_t lines, std::size_t samples) {
  geodata::Layer layer = grid_layer("target_grid", frame);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!plan[i]) continue;
    add_points(layer, targets[i].id, grid_samples(plan[i]->grid, lines, samples).target, samples);
  }
  return layer;
}

geodata::Layer source_grid_layer(const geodata::LocalFrame& frame,
                                 std::span<const ParcelShape> targets,
                                 std::span<const std::optional<ParcelImage>> plan,
                                 std::size_t example, std::size_t lines, std::size_t samples) {
  geodata::Layer layer = grid_layer(example == 0 ? "source_grid" : "source_grid2", frame);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!plan[i] || plan[i]->example != example) continue;
    add_points(layer, targets[i].id, grid_samples(plan[i]->grid, lines, samples).source, samples);
  }
  return layer;
}

std::string_view symmetry_name(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::kKept:
      return "kept";
    case Symmetry::kTurned:
      return "turned";
    case Symmetry::kMirroredAlong:
      return "mirrored_along";
    case Symmetry::kMirroredAcross:
      return "mirrored_across";
  }
  throw LogicError("a symmetry has no name");
}

std::vector<std::optional<ImageryRow>> imagery_rows(
    std::span<const ParcelShape> targets, std::span<const ImageExample> examples,
    std::span<const std::optional<ParcelImage>> plan, Jobs jobs) {
  expects(plan.size() == targets.size(), "the plan has an entry per target");
  auto rows = parallel_map<std::optional<ImageryRow>>(
      targets.size(), jobs, [&](std::size_t i) -> std::optional<ImageryRow> {
        if (!plan[i]) return std::nullopt;
        const ParcelShape& source = examples[plan[i]->example].parcels[plan[i]->match.example];
        return row_of(targets[i], source, plan[i]->grid);
      });
  std::map<SourceKey, std::vector<std::size_t>> users;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan[i]) users[{plan[i]->example, plan[i]->match.example}].push_back(i);
  }
  for (auto& [source, of_source] : users) measure_repetition(targets, of_source, rows);
  return rows;
}

geodata::Layer imagery_layer(const geodata::LocalFrame& frame, std::span<const ParcelShape> targets,
                             std::span<const ImageExample> examples,
                             std::span<const std::string> example_names,
                             std::span<const std::optional<ParcelImage>> plan,
                             std::span<const std::optional<ImageryRow>> rows) {
  using geodata::FieldType;
  geodata::Layer layer;
  layer.name = "imagery";
  layer.frame = frame;
  for (const char* name : {"parcel", "example", "source_parcel", "match", "symmetry", "warp"})
    layer.fields.push_back({name, FieldType::kText});
  for (const char* name : {"distance", "area_log_difference", "aspect_log_difference"})
    layer.fields.push_back({name, FieldType::kReal});
  for (const char* name : {"is_target_monotone", "is_source_monotone"})
    layer.fields.push_back({name, FieldType::kInteger});
  for (const char* name :
       {"stretch_median", "stretch_max", "area_ratio", "outside_01", "simplified_m"})
    layer.fields.push_back({name, FieldType::kReal});
  layer.fields.push_back({"uses", FieldType::kInteger});
  layer.fields.push_back({"repeat_m", FieldType::kReal});
  const auto whole = [](auto value) { return static_cast<std::int64_t>(value); };
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!plan[i]) continue;
    const ParcelImage& image = *plan[i];
    const ImageryRow& row = *rows[i];
    geodata::Feature feature;
    feature.polygons.push_back(targets[i].polygon);
    feature.attributes = {targets[i].id,
                          example_names[image.example],
                          examples[image.example].parcels[image.match.example].id,
                          std::string(match_level_name(image.match.level)),
                          std::string(symmetry_name(image.match.symmetry)),
                          std::string(warp_kind_name(image.grid.kind)),
                          image.match.distance,
                          row.area_log_difference,
                          row.aspect_log_difference,
                          whole(row.is_target_monotone),
                          whole(row.is_source_monotone),
                          row.stretch_median,
                          row.stretch_max,
                          row.area_ratio,
                          row.outside_01,
                          image.grid.simplified_m,
                          whole(row.uses),
                          row.repeat_m ? geodata::Attribute(*row.repeat_m) : geodata::Attribute()};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

}  // namespace plat::imagery

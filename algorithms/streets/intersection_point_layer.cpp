#include "streets/intersection_point_layer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "core/failure.h"
#include "core/working_grid.h"

namespace plat::streets {
namespace {

using geodata::Attribute;
using geodata::Feature;
using geodata::FieldType;
using geodata::GeometryKind;
using geodata::Layer;

constexpr double kAny = std::numeric_limits<double>::max();
/// Deeper orders of branching are a slip of the pen: real cities have under ten.
constexpr int kMaxHierarchy = 1000;
constexpr const char* kParcelArea = "parcel_area_m2";

template <class Value>
struct Column {
  std::string_view name;  ///< behind "a_" or "b_"
  Value PassingStreet::* member;
  Value min;
  Value max;
};

constexpr std::array kWholeColumns{
    Column<int>{"hierarchy", &PassingStreet::hierarchy, 0, kMaxHierarchy},
    Column<int>{"connections", &PassingStreet::connections, 1, 2}};
constexpr std::array kRealColumns{
    Column<double>{"tortuosity", &PassingStreet::tortuosity, 1.0, kAny},
    Column<double>{"distance_mean_m", &PassingStreet::distance_mean_m, 0.0, kAny},
    Column<double>{"distance_variance_m2", &PassingStreet::distance_variance_m2, 0.0, kAny},
    Column<double>{"angle_mean_rad", &PassingStreet::angle_mean_rad, 0.0, std::numbers::pi},
    Column<double>{"angle_variance_rad2", &PassingStreet::angle_variance_rad2, 0.0, kAny},
    Column<double>{"width_m", &PassingStreet::width_m, 0.0, kAny}};

constexpr std::size_t kColumnsPerStreet = kWholeColumns.size() + kRealColumns.size();

std::string column_name(char street, std::string_view name) {
  return fmt::format("{}_{}", street, name);
}

void add_fields(Layer& layer, char street) {
  for (const auto& column : kWholeColumns)
    layer.fields.push_back({column_name(street, column.name), FieldType::kInteger});
  for (const auto& column : kRealColumns)
    layer.fields.push_back({column_name(street, column.name), FieldType::kReal});
}

/// Sets a street's columns from `first` on; without a street they stay empty.
void set_values(Feature& feature, std::size_t first, const std::optional<PassingStreet>& street) {
  if (!street) return;
  for (const auto& column : kWholeColumns)
    feature.attributes[first++] = std::int64_t{*street.*column.member};
  for (const auto& column : kRealColumns) feature.attributes[first++] = *street.*column.member;
}

std::string allowed_text(double min, double max) {
  return max == kAny ? fmt::format("{} or more", min) : fmt::format("{}..{:.6g}", min, max);
}

/// The columns of a layer by name, with errors that say file, layer, feature and field.
class PointRows {
 public:
  PointRows(const Layer& layer, std::string_view file) : layer_(layer), file_(file) {}

  [[noreturn]] void refuse(const Feature& feature, std::string_view what) const {
    throw InputError(fmt::format("{}:{}: feature {}: {}", file_, layer_.name, feature.id, what));
  }

  /// @throws InputError where the layer has no such column
  [[nodiscard]] std::size_t index_of(std::string_view name) const {
    for (std::size_t i = 0; i < layer_.fields.size(); ++i) {
      if (layer_.fields[i].name == name) return i;
    }
    throw InputError(fmt::format("{}:{}: no field \"{}\"; docs/intersection_points.md lists them",
                                 file_, layer_.name, name));
  }

  [[nodiscard]] bool is_empty(const Feature& feature, std::string_view name) const {
    return std::holds_alternative<std::monostate>(feature.attributes[index_of(name)]);
  }

  [[nodiscard]] double real(const Feature& feature, std::string_view name, double min,
                            double max) const {
    const Attribute& value = feature.attributes[index_of(name)];
    double number = std::numeric_limits<double>::quiet_NaN();
    if (const auto* whole = std::get_if<std::int64_t>(&value))
      number = static_cast<double>(*whole);
    else if (const auto* given = std::get_if<double>(&value))
      number = *given;
    else if (const auto* text = std::get_if<std::string>(&value))
      refuse(feature, fmt::format("{} = \"{}\" is no number", name, *text));
    else
      refuse(feature, fmt::format("{} is empty, allowed {}", name, allowed_text(min, max)));
    if (!(number >= min && number <= max))
      refuse(feature, fmt::format("{} = {}, allowed {}", name, number, allowed_text(min, max)));
    return number;
  }

  [[nodiscard]] int whole(const Feature& feature, std::string_view name, int min, int max) const {
    const double number = real(feature, name, min, max);
    if (number != std::floor(number))
      refuse(feature, fmt::format("{} = {} must be a whole number", name, number));
    return static_cast<int>(number);
  }

  [[nodiscard]] PassingStreet street(const Feature& feature, char letter) const {
    PassingStreet out;
    for (const auto& column : kWholeColumns)
      out.*column.member = whole(feature, column_name(letter, column.name), column.min, column.max);
    for (const auto& column : kRealColumns)
      out.*column.member = real(feature, column_name(letter, column.name), column.min, column.max);
    return out;
  }

  /// Street b, or nothing where all its columns are empty.
  [[nodiscard]] std::optional<PassingStreet> other_street(const Feature& feature) const {
    bool has_any = false;
    const auto look = [&](const auto& column) {
      has_any = !is_empty(feature, column_name('b', column.name)) || has_any;
    };
    std::for_each(kWholeColumns.begin(), kWholeColumns.end(), look);
    std::for_each(kRealColumns.begin(), kRealColumns.end(), look);
    if (!has_any) return std::nullopt;
    return street(feature, 'b');
  }

  [[nodiscard]] Point place(const Feature& feature) const {
    if (feature.points.size() != 1) refuse(feature, "must be one point");
    const Point p = feature.points.front();
    if (!(std::abs(p.x) <= kGridExtent_m && std::abs(p.y) <= kGridExtent_m))
      refuse(feature, fmt::format("lies at ({}, {}) m, allowed up to {} m from the layer's middle",
                                  p.x, p.y, kGridExtent_m));
    return snap(p);
  }

 private:
  const Layer& layer_;
  std::string_view file_;
};

}  // namespace

Layer intersection_point_layer(std::span<const IntersectionPoint> points,
                               const geodata::LocalFrame& frame) {
  Layer layer{std::string(kPointLayerName), GeometryKind::kPoint, frame, {}, {}};
  add_fields(layer, 'a');
  add_fields(layer, 'b');
  layer.fields.push_back({kParcelArea, FieldType::kReal});
  layer.features.reserve(points.size());
  for (const IntersectionPoint& point : points) {
    Feature feature;
    feature.id = fmt::format("{}", layer.features.size() + 1);
    feature.points.push_back(point.place);
    feature.attributes.resize(layer.fields.size());
    set_values(feature, 0, point.a);
    set_values(feature, kColumnsPerStreet, point.b);
    if (point.parcel_area_m2) feature.attributes.back() = *point.parcel_area_m2;
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

std::vector<IntersectionPoint> intersection_points_of(const Layer& layer, std::string_view file) {
  if (layer.kind != GeometryKind::kPoint)
    throw InputError(fmt::format("{}:{}: holds {} features, not points", file, layer.name,
                                 geodata::kind_name(layer.kind)));
  const PointRows rows(layer, file);
  std::vector<IntersectionPoint> points;
  points.reserve(layer.features.size());
  for (const Feature& feature : layer.features) {
    IntersectionPoint point{rows.place(feature), rows.street(feature, 'a'),
                            rows.other_street(feature), std::nullopt};
    if (point.b && point.a.hierarchy > point.b->hierarchy) std::swap(point.a, *point.b);
    if (!rows.is_empty(feature, kParcelArea))
      point.parcel_area_m2 = rows.real(feature, kParcelArea, 0.0, kAny);
    points.push_back(point);
  }
  return points;
}

ReadPoints read_intersection_points(const geodata::LayerSource& source,
                                    const std::optional<geodata::LocalFrame>& frame) {
  geodata::LayerSource named = source;
  if (!named.layer) {
    const auto layers = geodata::list_layers(source.file);
    if (std::any_of(layers.begin(), layers.end(),
                    [](const auto& layer) { return layer.name == kPointLayerName; }))
      named.layer = std::string(kPointLayerName);
  }
  geodata::ReadOptions options;
  options.frame = frame;
  options.kind = GeometryKind::kPoint;
  const Layer layer = geodata::read_layer(named, options);
  return {layer.frame, intersection_points_of(layer, source.file)};
}

}  // namespace plat::streets

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "command.h"
#include "core/working_grid.h"
#include "geodata/layer_io.h"
#include "output_file.h"
#include "set_option.h"
#include "streets/intersection_point_layer.h"
#include "streets/random_walk_grower.h"
#include "streets/transition_survey.h"

namespace plat::cli {
namespace {

using streets::RandomWalkGrower;
using streets::StepBar;

struct Arguments {
  std::string points;
  std::string streets;
  std::size_t base = 0;
  std::string street = "a";
  std::optional<std::size_t> from;
  std::vector<std::string> settings;
  std::string out;
};

/// Points are numbered from 1, as features are.
std::uint32_t index_from(std::string_view flag, std::size_t number,
                         std::span<const streets::IntersectionPoint> points) {
  if (number < 1 || number > points.size())
    throw InputError(
        fmt::format("{} {}: no such point, allowed 1..{}", flag, number, points.size()));
  return static_cast<std::uint32_t>(number - 1);
}

streets::SurveyedStep step_from(const Arguments& args,
                                const std::vector<streets::IntersectionPoint>& points) {
  streets::SurveyedStep step{
      .base = index_from("--base", args.base, points), .street = {}, .heading = std::nullopt};
  const streets::IntersectionPoint& base = points[step.base];
  if (args.street == "b" && !base.b)
    throw InputError(fmt::format("--street b: point {} has one street only", args.base));
  step.street = args.street == "b" ? *base.b : base.a;
  if (args.from) step.heading = base.place - points[index_from("--from", *args.from, points)].place;
  return step;
}

/// The lines as streets, cut where one passes a point.
streets::StreetNetwork network_of(const geodata::Layer& lines,
                                  std::span<const streets::IntersectionPoint> points) {
  std::set<Point> places;
  for (const streets::IntersectionPoint& point : points) places.insert(point.place);
  streets::StreetNetwork network;
  for (const geodata::Feature& feature : lines.features) {
    for (const Polyline& line : feature.lines) {
      Polyline piece;
      for (std::size_t i = 0; i < line.size(); ++i) {
        const Point p = snap(line[i]);
        if (piece.empty() || piece.back() != p) piece.push_back(p);
        const bool ends_here = i + 1 == line.size() || places.contains(p);
        if (!ends_here || piece.size() < 2) continue;
        streets::Street street;
        street.line = std::exchange(piece, {p});
        network.streets.push_back(std::move(street));
      }
    }
  }
  for (const streets::Street& street : network.streets) {
    network.nodes.push_back(street.line.front());
    network.nodes.push_back(street.line.back());
  }
  std::sort(network.nodes.begin(), network.nodes.end());
  network.nodes.erase(std::unique(network.nodes.begin(), network.nodes.end()), network.nodes.end());
  const auto node_at = [&](Point p) {
    return static_cast<std::uint32_t>(
        std::lower_bound(network.nodes.begin(), network.nodes.end(), p) - network.nodes.begin());
  };
  for (streets::Street& street : network.streets) {
    street.from = node_at(street.line.front());
    street.to = node_at(street.line.back());
  }
  return network;
}

geodata::Layer target_layer(const streets::ReadPoints& read,
                            std::span<const streets::SurveyedTarget> targets) {
  geodata::Layer layer{
      .name = "targets",
      .kind = geodata::GeometryKind::kPoint,
      .frame = read.frame,
      .fields = {{"probability", geodata::FieldType::kReal}, {"bar", geodata::FieldType::kText}},
      .features = {}};
  for (std::size_t i = 0; i < targets.size(); ++i) {
    geodata::Feature feature;
    feature.id = std::to_string(i + 1);
    feature.points = {read.points[i].place};
    feature.attributes = {targets[i].probability,
                          std::string(streets::step_bar_name(targets[i].bar))};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

ExitStatus run(const Arguments& args) {
  expect_output(args.out, {args.points, args.streets});
  const auto options = from_option_map<RandomWalkGrower::Options>(
      RandomWalkGrower::kName, options_from_settings(args.settings));
  const streets::ReadPoints read =
      streets::read_intersection_points(geodata::parse_layer_source(args.points));
  streets::GrowthSite site;
  site.points = read.points;
  if (!args.streets.empty()) {
    const geodata::Layer lines =
        geodata::read_layer(geodata::parse_layer_source(args.streets),
                            {.frame = read.frame, .kind = geodata::GeometryKind::kLine});
    site.existing = network_of(lines, site.points);
  }
  const auto targets =
      streets::survey_targets(site, step_from(args, read.points), options.threshold,
                              {options.distance, options.angle, options.min_distance_deviation_m,
                               options.min_angle_deviation_rad});
  if (!targets) throw InputError(fmt::format("{}: {}", args.points, targets.error().message));
  geodata::write_layers(args.out, std::array{target_layer(read, *targets)});
  std::map<std::string_view, int> counts;
  for (const streets::SurveyedTarget& target : *targets)
    ++counts[streets::step_bar_name(target.bar)];
  for (const auto& [bar, count] : counts) fmt::print("{}: {}\n", bar, count);
  return kDone;
}

}  // namespace

void add_transitions_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "transitions",
      "Look from one intersection point at all others, as a step of the random walk does: how\n"
      "probable each is, and what bars it (level, improbable, connections, crossing)\n"
      "[AVB08, Fig. 5a]. Writes the layer targets, one feature per point, in their order.");
  command
      ->add_option("points", arguments->points,
                   "FILE[:layer], points as plat exemplar writes them "
                   "(docs/intersection_points.md)")
      ->required();
  command->add_option("--base", arguments->base, "number of the base point, from 1")->required();
  command->add_option("--out", arguments->out, "GeoPackage to write")->required();
  command->add_option("--street", arguments->street, "which of its streets steps")
      ->check(CLI::IsMember({"a", "b"}));
  command->add_option("--from", arguments->from,
                      "number of the point from which the street came; none: its first step");
  command->add_option("--streets", arguments->streets,
                      "FILE[:layer], streets that are there: they take connections and bar ways");
  command
      ->add_option("--set", arguments->settings,
                   "option of random_walk, key=value; may be repeated (plat list strategies)")
      ->take_all();
  command->footer(
      "Example:\n  plat transitions points.gpkg --base 17 --from 12 --out targets.gpkg\n"
      "Exit status: 0 done, 2 bad input.");
  command->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace plat::cli

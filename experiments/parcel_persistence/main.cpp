// Which parcels keep their identity when streets are edited: README.md.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/atomic_file.h"
#include "core/progress.h"
#include "editing/editor.h"
#include "harness/city.h"
#include "harness/config_reader_internal.h"
#include "harness/csv.h"
#include "harness/experiment_program.h"
#include "parcel_persistence/persistence.h"
#include "parcels/block_subdivider.h"
#include "statistics/quantile.h"

namespace plat::persistence {
namespace {

using editing::City;
using editing::CityNode;
using editing::CityStreet;
using editing::Edit;
using editing::NodeId;
using nlohmann::json;

struct Config {
  std::string dataset;
  std::vector<std::string> strategies;
  std::vector<std::string> kinds;
  std::vector<double> sizes_m;
  int edits = 60;
  int resamples = 1000;
  std::uint64_t seed = 1;
};

/// What edits choose from: junctions, and streets long enough to be seen.
struct Targets {
  std::vector<NodeId> junctions;
  std::vector<StreetId> streets;
};

Targets targets_of(const City& city) {
  constexpr double kShortest_m = 20.0;
  Targets out;
  city.nodes().for_each([&](NodeId id, const CityNode& node) {
    if (node.around.size() > 2) out.junctions.push_back(id);
  });
  city.streets().for_each([&](StreetId id, const CityStreet& street) {
    if (length_m(street.line) >= kShortest_m) out.streets.push_back(id);
  });
  return out;
}

/// A way to edit: what is drawn depends on the stream only, so that every strategy meets the same.
using Draw = Edit (*)(const City&, const Targets&, double size_m, Rng&);

Point direction(Rng& rng) {
  const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
  return {std::cos(angle), std::sin(angle)};
}

constexpr double kNeighbourhood_m = 150.0;

std::vector<NodeId> neighbourhood(const City& city, Point middle) {
  std::vector<NodeId> out;
  city.nodes().for_each([&](NodeId id, const CityNode& node) {
    if (distance(node.position, middle) <= kNeighbourhood_m) out.push_back(id);
  });
  return out;
}

Edit move_node(const City& city, const Targets& targets, double size_m, Rng& rng) {
  const NodeId node = targets.junctions[rng.index(targets.junctions.size())];
  return editing::MoveNode{node, city.nodes().at(node).position + size_m * direction(rng), 0.0};
}

Edit move_street(const City&, const Targets& targets, double size_m, Rng& rng) {
  const StreetId street = targets.streets[rng.index(targets.streets.size())];
  return editing::MoveStreet{street, size_m * direction(rng)};
}

Edit bend_street(const City& city, const Targets& targets, double size_m, Rng& rng) {
  const StreetId id = targets.streets[rng.index(targets.streets.size())];
  const Polyline& line = city.streets().at(id).line;
  const Point along = line.back() - line.front();
  const double side = rng.index(2) == 0 ? 1.0 : -1.0;
  // Both control points so far off that the curve's middle is size_m off.
  const Point off = side * (size_m / 0.75) * perpendicular(normalized(along));
  return editing::BendStreet{
      id, editing::Curve{line.front() + along / 3.0 + off, line.back() - along / 3.0 + off}};
}

Edit set_street_width(const City& city, const Targets& targets, double size_m, Rng& rng) {
  const StreetId id = targets.streets[rng.index(targets.streets.size())];
  return editing::SetStreetWidth{id, city.streets().at(id).width_m + size_m};
}

Edit scale_nodes(const City& city, const Targets& targets, double size_m, Rng& rng) {
  const NodeId node = targets.junctions[rng.index(targets.junctions.size())];
  const Point middle = city.nodes().at(node).position;
  return editing::ScaleNodes{neighbourhood(city, middle), middle, 1.0 - size_m / kNeighbourhood_m};
}

Edit rotate_nodes(const City& city, const Targets& targets, double size_m, Rng& rng) {
  const NodeId node = targets.junctions[rng.index(targets.junctions.size())];
  const Point middle = city.nodes().at(node).position;
  return editing::RotateNodes{neighbourhood(city, middle), middle, size_m / kNeighbourhood_m};
}

constexpr std::array<std::pair<std::string_view, Draw>, 6> kDraws{{
    {"move_node", move_node},
    {"move_street", move_street},
    {"bend_street", bend_street},
    {"set_street_width", set_street_width},
    {"scale_nodes", scale_nodes},
    {"rotate_nodes", rotate_nodes},
}};

Draw draw_named(std::string_view name) {
  for (const auto& [known, draw] : kDraws) {
    if (known == name) return draw;
  }
  throw InputError(fmt::format("no kind of edit \"{}\"", name));
}

/// One edit of one strategy.
struct Row {
  std::string status = "ok";
  std::size_t blocks = 0;    ///< changed, and there before and after
  std::size_t unusable = 0;  ///< of them, without a warp or undivided
  std::array<Persistence, kMatchings.size()> by_matching;
};

Row run_edit(editing::Editor& editor, const Edit& edit) {
  Row row;
  const City before = editor.city();
  const auto report = editor.apply(edit);
  if (!report) {
    row.status = failure_name(report.error().code);
    return row;
  }
  for (const BlockId id : report->changed) {
    ++row.blocks;
    const auto result = persistence_of(before.blocks().at(id), editor.city().blocks().at(id));
    if (!result) {
      ++row.unusable;
      continue;
    }
    for (std::size_t m = 0; m < kMatchings.size(); ++m) row.by_matching[m] += (*result)[m];
  }
  editor.undo();
  return row;
}

using Measure = double (*)(const Persistence&);
struct MeasureRatio {
  std::string_view name;
  Measure part;
  Measure whole;
};
constexpr std::array<MeasureRatio, 5> kMeasures{{
    {"survivors", [](const Persistence& p) { return p.survivors; },
     [](const Persistence& p) { return p.old_parcels; }},
    {"identity", [](const Persistence& p) { return p.recognised; },
     [](const Persistence& p) { return p.survivors; }},
    {"ids_kept", [](const Persistence& p) { return p.kept; },
     [](const Persistence& p) { return p.old_parcels; }},
    {"transfer", [](const Persistence& p) { return p.transferred; },
     [](const Persistence& p) { return p.new_parcels; }},
    {"iou", [](const Persistence& p) { return p.iou; },
     [](const Persistence& p) { return p.new_parcels; }},
}};

/// The ratio of sums over the edits drawn; nullopt where there is nothing to divide by.
std::optional<double> ratio(std::span<const Row* const> rows, std::size_t matching,
                            const MeasureRatio& measure) {
  double part = 0.0;
  double whole = 0.0;
  for (const Row* row : rows) {
    part += measure.part(row->by_matching[matching]);
    whole += measure.whole(row->by_matching[matching]);
  }
  if (whole <= 0.0) return std::nullopt;
  return part / whole;
}

class Experiment {
 public:
  Experiment(Config config, Jobs jobs) : config_(std::move(config)), jobs_(jobs) {}

  void run(const streets::StreetNetwork& network) {
    const std::size_t cells = config_.strategies.size();
    rows_.resize(cells);
    Progress progress("parcel_persistence", cells * config_.kinds.size() * config_.sizes_m.size());
    parallel_for(cells, jobs_, [&](std::size_t s) {
      editing::CityOptions options;
      options.style.strategy = config_.strategies[s];
      options.seed = config_.seed;
      options.jobs.count = 1;
      editing::Editor editor(editing::make_city(network, options));
      const Targets targets = targets_of(editor.city());
      for (const std::string& kind : config_.kinds) {
        for (const double size_m : config_.sizes_m) {
          for (int e = 0; e < config_.edits; ++e) {
            // Without the size: the same places are edited more and more.
            Rng rng(derive_seed(config_.seed, {seed_key(kind), static_cast<std::uint64_t>(e)}));
            rows_[s].push_back(
                run_edit(editor, draw_named(kind)(editor.city(), targets, size_m, rng)));
          }
          progress.step();
        }
      }
    });
  }

  [[nodiscard]] std::string edits_csv() const {
    harness::CsvTable table(
        "strategy,kind,size_m,edit,matching,status,blocks,unusable_blocks,old_parcels,new_parcels,"
        "survivors,recognised,ids_kept,transferred,iou_sum");
    for_each_cell(
        [&](std::size_t s, const std::string& kind, double size_m, std::span<const Row> rows) {
          for (std::size_t e = 0; e < rows.size(); ++e) {
            for (std::size_t m = 0; m < kMatchings.size(); ++m) {
              const Persistence& p = rows[e].by_matching[m];
              table.add_row(config_.strategies[s], kind, size_m, e,
                            parcels::matching_name(kMatchings[m]), rows[e].status, rows[e].blocks,
                            rows[e].unusable, p.old_parcels, p.new_parcels, p.survivors,
                            p.recognised, p.kept, p.transferred, p.iou);
            }
          }
        });
    return table.text();
  }

  [[nodiscard]] std::string summary_csv() const {
    harness::CsvTable table(
        "strategy,kind,size_m,matching,measure,value,ci_low,ci_high,edits,refused");
    for_each_cell(
        [&](std::size_t s, const std::string& kind, double size_m, std::span<const Row> all) {
          std::vector<const Row*> rows;
          for (const Row& row : all) {
            if (row.status == "ok" && row.blocks > row.unusable) rows.push_back(&row);
          }
          const auto refused =
              std::count_if(all.begin(), all.end(), [](const Row& r) { return r.status != "ok"; });
          for (std::size_t m = 0; m < kMatchings.size(); ++m) {
            for (const MeasureRatio& measure : kMeasures)
              add_summary(table, s, kind, size_m, m, measure, rows, refused);
          }
        });
    return table.text();
  }

 private:
  template <class Visit>
  void for_each_cell(Visit visit) const {
    for (std::size_t s = 0; s < config_.strategies.size(); ++s) {
      std::size_t first = 0;
      const auto count = static_cast<std::size_t>(config_.edits);
      for (const std::string& kind : config_.kinds) {
        for (const double size_m : config_.sizes_m) {
          visit(s, kind, size_m, std::span(rows_[s]).subspan(first, count));
          first += count;
        }
      }
    }
  }

  /// Edits are resampled, with all their parcels; every measure and matching by the same draws.
  void add_summary(harness::CsvTable& table, std::size_t s, const std::string& kind, double size_m,
                   std::size_t m, const MeasureRatio& measure, std::span<const Row* const> rows,
                   std::ptrdiff_t refused) const {
    constexpr double kLevel_01 = 0.95;
    const std::optional<double> value = ratio(rows, m, measure);
    std::optional<statistics::Interval> interval;
    Rng rng(derive_seed(config_.seed, {seed_key("bootstrap"), seed_key(kind)}));
    std::vector<double> replicates;
    std::vector<const Row*> drawn(rows.size());
    for (int r = 0; r < config_.resamples && value; ++r) {
      for (const Row*& row : drawn) row = rows[rng.index(rows.size())];
      if (const auto replicate = ratio(drawn, m, measure)) replicates.push_back(*replicate);
    }
    if (!replicates.empty()) interval = statistics::percentile_interval(replicates, kLevel_01);
    table.add_row(config_.strategies[s], kind, size_m, parcels::matching_name(kMatchings[m]),
                  measure.name, value, interval ? std::optional(interval->low) : std::nullopt,
                  interval ? std::optional(interval->high) : std::nullopt, rows.size(), refused);
  }

  Config config_;
  Jobs jobs_;
  std::vector<std::vector<Row>> rows_;  // per strategy: kinds, sizes, edits
};

std::vector<std::string> names_in(harness::ObjectReader& reader, std::string_view key,
                                  const std::string& source) {
  const json* list = reader.find(key);
  std::vector<std::string> out;
  if (list != nullptr && list->is_array()) {
    for (const json& name : *list) {
      if (name.is_string()) out.push_back(name.get<std::string>());
    }
  }
  if (out.empty() || out.size() != list->size())
    throw InputError(fmt::format("{}: \"{}\" must be a list of names", source, key));
  return out;
}

Config parse_config(const json& object, const std::string& file) {
  harness::ObjectReader reader(object, file);
  static_cast<void>(reader.text("experiment", ""));
  static_cast<void>(reader.text("question", ""));
  Config out;
  out.dataset = geodata::dataset(reader.text("dataset", "")).name;
  out.strategies = names_in(reader, "strategies", file);
  for (const std::string& name : out.strategies)
    static_cast<void>(parcels::block_subdividers().at(name));
  out.kinds = names_in(reader, "kinds", file);
  for (const std::string& name : out.kinds) static_cast<void>(draw_named(name));
  const json* sizes = reader.find("sizes_m");
  for (const json& size : sizes != nullptr ? *sizes : json::array()) {
    if (!size.is_number() || !(size.get<double>() > 0.0 && size.get<double>() <= 100.0))
      throw InputError(file + ": \"sizes_m\" must be numbers above 0, up to 100");
    out.sizes_m.push_back(size.get<double>());
  }
  if (out.sizes_m.empty()) throw InputError(file + ": \"sizes_m\" must be a list of numbers");
  out.edits = static_cast<int>(reader.whole("edits", out.edits, 1, 100000));
  out.resamples = static_cast<int>(reader.whole("resamples", out.resamples, 1, 100000));
  out.seed = static_cast<std::uint64_t>(reader.whole("seed", 1, 0, 1LL << 53));
  reader.expect_nothing_else();
  return out;
}

bool run(const harness::ProgramCall& call) {
  const Config config = parse_config(call.config, call.config_file);
  harness::City city = harness::load_city(geodata::dataset(config.dataset), call.jobs);
  Experiment experiment(config, call.jobs);
  experiment.run(city.network);
  std::filesystem::create_directories(call.out);
  write_file(call.out / "edits.csv", experiment.edits_csv());
  write_file(call.out / "summary.csv", experiment.summary_csv());
  harness::write_manifest(call);
  return true;
}

}  // namespace
}  // namespace plat::persistence

int main(int argc, char** argv) {
  return plat::harness::run_program(
      argc, argv,
      {.name = "parcel_persistence",
       .question = "Which parcels keep their identity when streets are edited (README.md)",
       .trouble = "",
       .run = plat::persistence::run});
}

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "command.h"
#include "geodata/dataset_catalogue.h"
#include "harness/experiment_config.h"
#include "parcels/block_subdivider.h"
#include "sequences/sequence_search.h"
#include "similarity/shape_similarity.h"
#include "streets/street_grower.h"

namespace plat::cli {
namespace {

using nlohmann::json;

json field_json(const FieldDescription& field) {
  json out{{"name", field.name}, {"type", field.type}, {"description", field.description}};
  std::visit([&](const auto& value) { out["default"] = value; }, field.default_value);
  if (field.type == "choice") {
    out["choices"] = field.choices;
  } else {
    out["min"] = field.min;
    out["max"] = field.max;
  }
  return out;
}

/// Calls `visit(family, how, menu)` for each family of strategies.
template <class Visit>
void for_each_family(Visit visit) {
  visit("block_subdivider", "Block subdivision (plat subdivide --strategy NAME --set key=value)",
        parcels::block_subdividers());
  visit("sequence_search", "Search of sequences (plat search --method NAME --set key=value)",
        sequences::sequence_searches());
  visit("shape_similarity", "Shape similarity (plat similarity --measure NAME --set key=value)",
        similarity::shape_similarities());
  visit("street_grower", "Street growth (plat synthesize SCRIPT.json, whose \"grower\" names one)",
        streets::street_growers());
}

template <class Menu>
void print_menu(std::string_view how, const Menu& menu) {
  fmt::print("{}:\n", how);
  for (const std::string& name : menu.names()) {
    fmt::print("\n  {}: {}\n", name, menu.at(name).summary);
    for (const FieldDescription& field : menu.at(name).fields) {
      const std::string range = field.type == "choice"
                                    ? fmt::format("{}", fmt::join(field.choices, " | "))
                                    : fmt::format("{:g}..{:g}", field.min, field.max);
      fmt::print("    {:<18} {:<12} [{}]  {}\n", field.name, to_string(field.default_value), range,
                 field.description);
    }
  }
}

void list_strategies(bool as_json) {
  json out = json::array();
  std::string_view gap;
  for_each_family([&](std::string_view family, std::string_view how, const auto& menu) {
    if (!as_json) {
      fmt::print("{}", std::exchange(gap, "\n"));
      print_menu(how, menu);
      return;
    }
    for (const std::string& name : menu.names()) {
      json fields = json::array();
      for (const FieldDescription& field : menu.at(name).fields)
        fields.push_back(field_json(field));
      out.push_back({{"family", family},
                     {"name", name},
                     {"summary", menu.at(name).summary},
                     {"options", fields}});
    }
  });
  if (as_json) fmt::print("{}\n", out.dump(1));
}

void list_datasets(bool as_json) {
  if (as_json) {
    json out = json::array();
    for (const geodata::Dataset& d : geodata::catalogue()) {
      out.push_back({{"name", d.name},
                     {"title", d.title},
                     {"plots", d.observed ? plot_origin_name(d.observed->plots) : "none"},
                     {"is_present", geodata::locate(d).has_value()}});
    }
    fmt::print("{}\n", out.dump(1));
    return;
  }
  fmt::print("Data sets, looked for under {} (plat data list says more):\n",
             geodata::data_dir().string());
  for (const geodata::Dataset& d : geodata::catalogue()) {
    fmt::print("  {:<20} {:<11} {:<8} {}\n", d.name,
               d.observed ? plot_origin_name(d.observed->plots) : "none",
               geodata::locate(d) ? "present" : "missing", d.title);
  }
}

void list_experiments(bool as_json) {
  if (as_json) {
    json out = json::array();
    for (const auto& e : harness::list_experiments())
      out.push_back({{"name", e.name}, {"question", e.question}, {"is_program", e.is_program}});
    fmt::print("{}\n", out.dump(1));
    return;
  }
  const auto print_those = [](bool are_programs) {
    for (const auto& e : harness::list_experiments()) {
      if (e.is_program == are_programs)
        fmt::print("  {:<24} {}\n", e.name, e.question.empty() ? "its README tells" : e.question);
    }
  };
  fmt::print("Experiments (plat run NAME --out DIR):\n");
  print_those(false);
  fmt::print("Programs of their own, beside plat (NAME --help):\n");
  print_those(true);
}

}  // namespace

void add_list_command(CLI::App& app, Action& action) {
  struct Arguments {
    std::string what;
    bool as_json = false;
  };
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "list",
      "What there is to choose from: strategies with their options, data sets, experiments");
  command->add_option("what", args->what, "strategies, datasets or experiments")
      ->required()
      ->check(CLI::IsMember({"strategies", "datasets", "experiments"}));
  command->add_flag("--json", args->as_json,
                    "for programs: a JSON list with names, defaults, ranges");
  command->footer("Example:\n  plat list strategies --json\nExit status: 0 done, 2 bad input.");
  command->callback([args, &action] {
    action = [args]() -> ExitStatus {
      if (args->what == "strategies") list_strategies(args->as_json);
      if (args->what == "datasets") list_datasets(args->as_json);
      if (args->what == "experiments") list_experiments(args->as_json);
      return kDone;
    };
  });
}

}  // namespace plat::cli

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "core/failure.h"
#include "geodata/dataset_catalogue.h"
#include "geodata/dataset_fetch.h"

namespace plat::cli {
namespace {

using geodata::Dataset;
using nlohmann::ordered_json;

bool is_here(const Dataset& set) { return geodata::locate(set).has_value(); }

std::string_view fetch_name(const Dataset& set) {
  if (std::holds_alternative<geodata::FetchManually>(set.fetch)) return "manual";
  return set.is_fetch_verified ? "automatic" : "automatic, untried";
}

std::string_view plots_name(const Dataset& set) {
  return set.observed ? geodata::plot_origin_name(set.observed->plots) : "none";
}

ordered_json to_json(const Dataset& set) {
  ordered_json out{{"name", set.name},          {"title", set.title},
                   {"contents", set.contents},  {"crs", set.crs},
                   {"licence", set.licence},    {"attribution", set.attribution},
                   {"source", set.source},      {"plots", plots_name(set)},
                   {"fetch", fetch_name(set)},  {"fetch_note", set.fetch_note},
                   {"is_present", is_here(set)}};
  for (const geodata::DatasetFile& file : set.files)
    out["files"].push_back({{"path", file.path}, {"sha256", file.sha256}});
  out["layers"] = ordered_json::array();
  for (const geodata::DatasetLayer& layer : set.layers) {
    out["layers"].push_back({{"file", layer.file},
                             {"name", layer.name},
                             {"kind", geodata::kind_name(layer.kind)},
                             {"features", layer.feature_count}});
  }
  out["observed"] = ordered_json::object();
  if (!set.observed) return out;
  const auto add = [&](const char* theme, const std::optional<geodata::LayerMapping>& mapping) {
    if (!mapping) return;
    out["observed"][theme] = {{"layer", mapping->layer},
                              {"where", mapping->where},
                              {"fields", mapping->fields},
                              {"settings", mapping->settings}};
  };
  add("parcels", set.observed->parcels);
  add("streets", set.observed->streets);
  add("footprints", set.observed->footprints);
  add("blocks", set.observed->blocks);
  return out;
}

std::string layer_summary(const Dataset& set) {
  std::string out;
  for (const geodata::DatasetLayer& layer : set.layers)
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", layer.name, layer.feature_count);
  return out;
}

ExitStatus list(bool is_json) {
  if (is_json) {
    ordered_json out = ordered_json::array();
    for (const Dataset& set : geodata::catalogue()) out.push_back(to_json(set));
    fmt::print("{}\n", out.dump(2));
    return kDone;
  }
  for (const Dataset& set : geodata::catalogue()) {
    fmt::print("{}  {}\n", set.name, is_here(set) ? "[present]" : "[absent]");
    fmt::print("  {}\n  {}\n", set.title, set.contents);
    if (!set.layers.empty()) fmt::print("  layers   {}\n", layer_summary(set));
    fmt::print("  plots    {}\n  licence  {}; {}\n  source   {} ({})\n", plots_name(set),
               set.licence, set.attribution, set.source, fetch_name(set));
  }
  fmt::print("data folder: {}\n", geodata::data_dir().string());
  return kDone;
}

ExitStatus fetch(const std::string& name, const std::string& to) {
  const Dataset& set = geodata::dataset(name);
  const std::filesystem::path folder = to.empty() ? geodata::data_dir() : std::filesystem::path(to);
  const std::vector<std::string> written = geodata::fetch(set, folder);
  if (written.empty()) fmt::print("{}: already there and unchanged\n", name);
  for (const std::string& file : written) fmt::print("{}\n", (folder / file).string());
  fmt::print("{}: {}; {}\n", name, set.licence, set.attribution);
  return kDone;
}

ExitStatus check(const std::vector<std::string>& names) {
  std::vector<const Dataset*> sets;
  sets.reserve(geodata::catalogue().size());
  for (const std::string& name : names) sets.push_back(&geodata::dataset(name));
  if (names.empty()) {
    for (const Dataset& set : geodata::catalogue()) {
      if (is_here(set)) sets.push_back(&set);
    }
    fmt::print("{} of {} data sets are in {}\n", sets.size(), geodata::catalogue().size(),
               geodata::data_dir().string());
  }
  bool is_good = true;
  for (const Dataset* set : sets) {
    for (const geodata::FileCheck& file : geodata::check(*set)) {
      fmt::print("{:<8} {}\n", geodata::file_state_name(file.state), file.path);
      is_good = is_good && file.is_good();
    }
  }
  return is_good ? kDone : kFinishedWithFailures;
}

}  // namespace

void add_data_command(CLI::App& app, Action& action) {
  struct Arguments {
    bool is_json = false;
    std::string name;
    std::string to;
    std::vector<std::string> names;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "data",
      "The data sets that Plat knows: list them, fetch one from its public source, check the "
      "files.\n"
      "Files are looked for under PLAT_DATA_DIR, else ~/.local/share/plat.\n"
      "Exit status: 0 done, 1 a checked file is missing or differs, 2 bad input.\n"
      "Example: plat data fetch san_francisco_us");
  command->require_subcommand(1);

  CLI::App* list_command = command->add_subcommand(
      "list",
      "Name every data set with its layers (feature counts), licence and public source, and "
      "whether\n"
      "it is in the data folder. `plots` says where its plots come from: observed (a cadastre),\n"
      "tessellated (from footprints, there is no cadastre) or none.\n"
      "Exit status: 0 done.\n"
      "Example: plat data list --json");
  list_command->add_flag("--json", arguments->is_json, "everything the catalogue says, as JSON");
  list_command->callback(
      [arguments, &action] { action = [arguments] { return list(arguments->is_json); }; });

  CLI::App* fetch_command = command->add_subcommand(
      "fetch",
      "Get a data set from its public source, verify its checksum and put it into the data "
      "folder.\n"
      "Files that are there and unchanged are left alone. san_francisco_us needs npm; the others\n"
      "need GDAL to reach their address. A set that cannot be fetched says where to get it.\n"
      "Exit status: 0 done, 2 not reachable, wrong checksum, or no automatic way.\n"
      "Example: plat data fetch san_francisco_us --to ~/plat_data");
  fetch_command->add_option("name", arguments->name, "data set, see `plat data list`")->required();
  fetch_command->add_option("--to", arguments->to,
                            "data folder to put it into (default: PLAT_DATA_DIR, else\n"
                            "~/.local/share/plat)");
  fetch_command->callback([arguments, &action] {
    action = [arguments] { return fetch(arguments->name, arguments->to); };
  });

  CLI::App* check_command = command->add_subcommand(
      "check",
      "Compare files with the catalogue's checksums: ok, derived (made by `fetch` from the right\n"
      "source, unchanged since), missing or differs. Without names, all sets in the data folder.\n"
      "Exit status: 0 all good, 1 a file is missing or differs, 2 unknown name.\n"
      "Example: plat data check cambridge_ma monaco_mc");
  check_command->add_option("names", arguments->names, "data sets, see `plat data list`");
  check_command->callback(
      [arguments, &action] { action = [arguments] { return check(arguments->names); }; });
}

}  // namespace plat::cli

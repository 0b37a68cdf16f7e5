#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "buildings/part_database.h"
#include "buildings/part_kits.h"
#include "command.h"

namespace plat::cli {
namespace {

using buildings::Part;
using buildings::PartClass;
using buildings::PartDatabase;
using nlohmann::ordered_json;

std::size_t face_count(const PartDatabase& database) {
  std::size_t count = 0;
  for (const Part& part : database.parts()) count += part.mesh.faces.size();
  return count;
}

void print_summary(const PartDatabase& database) {
  fmt::print("{}: {} parts, {} sections, {} transitions, {} triangles; {}\n", database.info().name,
             database.parts().size(), database.sections().size(), database.transition_count(),
             face_count(database), database.info().origin);
  for (const PartDatabase::Scaling& scaling : database.scalings())
    fmt::print("  {}: length times {:.4f}, to a multiple of {} m\n", scaling.part, scaling.factor,
               buildings::kLengthQuantum_m);
}

std::string class_text(const Part& part) {
  const std::string name(name_of(part.shape.part_class));
  if (part.shape.part_class == PartClass::kCorner)
    return fmt::format("{} {:+.4g}", name, part.shape.angle_rad * 180.0 / std::numbers::pi);
  if (part.shape.part_class == PartClass::kTee)
    return fmt::format("{} {}", name, name_of(part.shape.stem_side));
  return name;
}

ordered_json to_json(const PartDatabase& database) {
  ordered_json out{{"name", database.info().name},
                   {"summary", database.info().summary},
                   {"origin", database.info().origin},
                   {"transitions", database.transition_count()},
                   {"parts", ordered_json::array()}};
  for (std::size_t i = 0; i < database.parts().size(); ++i) {
    const Part& part = database.parts()[i];
    ordered_json entry{{"name", part.name},
                       {"class", name_of(part.shape.part_class)},
                       {"triangles", part.mesh.faces.size()},
                       {"attributes", part.attributes},
                       {"ports", ordered_json::array()}};
    for (std::size_t port = 0; port < part.ports.size(); ++port) {
      entry["ports"].push_back({{"role", name_of(part.ports[port].role)},
                                {"arm_m", part.ports[port].arm_m},
                                {"section", database.section_of({i, port})},
                                {"section_area_m2", area_m2(part.ports[port].section)}});
    }
    out["parts"].push_back(std::move(entry));
  }
  return out;
}

ExitStatus make(const std::string& kit, const std::string& out, const std::string& ending) {
  const PartDatabase database = buildings::make_part_kit(kit);
  write_part_database(database, out, "." + ending);
  print_summary(database);
  return kDone;
}

ExitStatus list(const std::string& folder, bool is_json) {
  const PartDatabase database = buildings::read_part_database(folder);
  if (is_json) {
    fmt::print("{}\n", to_json(database).dump(2));
    return kDone;
  }
  print_summary(database);
  for (std::size_t i = 0; i < database.parts().size(); ++i) {
    const Part& part = database.parts()[i];
    std::string sections;
    for (std::size_t port = 0; port < part.ports.size(); ++port)
      sections +=
          fmt::format(" {}:{}", name_of(part.ports[port].role), database.section_of({i, port}));
    std::string attributes;
    for (const auto& [name, value] : part.attributes)
      attributes += fmt::format(" {}={:.6g}", name, value);
    fmt::print("{:<28} {:<14}{} |{}\n", part.name, class_text(part), sections, attributes);
  }
  return kDone;
}

}  // namespace

void add_parts_command(CLI::App& app, Action& action) {
  struct Arguments {
    std::string kit;
    std::string out;
    std::string ending = "ply";
    std::string folder;
    bool is_json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "parts",
      "Databases of building parts: make a synthetic one, list what one holds, your own included\n"
      "(docs/part_database.md).\n"
      "Exit status: 0 done, 2 bad input.\n"
      "Example: plat parts make townhouse --out parts/townhouse");
  command->require_subcommand(1);

  std::string kits;
  for (const buildings::KitSummary& kit : buildings::part_kits())
    kits += fmt::format("  {:<10} {}\n", kit.name, kit.summary);
  CLI::App* make_command = command->add_subcommand(
      "make",
      "Generate a kit of parts (synthetic; same kit, same bytes) and write it: parts.json, a mesh\n"
      "per part, transitions.json. A folder that holds a part database is replaced, another one\n"
      "must be empty. Kits:\n" +
          kits +
          "Exit status: 0 done, 2 unknown kit, or the folder cannot be written.\n"
          "Example: plat parts make palazzo --out parts/palazzo --format obj");
  make_command->add_option("kit", arguments->kit, "kit to generate")->required();
  make_command->add_option("--out", arguments->out, "folder to write")->required();
  make_command
      ->add_option("--format", arguments->ending, "of the meshes: ply, obj (with .mat) or off")
      ->check(CLI::IsMember({"ply", "obj", "off"}))
      ->capture_default_str();
  make_command->callback([arguments, &action] {
    action = [arguments] { return make(arguments->kit, arguments->out, arguments->ending); };
  });

  CLI::App* list_command = command->add_subcommand(
      "list",
      "Read a part database, check it, and print every part with its class, the number of the "
      "cross\n"
      "section at each of its ports, and its attributes. Ports with the same number fit without\n"
      "cost. Parts that were off the length quantum are named with the factor they were scaled "
      "by.\n"
      "Exit status: 0 done, 2 a file is missing or bad, or transitions.json is of other parts.\n"
      "Example: plat parts list parts/palazzo");
  list_command->add_option("folder", arguments->folder, "folder with parts.json")->required();
  list_command->add_flag("--json", arguments->is_json, "as JSON, with section areas");
  list_command->callback([arguments, &action] {
    action = [arguments] { return list(arguments->folder, arguments->is_json); };
  });
}

}  // namespace plat::cli

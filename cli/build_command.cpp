#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>

#include "buildings/building_synthesis.h"
#include "buildings/building_writer.h"
#include "buildings/part_kits.h"
#include "command.h"
#include "core/options.h"
#include "diagnosis_output.h"
#include "sequences/diagnosis.h"
#include "sequences/sequence_search.h"
#include "set_option.h"

namespace plat::cli {
namespace {

namespace fs = std::filesystem;
using buildings::Building;
using buildings::PreparedBuilding;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string design;
  std::string parts;
  std::string out;
  std::string method = "layered";
  std::vector<std::string> settings;
  std::size_t k = 1;
};

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A folder, or the name of a kit.
buildings::PartDatabase parts_of(const std::string& name) {
  if (fs::is_directory(name)) return buildings::read_part_database(name);
  std::vector<std::string_view> kits;
  for (const auto& kit : buildings::part_kits()) kits.push_back(kit.name);
  if (std::find(kits.begin(), kits.end(), name) != kits.end())
    return buildings::make_part_kit(name);
  throw InputError(fmt::format("--parts {}: neither a folder with parts nor a kit; kits: {}", name,
                               fmt::join(kits, ", ")));
}

/// The file of the i-th best: FILE.glb, FILE_2.glb ...
fs::path file_of(const fs::path& out, std::size_t i) {
  if (i == 0) return out;
  return out.parent_path() /
         fmt::format("{}_{}{}", out.stem().string(), i + 1, out.extension().string());
}

void expect_building_file(const std::string& out) {
  if (!buildings::is_building_file(out))
    throw InputError(fmt::format("--out {}: must end in .obj, .ply or .glb", out));
  const fs::path folder = fs::path(out).parent_path();
  if (!folder.empty() && !fs::is_directory(folder))
    throw InputError(fmt::format("--out {}: there is no folder {}", out, folder.string()));
}

void write_report(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw InputError(fmt::format("{}: cannot be written", file.string()));
}

/// @returns whether the mesh is closed
bool write_solution(const PreparedBuilding& prepared, const sequences::SequencePath& path,
                    const std::string& name, const fs::path& file) {
  const Building building = buildings::realise(prepared, path);
  buildings::write_building(file, building.assembled.mesh, name);
  fs::path report = file;
  write_report(report.replace_extension(".json"), buildings::report_of(prepared, building, name));
  const auto surface = buildings::inspect_surface(building.assembled.mesh);
  fmt::print("{}: {} parts, sections disagree by {:.2f} m2; {} faces in {} shells, {}\n",
             file.string(), building.placed.parts.size(), building.assembled.wall_area_m2,
             surface.face_count, surface.shell_count,
             surface.is_watertight()
                 ? "watertight"
                 : fmt::format("NOT watertight: {} edges", surface.unmatched_edge_count));
  return surface.is_watertight();
}

ExitStatus run(const Arguments& args) {
  expect_building_file(args.out);
  const buildings::BuildingDesign design = buildings::read_building_design(args.design);
  const sequences::AnySequenceSearch search =
      sequences::sequence_searches().make(args.method, options_from_settings(args.settings));
  const buildings::PartDatabase parts = parts_of(args.parts);
  const auto start = Clock::now();
  const PreparedBuilding prepared = buildings::prepare(design, parts);
  const double prepare_ms = milliseconds_since(start);
  const auto search_start = Clock::now();
  const std::clock_t clock_start = std::clock();
  auto stream = search.search(prepared.compiled.graph);
  const auto paths =
      stream ? sequences::find_paths(**stream, args.k) : tl::unexpected<Failure>(stream.error());
  const double search_ms = milliseconds_since(search_start);
  const double processor_ms =
      1e3 * static_cast<double>(std::clock() - clock_start) / CLOCKS_PER_SEC;
  if (!paths) {
    fmt::print("{}: {}: {}\n", args.design, failure_name(paths.error().code),
               paths.error().message);
    return kFinishedWithFailures;
  }
  fmt::print(
      "{} elements, {} transitions, {} nodes in {} zones; prepared in {:.1f} ms, {} in {:.1f} ms "
      "({:.1f} ms of processor)\n",
      prepared.problem.problem.database.elements.size(),
      prepared.problem.problem.database.transitions.size(), prepared.compiled.graph.node_count(),
      prepared.compiled.graph.zones.size(), prepare_ms, args.method, search_ms, processor_ms);
  if (paths->empty()) {
    const auto& problem = prepared.problem.problem;
    const auto diagnosis = sequences::diagnose(prepared.compiled, problem);
    fmt::print("{}: no building: no parts of \"{}\" fill it within its bounds\n{}\n", args.design,
               parts.info().name, diagnosis_text(problem, diagnosis));
    return kFinishedWithFailures;
  }
  if (paths->size() < args.k)
    fmt::print("there are {} buildings, {} were asked for\n", paths->size(), args.k);
  bool are_closed = true;
  for (std::size_t i = 0; i < paths->size(); ++i)
    are_closed &= write_solution(prepared, (*paths)[i], design.name, file_of(args.out, i));
  return are_closed ? kDone : kFinishedWithFailures;
}

}  // namespace

void add_build_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "build", "Make a building of parts: along a skeleton, around a block, or floor by floor");
  command->add_option("design", args->design, "JSON file with the design (docs/building_design.md)")
      ->required();
  command
      ->add_option("--parts", args->parts,
                   "folder with a part database (docs/part_database.md), or the name of a kit")
      ->required();
  command
      ->add_option("--out", args->out,
                   "FILE.obj, FILE.ply or FILE.glb to write; FILE.json beside it says what was "
                   "built; the second best is FILE_2")
      ->required();
  command->add_option("--k", args->k, "how many of the best buildings")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--method", args->method, "how to search (plat list strategies)")
      ->capture_default_str();
  command->add_option("--set", args->settings, "option of the method, key=value; may be repeated")
      ->take_all();
  command->footer(
      "Example:\n  plat build design.json --parts townhouse --out house.glb\n"
      "Parts follow each other at the cost of the area by which their cross sections disagree; "
      "the\n"
      "cheapest buildings are found, ties in the order of the method. An edge is rounded to 0.2 m\n"
      "and its parts are stretched to fill it.\n"
      "Exit status: 0 done, 1 no building or a mesh that is not closed, 2 bad input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli

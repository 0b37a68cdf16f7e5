#include "harness/experiment_program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "core/atomic_file.h"
#include "core/failure.h"
#include "harness/build_info.h"
#include "harness/json_file.h"

namespace plat::harness {
namespace {

constexpr int kMostThreads = 1024;

std::string help_text(const ExperimentProgram& program) {
  return fmt::format("{}\nExample: {} --out out/{}\nExit status: 0 done, {}2 bad input",
                     program.question, program.name, program.name,
                     program.trouble.empty() ? "" : fmt::format("1 {}, ", program.trouble));
}

}  // namespace

int run_program(int argc, char** argv, const ExperimentProgram& program) {
  CLI::App app{help_text(program), program.name};
  ProgramCall call;
  call.config_file = (experiments_folder() / program.name / "config.json").string();
  app.add_option("--config", call.config_file, "what to run")->capture_default_str();
  app.add_option("--out", call.out, "folder for the tables and manifest.json")->required();
  app.add_option("--jobs", call.jobs.count, "threads, 0 = all cores; results do not depend on it")
      ->check(CLI::Range(0, kMostThreads));
  if (program.add_options) program.add_options(app);
  CLI11_PARSE(app, argc, argv);
  try {
    call.config = read_json(call.config_file);
    return program.run(call) ? 0 : 1;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: {}\n", program.name, error.what());
    return 2;
  }
}

void write_manifest(const ProgramCall& call, const nlohmann::json& more) {
  nlohmann::json manifest{{"build", build_info()}, {"config", call.config}};
  manifest.update(more);
  std::filesystem::create_directories(call.out);
  write_file(call.out / "manifest.json", manifest.dump(2) + "\n");
}

}  // namespace plat::harness

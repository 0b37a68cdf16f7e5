#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "command.h"
#include "core/failure.h"
#include "harness/build_info.h"

namespace plat::cli {
namespace {

/// Runs a program without a shell, so that no path needs quoting. @returns its exit status
int run_program(const std::filesystem::path& program, const std::filesystem::path& script,
                const std::string& argument) {
  const pid_t child = fork();
  if (child == 0) {
    execl(program.c_str(), program.c_str(), script.c_str(), argument.c_str(),
          static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0)
    throw InputError("the report's Python could not be started");
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "report", "Make report.html and figures/*.{pdf,png} from what a run wrote");
  command->add_option("dir", *folder, "folder that plat run or plat compare wrote")->required();
  command->footer(
      "Example:\n  plat report out/cambridge\nExit status: 0 done, 2 bad input (a file of the run "
      "is missing).");
  command->callback([folder, &action] {
    action = [folder]() -> ExitStatus {
      const std::filesystem::path script =
          harness::experiments_folder() / "report" / "make_report.py";
      if (!std::filesystem::exists(script))
        throw InputError(script.string() +
                         ": missing; set PLAT_EXPERIMENTS_DIR to Plat's experiments folder");
      if (!std::filesystem::exists(std::filesystem::path(*folder) / "manifest.json")) {
        throw InputError(
            *folder + "/manifest.json: missing: not a folder that plat run or plat compare wrote");
      }
      const int status = run_program(PLAT_PYTHON, script, *folder);
      if (status == 127)
        throw InputError(std::string(PLAT_PYTHON) +
                         ": not found: apt install python3-matplotlib python3-geopandas");
      return status == 0 ? kDone : kBadInput;
    };
  });
}

}  // namespace plat::cli

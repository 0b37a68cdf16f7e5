#include <filesystem>
#include <memory>
#include <vector>

#include "command.h"
#include "core/failure.h"
#include "harness/build_info.h"
#include "python_script.h"

namespace plat::cli {

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
      return run_python(script, std::vector{*folder}) == 0 ? kDone : kBadInput;
    };
  });
}

}  // namespace plat::cli

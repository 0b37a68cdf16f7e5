#include <fmt/format.h>

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
  auto worst = std::make_shared<int>(6);
  CLI::App* command = app.add_subcommand(
      "report", "Make report.html and figures/*.{pdf,png} from what a run wrote");
  command->add_option("dir", *folder, "folder that plat run or plat compare wrote")->required();
  command
      ->add_option("--worst", *worst,
                   "blocks to show, observed beside generated, where each strategy is farthest off")
      ->capture_default_str()
      ->check(CLI::Range(1, 200));
  command->footer(
      "Example:\n  plat report out/cambridge\nExit status: 0 done, 2 bad input (a file of the run "
      "is missing).");
  command->callback([folder, worst, &action] {
    action = [folder, worst]() -> ExitStatus {
      const std::filesystem::path script =
          harness::experiments_folder() / "report" / "make_report.py";
      if (!std::filesystem::exists(script))
        throw InputError(script.string() +
                         ": missing; set PLAT_EXPERIMENTS_DIR to Plat's experiments folder");
      if (!std::filesystem::exists(std::filesystem::path(*folder) / "manifest.json")) {
        throw InputError(
            *folder + "/manifest.json: missing: not a folder that plat run or plat compare wrote");
      }
      const std::vector arguments{*folder, std::string("--worst"), fmt::format("{}", *worst)};
      return run_python(script, arguments) == 0 ? kDone : kBadInput;
    };
  });
}

}  // namespace plat::cli

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "command.h"
#include "core/failure.h"

int main(int argc, char** argv) {
  CLI::App app{
      "Plat: example-based urban layout synthesis, compared with observed parcels.\n"
      "Exit status: 0 done, 1 finished with failures listed, 2 bad input."};
  app.name("plat");
  app.set_version_flag("--version", PLAT_VERSION);
  app.require_subcommand(1);
  plat::cli::Action action;
  plat::cli::add_list_command(app, action);
  plat::cli::add_data_command(app, action);
  plat::cli::add_blocks_command(app, action);
  plat::cli::add_subdivide_command(app, action);
  plat::cli::add_compare_command(app, action);
  plat::cli::add_run_command(app, action);
  plat::cli::add_report_command(app, action);
  try {
    app.parse(argc, argv);
    return action();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? plat::cli::kDone : plat::cli::kBadInput;
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "plat: {}\n", error.what());
    return plat::cli::kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "plat: internal error: {}\n", error.what());
    return 3;
  }
}

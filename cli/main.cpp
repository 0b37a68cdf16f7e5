#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "command.h"
#include "core/failure.h"
#include "core/options.h"

namespace {

/// What CLI11 says of wrong arguments, on one line, with the command whose help says it right.
void print_usage_error(const CLI::App& app, std::string_view first, const CLI::ParseError& error) {
  std::string what = error.what();
  if (app.get_subcommands().empty() && !first.empty() && first.front() != '-') {
    std::vector<std::string_view> known;
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
    what = fmt::format("no command \"{}\"{}", first, plat::did_you_mean(first, known));
  }
  for (char& c : what) {
    if (c == '\n') c = ' ';
  }
  std::string command = "plat";
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    command += " " + at->get_name();
  }
  fmt::print(stderr, "plat: {}; {} --help says more\n", what, command);
}

}  // namespace

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
  plat::cli::add_tiles_command(app, action);
  plat::cli::add_exemplar_command(app, action);
  plat::cli::add_subdivide_command(app, action);
  plat::cli::add_synthesize_command(app, action);
  plat::cli::add_edit_command(app, action);
  plat::cli::add_reconfigure_command(app, action);
  plat::cli::add_compare_command(app, action);
  plat::cli::add_measures_command(app, action);
  plat::cli::add_run_command(app, action);
  plat::cli::add_report_command(app, action);
  plat::cli::add_figure_command(app, action);
  plat::cli::add_parts_command(app, action);
  plat::cli::add_search_command(app, action);
  plat::cli::add_build_command(app, action);
  plat::cli::add_transitions_command(app, action);
  plat::cli::add_imagery_command(app, action);
  plat::cli::add_orthophoto_command(app, action);
  plat::cli::add_similarity_command(app, action);
  try {
    app.parse(argc, argv);
    return action();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help or version was asked for
    print_usage_error(app, argc > 1 ? argv[1] : "", error);
    return plat::cli::kBadInput;
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "plat: {}\n", error.what());
    return plat::cli::kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "plat: internal error: {}\n", error.what());
    return 3;
  }
}

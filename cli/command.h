#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace plat::cli {

/// How the program ends. Bad input is thrown as InputError, which main turns into kBadInput.
enum ExitStatus { kDone = 0, kFinishedWithFailures = 1, kBadInput = 2 };

/// Adds one subcommand with its options, help and example; its callback stores what to do in
/// `action`.
using Action = std::function<ExitStatus()>;
void add_data_command(CLI::App& app, Action& action);
void add_list_command(CLI::App& app, Action& action);
void add_blocks_command(CLI::App& app, Action& action);
void add_tiles_command(CLI::App& app, Action& action);
void add_exemplar_command(CLI::App& app, Action& action);
void add_subdivide_command(CLI::App& app, Action& action);
void add_edit_command(CLI::App& app, Action& action);
void add_reconfigure_command(CLI::App& app, Action& action);
void add_synthesize_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_run_command(CLI::App& app, Action& action);
void add_report_command(CLI::App& app, Action& action);
void add_figure_command(CLI::App& app, Action& action);
void add_parts_command(CLI::App& app, Action& action);
void add_search_command(CLI::App& app, Action& action);
void add_build_command(CLI::App& app, Action& action);
void add_measures_command(CLI::App& app, Action& action);
void add_transitions_command(CLI::App& app, Action& action);
void add_imagery_command(CLI::App& app, Action& action);
void add_orthophoto_command(CLI::App& app, Action& action);
void add_similarity_command(CLI::App& app, Action& action);

}  // namespace plat::cli

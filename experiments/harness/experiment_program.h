#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/parallel.h"

namespace plat::harness {

/// What the program of an experiment is asked for.
struct ProgramCall {
  nlohmann::json config;  ///< of --config: experiments/<name>/config.json where not given
  std::string config_file;
  std::filesystem::path out;  ///< --out; made by write_manifest() or write_file()'s caller
  Jobs jobs;                  ///< --jobs
};

/// An experiment that `plat run` cannot express: experiments/<name>/main.cpp.
struct ExperimentProgram {
  std::string name;      ///< of its folder
  std::string question;  ///< the first lines of --help
  std::string trouble;   ///< what exit status 1 means; empty where there is none
  /// @returns whether everything worked; a city that was skipped or a cell that failed did not
  std::function<bool(const ProgramCall&)> run;
  std::function<void(CLI::App&)> add_options{};  ///< further options, if any
};

/// The whole main(): exit status 0 done, 1 finished with trouble, 2 bad input.
int run_program(int argc, char** argv, const ExperimentProgram& program);

/// manifest.json: {"build", "config"} and what `more` adds, so that every table beside it can be
/// traced to code and config.
void write_manifest(const ProgramCall& call, const nlohmann::json& more = nlohmann::json::object());

}  // namespace plat::harness

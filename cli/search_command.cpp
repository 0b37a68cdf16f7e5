#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "command.h"
#include "core/options.h"
#include "core/progress.h"
#include "diagnosis_output.h"
#include "graph_output.h"
#include "sequence_output.h"
#include "sequences/problem_file.h"
#include "set_option.h"

namespace plat::cli {
namespace {

using nlohmann::ordered_json;
using sequences::CompiledProblem;
using sequences::SearchStatistics;
using sequences::SequencePath;
using sequences::SequenceProblem;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string problem;
  std::string method = "layered";
  std::vector<std::string> settings;
  std::size_t k = 1;
  bool as_json = false;
  std::string out;
  std::string graph;
  std::vector<std::string> relaxed;
};

/// More sequences than this are long work.
constexpr std::size_t kProgressFrom = 10'000;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// How a search went.
struct Outcome {
  std::size_t found = 0;
  bool is_everything = false;  ///< there is no further sequence
  std::optional<Failure> failure;
  SearchStatistics statistics;
  double graph_ms = 0.0;
  double first_ms = 0.0;  ///< the first sequence's search
  double total_ms = 0.0;
};

template <class Write>
Outcome search(const sequences::AnySequenceSearch& method, const CompiledProblem& compiled,
               std::size_t k, Write write) {
  Outcome outcome;
  const auto start = Clock::now();
  const auto stream = method.search(compiled.graph);
  outcome.graph_ms = milliseconds_since(start);
  if (!stream) {
    outcome.failure = stream.error();
    return outcome;
  }
  Progress progress("sequences", k,
                    k >= kProgressFrom ? Progress::Style::kAutomatic : Progress::Style::kQuiet);
  SequencePath path;
  while (outcome.found < k) {
    const auto more = (*stream)->next(path);
    if (outcome.found == 0) outcome.first_ms = milliseconds_since(start) - outcome.graph_ms;
    if (!more) outcome.failure = more.error();
    outcome.is_everything = more && !*more;
    if (!more || !*more) break;
    write(path, ++outcome.found);
    progress.step();
  }
  outcome.statistics = (*stream)->statistics();
  outcome.total_ms = milliseconds_since(start);
  return outcome;
}

std::string outcome_text(const Arguments& args, const Outcome& outcome) {
  const SearchStatistics& s = outcome.statistics;
  std::string text = fmt::format(
      "{}: {} sequences{}; graph {:.3f} ms, first {:.3f} ms, total {:.3f} ms\n"
      "   {} states created, {} expanded, {} pruned, {} arcs followed, {:.1f} MB held",
      args.method, outcome.found, outcome.is_everything ? ", there are no more" : "",
      outcome.graph_ms, outcome.first_ms, outcome.total_ms, s.states_created, s.states_expanded,
      s.states_pruned, s.arcs_relaxed, static_cast<double>(s.bytes_held) / 1e6);
  if (outcome.failure)
    text += fmt::format("\n   stopped, {}: {}", failure_name(outcome.failure->code),
                        outcome.failure->message);
  return text;
}

ordered_json outcome_json(const Arguments& args, const OptionMap& options, const Outcome& outcome) {
  const SearchStatistics& s = outcome.statistics;
  ordered_json written{{"method", args.method}, {"options", ordered_json::object()}};
  for (const auto& [key, value] : options)
    std::visit([&, name = key](const auto& v) { written["options"][name] = v; }, value);
  written["found"] = outcome.found;
  written["is_everything"] = outcome.is_everything;
  if (outcome.failure)
    written["failure"] = {{"code", failure_name(outcome.failure->code)},
                          {"message", outcome.failure->message}};
  written["graph_ms"] = outcome.graph_ms;
  written["first_ms"] = outcome.first_ms;
  written["total_ms"] = outcome.total_ms;
  written["states_created"] = s.states_created;
  written["states_expanded"] = s.states_expanded;
  written["states_pruned"] = s.states_pruned;
  written["arcs_relaxed"] = s.arcs_relaxed;
  written["bytes_held"] = s.bytes_held;
  return written;
}

/// The problem compiled, with the file's name before what is wrong with it.
CompiledProblem compile_named(const SequenceProblem& problem, const std::string& file) {
  try {
    return compile(problem);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
}

/// "length_m=1,balconies=5" and "north:length_m=2": the bounds on a resource wherever there are
/// any, or on one segment.
std::vector<sequences::BoundWeight> weights_of(const Arguments& args,
                                               const SequenceProblem& problem,
                                               const CompiledProblem& compiled) {
  std::vector<sequences::BoundWeight> weights;
  for (const std::string& assignment : args.relaxed) {
    const auto [name, value] = parse_option(assignment);
    const auto* weight = std::get_if<double>(&value);
    if (weight == nullptr || !(*weight > 0.0))
      throw InputError(fmt::format("--relax {}: the weight must be a number above 0", assignment));
    const std::vector<sequences::BoundPlace> places = places_named(problem, compiled, name);
    for (const auto& place : places) {
      const auto known = std::ranges::find(weights, place, &sequences::BoundWeight::place);
      if (known == weights.end())
        weights.push_back({place, *weight});
      else if (places.size() == 1)
        known->weight = *weight;
    }
  }
  return weights;
}

/// Why there is no sequence, and the best relaxation where one is asked for: the text, and the same
/// into the summary.
std::string explain(const Arguments& args, const SequenceProblem& problem,
                    const CompiledProblem& compiled, ordered_json& summary) {
  const auto diagnosis = diagnose(compiled, problem);
  summary["diagnosis"] = diagnosis_json(problem, diagnosis);
  std::string text = "\n" + diagnosis_text(problem, diagnosis);
  const auto weights = weights_of(args, problem, compiled);
  if (weights.empty() || !diagnosis || !diagnosis->gap.empty()) return text;
  const auto relaxation = relax(compiled, problem, weights);
  summary["relaxation"] = relaxation_json(compiled, problem, relaxation);
  return text + "\n" + relaxation_text(compiled, problem, relaxation);
}

ExitStatus run(const Arguments& args) {
  const auto method =
      sequences::sequence_searches().make(args.method, options_from_settings(args.settings));
  const sequences::ReadProblem read = sequences::read_problem(args.problem);
  const SequenceProblem& problem = read.problem;
  const CompiledProblem compiled = compile_named(problem, args.problem);
  if (!args.graph.empty()) write_graph(compiled, problem, args.graph);
  static_cast<void>(weights_of(args, problem, compiled));  // before any work is done
  LineOutput out(args.out);
  if (!args.as_json)
    for (const std::string& note : read.notes) out.line(args.problem + ": " + note);
  const Outcome outcome =
      search(method, compiled, args.k, [&](const SequencePath& path, std::size_t rank) {
        out.line(args.as_json ? sequence_json(compiled, problem, path, rank).dump()
                              : sequence_text(compiled, problem, path, rank));
      });
  ordered_json summary = outcome_json(args, method.options(), outcome);
  summary["notes"] = read.notes;
  const bool has_none = outcome.found == 0 && outcome.is_everything;
  std::string reasons;
  if (has_none) reasons = explain(args, problem, compiled, summary);
  out.line(args.as_json ? summary.dump() : outcome_text(args, outcome) + reasons);
  out.finish();
  return outcome.failure || outcome.found == 0 ? kFinishedWithFailures : kDone;
}

}  // namespace

void add_search_command(CLI::App& app, Action& action) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "search", "Find the cheapest sequences of elements that keep bounds on resources");
  command
      ->add_option("problem", args->problem,
                   "JSON file (docs/sequence_problem.md), or one of OR-Library")
      ->required();
  command->add_option("--method", args->method, "search strategy (plat list strategies)")
      ->capture_default_str();
  command->add_option("--set", args->settings, "option of the strategy, key=value; may be repeated")
      ->take_all();
  command->add_option("--k,-k", args->k, "how many sequences, in order of cost")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}));
  command->add_flag("--json", args->as_json,
                    "a JSON object per line: each sequence as it is found, then a summary");
  command->add_option("--out", args->out, "file to write to, instead of standard output");
  command->add_option(
      "--graph", args->graph,
      "JSON file for the intermediate graph of a small problem, dead ends included");
  command
      ->add_option(
          "--relax", args->relaxed,
          "where no sequence keeps the bounds: those that may be missed, RESOURCE=WEIGHT or "
          "SEGMENT:RESOURCE=WEIGHT, weight per unit; finds the sequence that misses least")
      ->delimiter(',');
  command->footer(
      "Example:\n  plat search docs/examples/street.json --k 3\n"
      "  plat search docs/examples/playlist.json --method layered --k 1000 --json --out "
      "lists.jsonl\n"
      "  plat search problem.json --relax length_m=1,balconies=5\n"
      "Amounts and costs are in the units of the file.\n"
      "Where there is no sequence, it says which bounds cut the space and the nearest amounts\n"
      "that can be attained.\n"
      "Exit status: 0 done, 1 no sequence keeps the bounds, or the search stopped, 2 bad input.");
  command->callback([args, &action] { action = [args] { return run(*args); }; });
}

}  // namespace plat::cli

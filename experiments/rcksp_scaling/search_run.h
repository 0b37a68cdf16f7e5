#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "harness/resource_use.h"
#include "sequences/sequence_search.h"

namespace plat::rcksp {

/// How a search of a cell ended.
enum class RunStatus : std::uint8_t {
  kOk,           ///< found as many sequences as asked for, or all there are
  kFailed,       ///< the strategy gave up beyond its limit of states
  kTimeLimit,    ///< stopped by the wall-clock guard
  kMemoryLimit,  ///< stopped by the memory guard
  kCrashed,      ///< ended by a signal or an exception
  kInfeasible,   ///< its first sequence breaks a bound: never expected
  kDisagrees,    ///< other costs than the strategies before it: never expected
  kNotTried,     ///< did not finish an easier cell of the same study
};
/// "ok", "failed", "time_limit" ...
std::string_view status_name(RunStatus status);

/// One search of one problem. Trivially copyable: it travels through a pipe.
struct SearchRun {
  RunStatus status = RunStatus::kOk;
  std::uint64_t found = 0;
  sequences::Cost first_cost = 0;
  std::uint64_t cost_digest = 0;  ///< of all costs in their order
  harness::Duration build;        ///< `search`: for some strategies the graph's construction
  harness::Duration first;        ///< the first sequence
  harness::Duration rest;         ///< all the others
  sequences::SearchStatistics statistics;
  double peak_mb = 0.0;  ///< what the resident memory grew by; only of a guarded run

  [[nodiscard]] harness::Duration total() const {
    return {build.wall_s + first.wall_s + rest.wall_s, build.cpu_s + first.cpu_s + rest.cpu_s};
  }
};

/// Searches the `k` best paths of `graph` and times the three parts of it. The check that the first
/// path is feasible is not timed. Copies that path to `best` where asked.
SearchRun run_search(const sequences::AnySequenceSearch& strategy,
                     const sequences::SearchGraph& graph, std::uint64_t k,
                     sequences::SequencePath* best = nullptr);

/// What a guarded run may take.
struct RunLimits {
  double time_s = 10.0;
  double memory_mb = 8000.0;  ///< of address space
};

/// `run_search` in a process of its own, which is ended beyond the limits: strategies need not
/// watch the clock, and the peak of memory is this run's alone.
///
/// Guarantees: 1. returns within the time limit, apart from what the system needs;  2. whatever
/// happens in it is a status.
/// Pre: this process has one thread.
SearchRun run_guarded(const sequences::AnySequenceSearch& strategy,
                      const sequences::SearchGraph& graph, std::uint64_t k,
                      const RunLimits& limits);

}  // namespace plat::rcksp

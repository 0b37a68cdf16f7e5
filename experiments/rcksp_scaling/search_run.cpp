#include "rcksp_scaling/search_run.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <exception>
#include <new>
#include <type_traits>

namespace plat::rcksp {
namespace {

using harness::Duration;
using harness::Stopwatch;
using sequences::SequencePath;

/// FNV-1a over the bytes of a number.
std::uint64_t digest(std::uint64_t state, std::uint64_t number) {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  for (int byte = 0; byte < 8; ++byte) state = (state ^ (number >> (8 * byte) & 0xff)) * kPrime;
  return state;
}
constexpr std::uint64_t kDigestOffset = 0xcbf29ce484222325;

/// Takes one path. @returns whether there was one
bool take(sequences::SequenceStream& stream, SequencePath& path, SearchRun& run) {
  const auto more = stream.next(path);
  if (!more) run.status = RunStatus::kFailed;
  if (!more || !*more) return false;
  ++run.found;
  run.cost_digest = digest(run.cost_digest, static_cast<std::uint64_t>(path.cost));
  return true;
}

void search_into(SearchRun& run, const sequences::AnySequenceSearch& strategy,
                 const sequences::SearchGraph& graph, std::uint64_t k, SequencePath* best) {
  run.cost_digest = kDigestOffset;
  const Stopwatch building;
  auto stream = strategy.search(graph);
  run.build = building.elapsed();
  if (!stream) {
    run.status = RunStatus::kFailed;
    return;
  }
  SequencePath path;
  const Stopwatch first;
  const bool has_path = take(**stream, path, run);
  run.first = first.elapsed();
  if (has_path) {
    run.first_cost = path.cost;
    if (best != nullptr) *best = path;
    if (!why_not_feasible(graph, path).empty()) run.status = RunStatus::kInfeasible;
    const Stopwatch rest;
    while (run.found < k && take(**stream, path, run)) continue;
    run.rest = rest.elapsed();
  }
  run.statistics = (*stream)->statistics();
}

/// AddressSanitizer reserves terabytes of addresses, which a limit would forbid.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kLimitsMemory = false;
#elif defined(__has_feature)
constexpr bool kLimitsMemory = !__has_feature(address_sanitizer);
#else
constexpr bool kLimitsMemory = true;
#endif

/// Never returns: the work of the guarded process.
[[noreturn]] void run_as_child(int out, const sequences::AnySequenceSearch& strategy,
                               const sequences::SearchGraph& graph, std::uint64_t k,
                               const RunLimits& limits) {
  const auto bytes = static_cast<rlim_t>(limits.memory_mb * 1e6);
  const rlimit memory{bytes, bytes};
  if (kLimitsMemory) setrlimit(RLIMIT_AS, &memory);
  SearchRun run;
  try {
    harness::reset_peak_memory();
    const double before_mb = harness::peak_memory_mb().value_or(0.0);
    search_into(run, strategy, graph, k, nullptr);
    run.peak_mb = harness::peak_memory_mb().value_or(0.0) - before_mb;
  } catch (const std::bad_alloc&) {
    run.status = RunStatus::kMemoryLimit;
  } catch (const std::exception&) {
    run.status = RunStatus::kCrashed;
  }
  const auto written = write(out, &run, sizeof run);
  _exit(written == sizeof run ? 0 : 1);
}

/// What the child wrote, or why it wrote nothing within the time.
SearchRun read_result(int in, double time_s) {
  static_assert(std::is_trivially_copyable_v<SearchRun>);
  SearchRun run;
  pollfd waiting{in, POLLIN, 0};
  const int ready = poll(&waiting, 1, static_cast<int>(time_s * 1e3));
  if (ready == 0) {
    run.status = RunStatus::kTimeLimit;
  } else if (read(in, &run, sizeof run) != sizeof run) {
    run = {};
    run.status = RunStatus::kCrashed;
  }
  return run;
}

}  // namespace

std::string_view status_name(RunStatus status) {
  switch (status) {
    case RunStatus::kOk:
      return "ok";
    case RunStatus::kFailed:
      return "failed";
    case RunStatus::kTimeLimit:
      return "time_limit";
    case RunStatus::kMemoryLimit:
      return "memory_limit";
    case RunStatus::kCrashed:
      return "crashed";
    case RunStatus::kInfeasible:
      return "infeasible";
    case RunStatus::kDisagrees:
      return "disagrees";
    case RunStatus::kNotTried:
      return "not_tried";
  }
  throw LogicError("a status without a name");
}

SearchRun run_search(const sequences::AnySequenceSearch& strategy,
                     const sequences::SearchGraph& graph, std::uint64_t k, SequencePath* best) {
  SearchRun run;
  search_into(run, strategy, graph, k, best);
  return run;
}

SearchRun run_guarded(const sequences::AnySequenceSearch& strategy,
                      const sequences::SearchGraph& graph, std::uint64_t k,
                      const RunLimits& limits) {
  std::array<int, 2> ends{};
  expects(pipe(ends.data()) == 0, "a pipe to the guarded process");
  const pid_t child = fork();
  expects(child >= 0, "a guarded process");
  if (child == 0) {
    close(ends[0]);
    run_as_child(ends[1], strategy, graph, k, limits);
  }
  close(ends[1]);
  const SearchRun run = read_result(ends[0], limits.time_s);
  close(ends[0]);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  return run;
}

}  // namespace plat::rcksp

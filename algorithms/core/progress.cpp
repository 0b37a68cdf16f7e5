#include "core/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace plat {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

constexpr duration<double> kTerminalInterval{0.1};
constexpr duration<double> kPlainInterval{5.0};

}  // namespace

Progress::Progress(std::string title, std::size_t total, Style style)
    : title_(std::move(title)),
      total_(total),
      is_quiet_(style == Style::kQuiet),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      started_(steady_clock::now()),
      drawn_(started_) {}

void Progress::step() {
  const std::size_t done = ++done_;
  if (is_quiet_) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  const auto now = steady_clock::now();
  if (now - drawn_ < (is_terminal_ ? kTerminalInterval : kPlainInterval)) return;
  drawn_ = now;
  draw(done);
}

void Progress::draw(std::size_t done) {
  const double share = total_ == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total_);
  const double seconds = duration<double>(steady_clock::now() - started_).count();
  if (is_terminal_) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(share * kWidth);
    fmt::print(stderr, "\r{:<24} [{:#<{}}{:.<{}}] {:>3.0f} %  {:.1f} s", title_, "", filled, "",
               kWidth - filled, 100.0 * share, seconds);
    std::fflush(stderr);
  } else {
    fmt::print(stderr, "{}: {} of {}, {:.1f} s\n", title_, done, total_, seconds);
  }
}

Progress::~Progress() {
  if (is_quiet_) return;
  draw(done_);
  if (is_terminal_) fmt::print(stderr, "\n");
}

}  // namespace plat

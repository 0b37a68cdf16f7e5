#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace plat {

/// Tells a person on standard error how far long work has come: a bar that redraws itself on a
/// terminal, a plain line every few seconds elsewhere, nothing where `kQuiet`. step() may be called
/// from any thread.
class Progress {
 public:
  enum class Style { kAutomatic, kQuiet };

  Progress(std::string title, std::size_t total, Style style = Style::kAutomatic);
  ~Progress();  ///< ends the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step();

 private:
  void draw(std::size_t done);

  std::string title_;
  std::size_t total_;
  bool is_quiet_;
  bool is_terminal_;
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point drawn_;
};

}  // namespace plat

#include "sequences/or_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

#include "core/failure.h"

namespace plat::sequences {
namespace {

/// Amounts and costs above this are refused: sums over a path of as many arcs still fit a `Cost`.
constexpr std::int64_t kLargestNumber = 1'000'000'000;

/// The whole numbers of a text, one after the other, with their lines.
class Numbers {
 public:
  Numbers(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  /// The next number, which means `meaning`.
  std::int64_t next(std::string_view meaning, std::int64_t min, std::int64_t max) {
    skip_space();
    if (text_.empty()) refuse(fmt::format("the file ends where {} should be", meaning));
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    const auto length = static_cast<std::size_t>(end - text_.data());
    const bool is_whole = length == text_.size() || is_space(text_[length]);
    if (error != std::errc{} || !is_whole)
      refuse(fmt::format("{} should be a whole number, not \"{}\"", meaning, word()));
    if (value < min || value > max)
      refuse(fmt::format("{} = {}, allowed {}..{}", meaning, value, min, max));
    text_.remove_prefix(length);
    return value;
  }
  Amount next_amount(std::string_view meaning, std::int64_t min = 0) {
    return static_cast<Amount>(next(meaning, min, kLargestNumber));
  }
  bool is_at_end() {
    skip_space();
    return text_.empty();
  }
  void skip_line() {
    text_.remove_prefix(std::min(text_.find('\n'), text_.size()));
    skip_space();
  }
  [[noreturn]] void refuse(const std::string& reason) const {
    throw InputError(fmt::format("{}: line {}: {}", name_, line_, reason));
  }
  /// What stands next, up to a space.
  [[nodiscard]] std::string_view word() const {
    return text_.substr(0, text_.find_first_of(" \t\r\n"));
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  void skip_space() {
    while (!text_.empty() && is_space(text_.front())) {
      if (text_.front() == '\n') ++line_;
      text_.remove_prefix(1);
    }
  }

  std::string_view text_;
  std::string_view name_;
  int line_ = 1;
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in)
    throw InputError(fmt::format(
        "{}: cannot be read; `plat data list` says how to get rcsp_or_library", file.string()));
  return text;
}

}  // namespace

SequenceProblem parse_or_library(std::string_view text, std::string_view name) {
  Numbers numbers(text, name);
  const auto vertex_count = numbers.next("the number of vertices", 1, 10'000'000);
  const auto arc_count = numbers.next("the number of arcs", 0, 100'000'000);
  const auto resource_count = numbers.next("the number of resources", 0, 1'000);
  SequenceDatabase database;
  std::vector<Bounds> bounds(static_cast<std::size_t>(resource_count));
  for (Bounds& limit : bounds) {
    limit.min = numbers.next_amount("a lower limit");
    database.resources.push_back({fmt::format("resource_{}", database.resources.size() + 1)});
  }
  for (Bounds& limit : bounds) limit.max = numbers.next_amount("an upper limit", limit.min);
  const auto amounts = [&](std::string_view meaning) {
    std::vector<Amount> uses(bounds.size());
    for (Amount& used : uses) used = numbers.next_amount(meaning);
    return uses;
  };
  for (std::int64_t v = 1; v <= vertex_count; ++v)
    database.elements.push_back({.name = fmt::format("{}", v),
                                 .uses = amounts("what a vertex uses"),
                                 .is_front = v == 1,
                                 .is_back = v == vertex_count});
  for (std::int64_t a = 0; a < arc_count; ++a) {
    Transition arc;
    arc.from = static_cast<ElementIndex>(numbers.next("an arc's tail", 1, vertex_count) - 1);
    arc.to = static_cast<ElementIndex>(numbers.next("an arc's head", 1, vertex_count) - 1);
    arc.cost = numbers.next("an arc's cost", 0, kLargestNumber);
    arc.uses = amounts("what an arc uses");
    database.transitions.push_back(std::move(arc));
  }
  if (!numbers.is_at_end())
    numbers.refuse(fmt::format("\"{}\" after the last of {} arcs", numbers.word(), arc_count));
  return plain_sequence(std::move(database), std::move(bounds));
}

SequenceProblem read_or_library(const std::filesystem::path& file) {
  return parse_or_library(text_of(file), file.string());
}

std::vector<PublishedOptimum> read_or_library_optima(const std::filesystem::path& file) {
  const std::string text = text_of(file);
  const std::string name = file.string();
  Numbers numbers(text, name);
  numbers.skip_line();
  std::vector<PublishedOptimum> optima;
  while (!numbers.is_at_end()) {
    const auto instance = numbers.next("an instance", 1, 24);
    const Cost cost = numbers.next("an optimum", 0, kLargestNumber);
    optima.push_back(
        {static_cast<int>(instance), cost == 0 ? std::nullopt : std::optional<Cost>(cost)});
  }
  return optima;
}

}  // namespace plat::sequences

#include "core/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <numeric>

namespace plat {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, substitution});
    }
  }
  return row.back();
}

}  // namespace

std::string did_you_mean(std::string_view wrong, std::span<const std::string_view> candidates) {
  std::string_view best;
  std::size_t best_distance = wrong.size() / 2 + 1;
  for (const std::string_view candidate : candidates) {
    const std::size_t d = edit_distance(wrong, candidate);
    if (d < best_distance) {
      best = candidate;
      best_distance = d;
    }
  }
  return best.empty() ? "" : fmt::format(", did you mean \"{}\"?", best);
}

namespace detail {

void throw_out_of_range(std::string_view owner, std::string_view key, double value, double min,
                        double max) {
  throw InputError(fmt::format("{}: {} = {}, allowed {}..{}", owner, key, value, min, max));
}

void throw_wrong_type(std::string_view owner, std::string_view key, std::string_view wanted) {
  throw InputError(fmt::format("{}: {} must be {}", owner, key, wanted));
}

void throw_unknown_choice(std::string_view owner, std::string_view key, std::string_view value,
                          std::span<const std::string_view> allowed) {
  throw InputError(fmt::format("{}: {} = \"{}\", allowed: {}{}", owner, key, value,
                               fmt::join(allowed, ", "), did_you_mean(value, allowed)));
}

void expect_known_keys(std::string_view owner, const OptionMap& map,
                       std::span<const std::string_view> known) {
  for (const auto& [key, value] : map) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    throw InputError(fmt::format("{}: unknown option \"{}\"{} (known: {})", owner, key,
                                 did_you_mean(key, known), fmt::join(known, ", ")));
  }
}

double number_from(std::string_view owner, std::string_view key, const OptionValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  throw_wrong_type(owner, key, "a number");
}

}  // namespace detail

std::pair<std::string, OptionValue> parse_option(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0 || equals + 1 == assignment.size()) {
    throw InputError(fmt::format("\"{}\" is not of the form key=value", assignment));
  }
  const std::string_view text = assignment.substr(equals + 1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  OptionValue value = std::string(text);
  if (error == std::errc{} && end == text.data() + text.size()) value = number;
  return {std::string(assignment.substr(0, equals)), std::move(value)};
}

std::string to_string(const OptionValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return std::get<std::string>(value);
}

std::string to_string(const OptionMap& map) {
  std::string out;
  for (const auto& [key, value] : map) {
    if (!out.empty()) out += ';';
    out += key + '=' + to_string(value);
  }
  return out;
}

}  // namespace plat

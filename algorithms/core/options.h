#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/failure.h"

namespace plat {

/// A value from a config file or from `--set key=value`. Numbers are doubles until a field says
/// otherwise.
using OptionValue = std::variant<double, std::string>;
/// Sorted by key, so that what is written back never depends on the order of input.
using OptionMap = std::map<std::string, OptionValue, std::less<>>;

/// One name of an enumeration option, e.g. {"street_width", CornerScheme::kStreetWidth}.
template <class Enum>
struct EnumName {
  std::string_view name;
  Enum value;
};

/// A numeric option: key (unit in the name), member, inclusive range, one sentence.
template <class Options, class Value>
struct Field {
  std::string_view name;
  Value Options::* member;
  Value min;
  Value max;
  std::string_view description;

  // A deduction helper: bounds and description may be given as literals of any arithmetic type.
  template <class Low, class High>
  constexpr Field(std::string_view name_, Value Options::* member_, Low min_, High max_,
                  std::string_view description_)
      : name(name_),
        member(member_),
        min(static_cast<Value>(min_)),
        max(static_cast<Value>(max_)),
        description(description_) {}
};
template <class Options, class Value, class Low, class High>
Field(std::string_view, Value Options::*, Low, High, std::string_view) -> Field<Options, Value>;

/// An option that names one of a few modes.
template <class Options, class Enum, std::size_t N>
struct EnumField {
  std::string_view name;
  Enum Options::* member;
  EnumName<Enum> names[N];
  std::string_view description;
};

/// A numeric option that may be absent, written "none".
template <class Options>
struct OptionalField {
  std::string_view name;
  std::optional<double> Options::* member;
  double min;
  double max;
  std::string_view description;
};
template <class Options, class Low, class High>
OptionalField(std::string_view, std::optional<double> Options::*, Low, High, std::string_view)
    -> OptionalField<Options>;

/// What an absent option is called in configs and tables.
inline constexpr std::string_view kAbsent = "none";

/// How an option looks to a person and to `plat list strategies --json`.
struct FieldDescription {
  std::string name;
  std::string type;  ///< "number", "integer", "number or none" or "choice"
  OptionValue default_value;
  double min = 0.0;
  double max = 0.0;
  std::vector<std::string> choices;  ///< of a choice
  std::string description;
};

namespace detail {

[[noreturn]] void throw_out_of_range(std::string_view owner, std::string_view key, double value,
                                     double min, double max);
[[noreturn]] void throw_wrong_type(std::string_view owner, std::string_view key,
                                   std::string_view wanted);
[[noreturn]] void throw_unknown_choice(std::string_view owner, std::string_view key,
                                       std::string_view value,
                                       std::span<const std::string_view> allowed);
void expect_known_keys(std::string_view owner, const OptionMap& map,
                       std::span<const std::string_view> known);
double number_from(std::string_view owner, std::string_view key, const OptionValue& value);

template <class Options, class Value>
void read_field(std::string_view owner, Options& options, const Field<Options, Value>& field,
                const OptionValue& value) {
  const double number = number_from(owner, field.name, value);
  const auto low = static_cast<double>(field.min);
  const auto high = static_cast<double>(field.max);
  if (!(number >= low && number <= high)) throw_out_of_range(owner, field.name, number, low, high);
  if constexpr (std::is_integral_v<Value>) {
    if (number != static_cast<double>(static_cast<Value>(number)))
      throw_wrong_type(owner, field.name, "a whole number");
  }
  options.*(field.member) = static_cast<Value>(number);
}

template <class Options>
void read_field(std::string_view owner, Options& options, const OptionalField<Options>& field,
                const OptionValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text != nullptr && *text == kAbsent) {
    options.*(field.member) = std::nullopt;
    return;
  }
  if (text != nullptr) throw_wrong_type(owner, field.name, "a number or \"none\"");
  const double number = std::get<double>(value);
  if (!(number >= field.min && number <= field.max))
    throw_out_of_range(owner, field.name, number, field.min, field.max);
  options.*(field.member) = number;
}

template <class Options, class Enum, std::size_t N>
void read_field(std::string_view owner, Options& options, const EnumField<Options, Enum, N>& field,
                const OptionValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) throw_wrong_type(owner, field.name, "one of its names");
  std::vector<std::string_view> allowed;
  for (const auto& choice : field.names) {
    if (choice.name == *text) {
      options.*(field.member) = choice.value;
      return;
    }
    allowed.push_back(choice.name);
  }
  throw_unknown_choice(owner, field.name, *text, allowed);
}

template <class Options, class Value>
OptionValue write_field(const Options& options, const Field<Options, Value>& field) {
  return static_cast<double>(options.*(field.member));
}

template <class Options>
OptionValue write_field(const Options& options, const OptionalField<Options>& field) {
  const std::optional<double>& value = options.*(field.member);
  if (!value) return std::string(kAbsent);
  return *value;
}

template <class Options, class Enum, std::size_t N>
OptionValue write_field(const Options& options, const EnumField<Options, Enum, N>& field) {
  for (const auto& choice : field.names) {
    if (choice.value == options.*(field.member)) return std::string(choice.name);
  }
  throw LogicError("an enumeration option has a value without a name");
}

template <class Options, class Value>
FieldDescription describe_field(const Options& defaults, const Field<Options, Value>& field) {
  return {std::string(field.name),        std::is_integral_v<Value> ? "integer" : "number",
          write_field(defaults, field),   static_cast<double>(field.min),
          static_cast<double>(field.max), {},
          std::string(field.description)};
}

template <class Options>
FieldDescription describe_field(const Options& defaults, const OptionalField<Options>& field) {
  return {std::string(field.name),
          "number or none",
          write_field(defaults, field),
          field.min,
          field.max,
          {},
          std::string(field.description)};
}

template <class Options, class Enum, std::size_t N>
FieldDescription describe_field(const Options& defaults, const EnumField<Options, Enum, N>& field) {
  FieldDescription out{
      std::string(field.name),       "choice", write_field(defaults, field), 0.0, 0.0, {},
      std::string(field.description)};
  for (const auto& choice : field.names) out.choices.emplace_back(choice.name);
  return out;
}

template <class Options, class Visit>
void for_each_field(Visit visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, Options::fields());
}

}  // namespace detail

/// Options from a map. @throws InputError for an unknown key, a wrong type, a value out of range: a
/// typo never runs an experiment. `owner` names the strategy in the message.
template <class Options>
Options from_option_map(std::string_view owner, const OptionMap& map) {
  std::vector<std::string_view> known;
  detail::for_each_field<Options>([&](const auto& field) { known.push_back(field.name); });
  detail::expect_known_keys(owner, map, known);
  Options options{};
  detail::for_each_field<Options>([&](const auto& field) {
    if (const auto it = map.find(field.name); it != map.end())
      detail::read_field(owner, options, field, it->second);
  });
  return options;
}

/// Every option, defaults included: what ran is what is written into the result row.
template <class Options>
OptionMap to_option_map(const Options& options) {
  OptionMap map;
  detail::for_each_field<Options>([&](const auto& field) {
    map.emplace(std::string(field.name), detail::write_field(options, field));
  });
  return map;
}

template <class Options>
std::vector<FieldDescription> describe_fields() {
  std::vector<FieldDescription> out;
  const Options defaults{};
  detail::for_each_field<Options>(
      [&](const auto& field) { out.push_back(detail::describe_field(defaults, field)); });
  return out;
}

/// "key=value" as given on a command line; a value that reads as a number becomes one.
std::pair<std::string, OptionValue> parse_option(std::string_view assignment);

/// The shortest text that reads back as the same value.
std::string to_string(const OptionValue& value);

/// "frontage_m=15;omega=0.2": one cell of a table.
std::string to_string(const OptionMap& map);

/// ", did you mean \"skeleton\"?" for the candidate nearest to a misspelt name; empty where none is
/// near.
std::string did_you_mean(std::string_view wrong, std::span<const std::string_view> candidates);

}  // namespace plat

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "harness/script_json_internal.h"

namespace plat::harness {

std::string ScriptJson::where() const {
  return path_.empty() ? source_ : fmt::format("{}: {}", source_, path_);
}

std::string ScriptJson::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void ScriptJson::refuse(std::string_view what) const {
  throw InputError(fmt::format("{}: {}", where(), what));
}

void ScriptJson::refuse_member(std::string_view key, std::string_view what) const {
  throw InputError(fmt::format("{}: {}: {}", source_, path_of(key), what));
}

std::optional<ScriptJson> ScriptJson::find(std::string_view key) const {
  if (!value_->is_object()) refuse("must be a JSON object");
  const auto it = value_->find(key);
  if (it == value_->end()) return std::nullopt;
  return ScriptJson(*it, source_, path_of(key));
}

ScriptJson ScriptJson::needed(std::string_view key, std::string_view what) const {
  if (auto found = find(key)) return *std::move(found);
  refuse_member(key, fmt::format("is missing: {}", what));
}

void ScriptJson::expect_only(std::initializer_list<std::string_view> keys) const {
  expect_only(std::span(keys.begin(), keys.size()));
}

void ScriptJson::expect_only(std::span<const std::string_view> keys) const {
  if (!value_->is_object()) refuse("must be a JSON object");
  for (const auto& [key, value] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    refuse(fmt::format("unknown key \"{}\"{} (allowed: {})", key, did_you_mean(key, keys),
                       fmt::join(keys, ", ")));
  }
}

std::vector<ScriptJson> ScriptJson::list() const {
  if (!value_->is_array()) refuse("must be a list");
  std::vector<ScriptJson> out;
  for (std::size_t i = 0; i < value_->size(); ++i)
    out.push_back(ScriptJson((*value_)[i], source_, fmt::format("{}[{}]", path_, i)));
  return out;
}

std::string ScriptJson::text() const {
  if (!value_->is_string() || value_->get_ref<const std::string&>().empty())
    refuse("must be a text");
  return value_->get<std::string>();
}

double ScriptJson::number(double low, double high) const {
  if (!value_->is_number()) refuse(fmt::format("must be a number, {}..{}", low, high));
  const auto number = value_->get<double>();
  if (!(number >= low && number <= high))
    refuse(fmt::format("{}, allowed {}..{}", number, low, high));
  return number;
}

std::int64_t ScriptJson::whole(std::int64_t low, std::int64_t high) const {
  if (!value_->is_number_integer())
    refuse(fmt::format("must be a whole number, {}..{}", low, high));
  const auto number = value_->get<std::int64_t>();
  if (number < low || number > high) refuse(fmt::format("{}, allowed {}..{}", number, low, high));
  return number;
}

bool ScriptJson::is_true_or_false() const {
  if (!value_->is_boolean()) refuse("must be true or false");
  return value_->get<bool>();
}

std::string ScriptJson::choice(std::initializer_list<std::string_view> names) const {
  const std::string given = text();
  if (std::find(names.begin(), names.end(), given) == names.end()) {
    refuse(fmt::format("no \"{}\"{} (allowed: {})", given,
                       did_you_mean(given, std::span(names.begin(), names.size())),
                       fmt::join(names, ", ")));
  }
  return given;
}

OptionMap ScriptJson::options() const {
  if (!value_->is_object()) refuse("must be a JSON object of options");
  OptionMap out;
  for (const auto& [key, value] : value_->items()) {
    if (value.is_number()) {
      out.emplace(key, value.get<double>());
    } else if (value.is_string()) {
      out.emplace(key, value.get<std::string>());
    } else {
      refuse_member(key, "must be a number or a text");
    }
  }
  return out;
}

}  // namespace plat::harness

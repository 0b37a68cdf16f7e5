#include "harness/config_reader_internal.h"

#include <fmt/format.h>

#include <algorithm>

namespace plat::harness {

using nlohmann::json;

ObjectReader::ObjectReader(const json& object, std::string where)
    : object_(object), where_(std::move(where)) {
  if (!object.is_object()) throw InputError(where_ + ": must be a JSON object");
}

const json* ObjectReader::find(std::string_view key) {
  known_.push_back(key);
  const auto it = object_.find(key);
  return it == object_.end() ? nullptr : &*it;
}

std::string ObjectReader::text(std::string_view key, const std::string& fallback) {
  const json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_string()) throw InputError(fmt::format("{}: \"{}\" must be a text", where_, key));
  return value->get<std::string>();
}

std::int64_t ObjectReader::whole(std::string_view key, std::int64_t fallback, std::int64_t min,
                                 std::int64_t max) {
  const json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_number_integer())
    throw InputError(fmt::format("{}: \"{}\" must be a whole number", where_, key));
  const auto number = value->get<std::int64_t>();
  if (number < min || number > max)
    throw InputError(fmt::format("{}: {} = {}, allowed {}..{}", where_, key, number, min, max));
  return number;
}

void ObjectReader::expect_nothing_else() const {
  for (const auto& [key, value] : object_.items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    throw InputError(
        fmt::format("{}: unknown key \"{}\"{}", where_, key, did_you_mean(key, known_)));
  }
}

OptionValue read_option(const json& value, const std::string& key, const std::string& where) {
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  throw InputError(fmt::format("{}: option \"{}\" must be a number or a text", where, key));
}

OptionMap read_options(const json& object, const std::string& where) {
  OptionMap out;
  if (!object.is_object()) throw InputError(where + ": \"options\" must be a JSON object");
  for (const auto& [key, value] : object.items()) out.emplace(key, read_option(value, key, where));
  return out;
}

}  // namespace plat::harness

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/failure.h"
#include "core/options.h"

namespace plat::sequences::detail {

/// Reads the keys of one JSON object and refuses those that nobody asked for.
class JsonObject {
 public:
  /// @param where  names the object in messages
  JsonObject(const nlohmann::json& object, std::string where)
      : object_(object), where_(std::move(where)) {
    if (!object.is_object()) throw InputError(where_ + ": must be a JSON object");
  }

  [[nodiscard]] const std::string& where() const { return where_; }
  const nlohmann::json* find(std::string_view key) {
    known_.push_back(key);
    const auto it = object_.find(key);
    return it == object_.end() ? nullptr : &*it;
  }
  const nlohmann::json& needed(std::string_view key) {
    const nlohmann::json* value = find(key);
    if (value == nullptr) throw InputError(fmt::format("{}: \"{}\" is missing", where_, key));
    return *value;
  }
  std::optional<std::string> text(std::string_view key) {
    const nlohmann::json* value = find(key);
    if (value == nullptr) return std::nullopt;
    if (!value->is_string())
      throw InputError(fmt::format("{}: \"{}\" must be a text", where_, key));
    return value->get<std::string>();
  }
  std::string name() {
    const auto found = text("name");
    if (!found || found->empty()) throw InputError(where_ + ": \"name\" is missing");
    return *found;
  }
  bool flag(std::string_view key, bool fallback) {
    const nlohmann::json* value = find(key);
    if (value == nullptr) return fallback;
    if (!value->is_boolean())
      throw InputError(fmt::format("{}: \"{}\" must be true or false", where_, key));
    return value->get<bool>();
  }
  /// The elements of a list that may be left out.
  const nlohmann::json& list(std::string_view key) {
    static const nlohmann::json kNone = nlohmann::json::array();
    const nlohmann::json* value = find(key);
    if (value == nullptr) return kNone;
    if (!value->is_array()) throw InputError(fmt::format("{}: \"{}\" must be a list", where_, key));
    return *value;
  }
  void expect_nothing_else() const {
    for (const auto& [key, value] : object_.items()) {
      if (std::ranges::find(known_, key) != known_.end()) continue;
      throw InputError(
          fmt::format("{}: unknown key \"{}\"{}", where_, key, did_you_mean(key, known_)));
    }
  }

 private:
  const nlohmann::json& object_;
  std::string where_;
  std::vector<std::string_view> known_;
};

/// Names and the numbers that they stand for.
class NameIndex {
 public:
  /// @param what  e.g. "element", for messages
  explicit NameIndex(std::string what) : what_(std::move(what)) {}

  void add(const std::string& name, const std::string& where) {
    const auto number = static_cast<std::uint32_t>(numbers_.size());
    if (!numbers_.emplace(name, number).second)
      throw InputError(fmt::format("{}: two {}s are called \"{}\"", where, what_, name));
  }
  [[nodiscard]] std::uint32_t at(const std::string& name, const std::string& where) const {
    const auto it = numbers_.find(name);
    if (it != numbers_.end()) return it->second;
    std::vector<std::string_view> known;
    for (const auto& [each, number] : numbers_) known.push_back(each);
    throw InputError(
        fmt::format("{}: no {} \"{}\"{}", where, what_, name, did_you_mean(name, known)));
  }
  [[nodiscard]] std::uint32_t at(const nlohmann::json& name, const std::string& where) const {
    if (!name.is_string())
      throw InputError(fmt::format("{}: must be the name of a {}", where, what_));
    return at(name.get<std::string>(), where);
  }
  [[nodiscard]] std::size_t size() const { return numbers_.size(); }

 private:
  std::string what_;
  std::map<std::string, std::uint32_t, std::less<>> numbers_;
};

/// The ports as files call them, by `Port`.
inline constexpr std::string_view kPortNames[] = {"left", "right", "stem"};

}  // namespace plat::sequences::detail

#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/failure.h"
#include "core/options.h"

namespace plat::harness {

/// A value of a JSON script that knows where it stands: every refusal begins with the file and the
/// path, "city.json: operations[2].weight: ...".
class ScriptJson {
 public:
  ScriptJson(const nlohmann::json& value, std::string source)
      : value_(&value), source_(std::move(source)) {}

  [[noreturn]] void refuse(std::string_view what) const;
  /// Refuses a member that is not there, too.
  [[noreturn]] void refuse_member(std::string_view key, std::string_view what) const;

  /// A member; nullopt where there is none. @throws InputError where this is no object
  [[nodiscard]] std::optional<ScriptJson> find(std::string_view key) const;
  [[nodiscard]] ScriptJson needed(std::string_view key, std::string_view what) const;
  /// Refuses members of any other name.
  void expect_only(std::initializer_list<std::string_view> keys) const;
  void expect_only(std::span<const std::string_view> keys) const;

  [[nodiscard]] std::vector<ScriptJson> list() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] double number(double low, double high) const;
  [[nodiscard]] std::int64_t whole(std::int64_t low, std::int64_t high) const;
  [[nodiscard]] bool is_true_or_false() const;
  /// One of the names.
  [[nodiscard]] std::string choice(std::initializer_list<std::string_view> names) const;
  /// The members as options, each a number or a text.
  [[nodiscard]] OptionMap options() const;

  [[nodiscard]] bool is_number() const { return value_->is_number(); }
  [[nodiscard]] bool is_text() const { return value_->is_string(); }
  [[nodiscard]] bool is_list() const { return value_->is_array(); }
  [[nodiscard]] const std::string& path() const { return path_; }
  /// "city.json: operations[2]"
  [[nodiscard]] std::string where() const;

  /// Calls `read` and puts the place before what it refuses.
  template <class Read>
  auto naming(Read read) const {
    try {
      return read();
    } catch (const InputError& error) {
      refuse(error.what());
    }
  }

 private:
  ScriptJson(const nlohmann::json& value, std::string source, std::string path)
      : value_(&value), source_(std::move(source)), path_(std::move(path)) {}
  [[nodiscard]] std::string path_of(std::string_view key) const;

  const nlohmann::json* value_;
  std::string source_;
  std::string path_;
};

}  // namespace plat::harness

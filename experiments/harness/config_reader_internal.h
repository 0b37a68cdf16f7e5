#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/failure.h"
#include "core/options.h"

namespace plat::harness {

/// Reads the keys of one JSON object and refuses those that nobody asked for.
class ObjectReader {
 public:
  /// @param where  names the object in messages
  ObjectReader(const nlohmann::json& object, std::string where);

  const nlohmann::json* find(std::string_view key);
  std::string text(std::string_view key, const std::string& fallback);
  std::int64_t whole(std::string_view key, std::int64_t fallback, std::int64_t min,
                     std::int64_t max);
  void expect_nothing_else() const;

 private:
  const nlohmann::json& object_;
  std::string where_;
  std::vector<std::string_view> known_;
};

/// Calls `check`, and puts the place in the config before what it refuses.
template <class Check>
void naming(const std::string& where, Check check) {
  try {
    check();
  } catch (const InputError& error) {
    throw InputError(where + ": " + error.what());
  }
}

/// A number or a text. @throws InputError that names `key` for anything else
OptionValue read_option(const nlohmann::json& value, const std::string& key,
                        const std::string& where);
OptionMap read_options(const nlohmann::json& object, const std::string& where);

}  // namespace plat::harness

#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/options.h"

namespace plat {

/// What the registry asks of a strategy: a key, a sentence, options with fields, and a constructor
/// from them.
template <class S>
concept Registrable = requires(const typename S::Options& options) {
  { S::kName } -> std::convertible_to<std::string_view>;
  { S::kSummary } -> std::convertible_to<std::string_view>;
  S::Options::fields();
  S(options);
};

/// The menu of one family: makes an `Any` (a type-erased strategy) by the name that a config uses.
template <class Any>
class Registry {
 public:
  struct Entry {
    std::string summary;
    std::vector<FieldDescription> fields;
    std::function<Any(const OptionMap&)> make;
  };

  template <Registrable S>
  void add() {
    const bool is_new =
        entries_
            .emplace(std::string(S::kName),
                     Entry{std::string(S::kSummary), describe_fields<typename S::Options>(),
                           [](const OptionMap& map) {
                             return Any(S(from_option_map<typename S::Options>(S::kName, map)));
                           }})
            .second;
    expects(is_new, "strategy names are unique");
  }

  /// Sorted.
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& [name, entry] : entries_) out.push_back(name);
    return out;
  }

  /// @throws InputError for a name that is not on the menu.
  [[nodiscard]] const Entry& at(std::string_view name) const {
    const auto it = entries_.find(name);
    if (it != entries_.end()) return it->second;
    std::vector<std::string_view> known;
    std::string list;
    for (const auto& [key, entry] : entries_) {
      known.push_back(key);
      list += (list.empty() ? "" : ", ") + key;
    }
    throw InputError("unknown strategy \"" + std::string(name) + "\"" + did_you_mean(name, known) +
                     " (known: " + list + ")");
  }

  /// @throws InputError for an unknown name, key or value.
  [[nodiscard]] Any make(std::string_view name, const OptionMap& options = {}) const {
    return at(name).make(options);
  }

 private:
  std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace plat

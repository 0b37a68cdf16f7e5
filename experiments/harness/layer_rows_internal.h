#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/failure.h"
#include "geodata/layer_io.h"

namespace plat::harness {

/// Fields of a layer by name, with errors that say file, layer and feature.
class LayerRows {
 public:
  LayerRows(std::string file, geodata::Layer layer)
      : file_(std::move(file)), layer_(std::move(layer)) {
    for (std::size_t i = 0; i < layer_.fields.size(); ++i) index_[layer_.fields[i].name] = i;
  }

  [[nodiscard]] const geodata::Layer& layer() const { return layer_; }

  [[noreturn]] void refuse(const geodata::Feature& feature, std::string_view what) const {
    throw InputError(fmt::format("{}:{}: feature {}: {}", file_, layer_.name, feature.id, what));
  }
  [[nodiscard]] bool has(std::string_view field) const { return index_.contains(field); }
  [[nodiscard]] const geodata::Attribute& at(const geodata::Feature& feature,
                                             std::string_view field) const {
    const auto it = index_.find(field);
    if (it == index_.end())
      throw InputError(fmt::format("{}:{}: no field \"{}\"", file_, layer_.name, field));
    return feature.attributes[it->second];
  }
  /// Empty where there is none.
  [[nodiscard]] std::string text(const geodata::Feature& feature, std::string_view field) const {
    const auto* value = std::get_if<std::string>(&at(feature, field));
    return value == nullptr ? std::string() : *value;
  }
  [[nodiscard]] std::optional<double> real(const geodata::Feature& feature,
                                           std::string_view field) const {
    const geodata::Attribute& value = at(feature, field);
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    return std::nullopt;
  }
  [[nodiscard]] double needed_real(const geodata::Feature& feature, std::string_view field) const {
    const auto value = real(feature, field);
    if (!value) refuse(feature, fmt::format("{} must be a number", field));
    return *value;
  }
  [[nodiscard]] std::optional<std::uint32_t> id(const geodata::Feature& feature,
                                                std::string_view field) const {
    const auto* value = std::get_if<std::int64_t>(&at(feature, field));
    if (value == nullptr) return std::nullopt;
    constexpr std::int64_t kMaxId = 100'000'000;  // ids index tables
    if (*value < 0 || *value > kMaxId)
      refuse(feature, fmt::format("{} = {}, allowed 0..{}", field, *value, kMaxId));
    return static_cast<std::uint32_t>(*value);
  }
  [[nodiscard]] std::uint32_t needed_id(const geodata::Feature& feature,
                                        std::string_view field) const {
    const auto value = id(feature, field);
    if (!value) refuse(feature, fmt::format("{} must be a whole number", field));
    return *value;
  }
  [[nodiscard]] std::uint64_t seed(const geodata::Feature& feature) const {
    const std::string given = text(feature, "seed");
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), value);
    if (error != std::errc{} || end != given.data() + given.size())
      refuse(feature, fmt::format("seed \"{}\" must be a whole number", given));
    return value;
  }

 private:
  std::string file_;
  geodata::Layer layer_;
  std::map<std::string, std::size_t, std::less<>> index_;
};

inline LayerRows read_rows(const std::string& file, const std::string& name,
                           geodata::GeometryKind kind,
                           const std::optional<geodata::LocalFrame>& frame) {
  return {file, geodata::read_layer({file, name}, {.frame = frame, .kind = kind})};
}

inline bool has_features(const std::string& file, std::string_view name) {
  for (const geodata::LayerInfo& layer : geodata::list_layers(file)) {
    if (layer.name == name) return layer.feature_count != 0;
  }
  return false;
}

}  // namespace plat::harness

#include "harness/cell_store.h"

#include <fmt/format.h>

#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/working_grid.h"

namespace plat::harness {
namespace {

using nlohmann::json;

json ring_json(const Ring& ring) {
  json out = json::array();
  for (const Point p : ring) {
    out.push_back(to_grid(p.x));
    out.push_back(to_grid(p.y));
  }
  return out;
}

Ring ring_from(const json& numbers) {
  static_cast<void>(numbers.at(5));  // three points at least: throws where it is no ring
  Ring out;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    out.push_back(
        {from_grid(numbers[i].get<std::int64_t>()), from_grid(numbers[i + 1].get<std::int64_t>())});
  }
  return out;
}

json block_json(const DividedBlock& block) {
  json out{{"block", block.block.value}, {"seed", block.seed}};
  for (const auto& [key, value] : block.options)
    std::visit([&](const auto& v) { out["options"][key] = v; }, value);
  if (!block.parcels) {
    out["code"] = static_cast<int>(block.parcels.error().code);
    out["message"] = block.parcels.error().message;
    return out;
  }
  out["parcels"] = json::array();
  for (const parcels::Parcel& parcel : *block.parcels) {
    json rings = json::array({ring_json(parcel.shape.outer)});
    for (const Ring& hole : parcel.shape.holes) rings.push_back(ring_json(hole));
    out["parcels"].push_back(std::move(rings));
  }
  return out;
}

DividedBlock block_from(const json& object) {
  DividedBlock out;
  out.block = BlockId{object.at("block").get<std::uint32_t>()};
  out.seed = object.at("seed").get<std::uint64_t>();
  for (const auto& [key, value] : object.at("options").items()) {
    if (value.is_string()) {
      out.options.emplace(key, value.get<std::string>());
    } else {
      out.options.emplace(key, value.get<double>());
    }
  }
  if (object.contains("code")) {
    out.parcels = fail(static_cast<FailureCode>(object.at("code").get<int>()),
                       object.at("message").get<std::string>());
    return out;
  }
  std::vector<parcels::Parcel> parcels;
  for (const json& rings : object.at("parcels")) {
    parcels::Parcel parcel{ParcelId{static_cast<std::uint32_t>(parcels.size())},
                           {ring_from(rings.at(0)), {}}};
    for (std::size_t h = 1; h < rings.size(); ++h)
      parcel.shape.holes.push_back(ring_from(rings[h]));
    parcels.push_back(std::move(parcel));
  }
  out.parcels = std::move(parcels);
  return out;
}

/// FNV-1a over 64-bit words.
class Digest {
 public:
  void add(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) {
      value_ ^= (word >> shift) & 0xffU;
      value_ *= 1099511628211ULL;
    }
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

}  // namespace

std::uint64_t input_digest(std::span<const blocks::Block> blocks,
                           std::span<const parcels::ParcelStyle> styles) {
  Digest digest;
  for (const blocks::Block& block : blocks) {
    digest.add(std::uint64_t{block.id.value});
    for (std::size_t r = 0; r < block.edges.size(); ++r) {
      const Ring& ring = blocks::ring_at(block, r);
      digest.add(std::uint64_t{ring.size()});
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const blocks::BlockEdge& edge = block.edges[r][i];
        digest.add(ring[i].x);
        digest.add(ring[i].y);
        digest.add(std::uint64_t{edge.logical_street ? 1U + *edge.logical_street : 0U});
        digest.add(edge.street_width_m);
      }
    }
  }
  for (const parcels::ParcelStyle& style : styles) {
    digest.add(std::uint64_t{style.count});
    for (const double value :
         {style.area_mean_m2, style.area_deviation_m2, style.width_mean_m, style.width_deviation_m,
          style.aspect_ratio_mean, style.access_share_01, style.access_area_01, style.rows_mean})
      digest.add(value);
  }
  return digest.value();
}

std::optional<std::vector<DividedBlock>> CellStore::load(const std::string& name,
                                                         const std::string& key) const {
  const std::optional<json> blocks = load_note(name, key);
  if (!blocks) return std::nullopt;
  try {
    std::vector<DividedBlock> out;
    for (const json& block : *blocks) out.push_back(block_from(block));
    return out;
  } catch (const json::exception&) {
    return std::nullopt;  // not a cell of ours: it is run again
  }
}

void CellStore::save(const std::string& name, const std::string& key,
                     const std::vector<DividedBlock>& blocks) const {
  json note = json::array();
  for (const DividedBlock& block : blocks) note.push_back(block_json(block));
  save_note(name, key, note);
}

std::optional<json> CellStore::load_note(const std::string& name, const std::string& key) const {
  std::ifstream in(folder_ / (name + ".json"));
  if (!in) return std::nullopt;
  const json file = json::parse(in, nullptr, false);
  try {
    if (!file.is_object() || file.at("key") != key) return std::nullopt;
    return file.at("blocks");
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

void CellStore::save_note(const std::string& name, const std::string& key, const json& note) const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw InputError(fmt::format("{}: cannot be made: {}", folder_.string(), error.message()));
  write_file(folder_ / (name + ".json"), json{{"key", key}, {"blocks", note}}.dump());
}

}  // namespace plat::harness

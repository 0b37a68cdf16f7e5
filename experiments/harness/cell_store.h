#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/subdivision.h"

namespace plat::harness {

/// A checksum of what strategies see of a city: contours, edge labels and styles, to the last bit.
/// Other files, or another way of reading them, give another one.
std::uint64_t input_digest(std::span<const blocks::Block> blocks,
                           std::span<const parcels::ParcelStyle> styles);

/// One finished cell of the grid on disk, so that an interrupted run goes on where it stopped.
///
/// A cell's key is everything its result depends on: data set and the digest of its blocks,
/// strategy, options, fit, seed, repetition, and the commit of the program. A file with another key
/// is not taken.
class CellStore {
 public:
  /// @param folder  created when the first cell is saved
  explicit CellStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The parcels of every block, without their measures; nullopt where the cell is not there or has
  /// another key. Parcels read back are the same to the last bit.
  [[nodiscard]] std::optional<std::vector<DividedBlock>> load(const std::string& name,
                                                              const std::string& key) const;
  /// Written beside and renamed: a cell is there whole or not at all.
  void save(const std::string& name, const std::string& key,
            const std::vector<DividedBlock>& blocks) const;

  /// Anything else that is worth keeping beside the cells: the same rules.
  [[nodiscard]] std::optional<nlohmann::json> load_note(const std::string& name,
                                                        const std::string& key) const;
  void save_note(const std::string& name, const std::string& key, const nlohmann::json& note) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace plat::harness

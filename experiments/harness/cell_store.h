#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/subdivision.h"

namespace plat::harness {

/// One finished cell of the grid on disk, so that an interrupted run goes on where it stopped.
///
/// A cell's key is everything its result depends on: data set and the checksum of its files,
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

 private:
  std::filesystem::path folder_;
};

}  // namespace plat::harness

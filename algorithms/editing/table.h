#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/failure.h"

namespace plat::editing {

/// Records by id. A record is never changed in place, only replaced: who kept the one before can
/// put it back, to the last bit, and copies of a table share what they have in common.
template <class Key, class Record>
class Table {
 public:
  using Pointer = std::shared_ptr<const Record>;

  [[nodiscard]] const Record* find(Key key) const {
    return key.value < records_.size() ? records_[key.value].get() : nullptr;
  }
  [[nodiscard]] bool contains(Key key) const { return find(key) != nullptr; }
  [[nodiscard]] const Record& at(Key key) const {
    const Record* record = find(key);
    expects(record != nullptr, "the record exists");
    return *record;
  }
  [[nodiscard]] std::size_t size() const { return count_; }

  /// Calls visit(key, record) in the order of the ids.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::uint32_t i = 0; i < records_.size(); ++i) {
      if (records_[i]) visit(Key{i}, *records_[i]);
    }
  }

  /// Puts a record in, or takes it out where null; returns what was there.
  Pointer exchange(Key key, Pointer record) {
    if (key.value >= records_.size()) records_.resize(key.value + 1);
    if (records_[key.value]) --count_;
    if (record) ++count_;
    return std::exchange(records_[key.value], std::move(record));
  }

 private:
  std::vector<Pointer> records_;
  std::size_t count_ = 0;
};

}  // namespace plat::editing

#include "streets/repair.h"

#include <fmt/format.h>

#include <map>

namespace plat::streets {

std::string_view repair_name(RepairKind kind) {
  switch (kind) {
    case RepairKind::kNotFinite:
      return "not_finite";
    case RepairKind::kZeroLength:
      return "zero_length";
    case RepairKind::kDuplicate:
      return "duplicate";
    case RepairKind::kOverlap:
      return "overlap";
    case RepairKind::kSnappedEnd:
      return "snapped_end";
    case RepairKind::kRejoined:
      return "rejoined";
    case RepairKind::kOvershoot:
      return "overshoot";
    case RepairKind::kBadValue:
      return "bad_value";
    case RepairKind::kNotUsed:
      return "not_used";
  }
  return "unknown";
}

std::string summary(std::span<const Repair> repairs) {
  if (repairs.empty()) return "repairs: none";
  std::map<RepairKind, std::size_t> counts;
  for (const Repair& repair : repairs) ++counts[repair.kind];
  std::string parts;
  for (const auto& [kind, count] : counts)
    parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", count, repair_name(kind));
  return fmt::format("repairs: {} ({})", repairs.size(), parts);
}

}  // namespace plat::streets

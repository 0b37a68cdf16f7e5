#include "buildings/part_database.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/failure.h"

namespace plat::buildings {
namespace {

std::int64_t to_steps(double area_m2) {
  return static_cast<std::int64_t>(std::llround(area_m2 / kCostStep_m2));
}

/// Regions by their points: an order, so that equal sections are found in a map.
struct SectionOrder {
  static auto key(const Polygon& region) { return std::tie(region.outer, region.holes); }
  bool operator()(const CrossSection* a, const CrossSection* b) const {
    return std::ranges::lexicographical_compare(
        a->regions, b->regions, [](const Polygon& p, const Polygon& q) { return key(p) < key(q); });
  }
};

bool is_entered(PortRole role) { return role == PortRole::kLeft || role == PortRole::kBottom; }

}  // namespace

TransitionTable::TransitionTable(std::span<const CrossSection> sections)
    : section_count_(sections.size()),
      plain_(sections.size() * sections.size()),
      mirrored_(sections.size() * sections.size()) {
  for (std::size_t a = 0; a < sections.size(); ++a) {
    const CrossSection twin = mirrored(sections[a]);
    for (std::size_t b = 0; b <= a; ++b) {
      const std::size_t ab = a * section_count_ + b;
      const std::size_t ba = b * section_count_ + a;
      plain_[ab] = plain_[ba] = to_steps(disagreement_m2(sections[a], sections[b]));
      mirrored_[ab] = mirrored_[ba] = to_steps(disagreement_m2(twin, sections[b]));
    }
  }
}

TransitionTable::TransitionTable(std::size_t section_count, std::vector<std::int64_t> plain,
                                 std::vector<std::int64_t> mirrored)
    : section_count_(section_count), plain_(std::move(plain)), mirrored_(std::move(mirrored)) {
  expects(plain_.size() == section_count * section_count && mirrored_.size() == plain_.size(),
          "a cost for every pair of sections");
}

PartDatabase::PartDatabase(DatabaseInfo info, std::vector<Part> parts)
    : info_(std::move(info)), parts_(std::move(parts)) {
  index_sections();
  table_ = TransitionTable(sections_);
}

PartDatabase::PartDatabase(DatabaseInfo info, std::vector<Part> parts, TransitionTable table)
    : info_(std::move(info)), parts_(std::move(parts)), table_(std::move(table)) {
  index_sections();
  if (table_.section_count() != sections_.size())
    throw InputError(fmt::format("part database {}: the table is of {} sections, the parts have {}",
                                 info_.name, table_.section_count(), sections_.size()));
}

void PartDatabase::index_sections() {
  if (parts_.empty()) throw InputError(fmt::format("part database {}: no parts", info_.name));
  std::set<std::string> names;
  std::map<const CrossSection*, std::size_t, SectionOrder> known;
  for (Part& part : parts_) {
    if (!names.insert(part.name).second)
      throw InputError(
          fmt::format("part database {}: two parts are called {}", info_.name, part.name));
    if (!is_quantised(part)) {
      Quantised result = quantised(part);
      part = std::move(result.part);
      scalings_.push_back({part.name, result.factor});
    }
    std::vector<std::size_t>& indices = section_of_.emplace_back();
    for (const Port& port : part.ports) {
      const auto [at, is_new] = known.try_emplace(&port.section, sections_.size());
      if (is_new) sections_.push_back(port.section);
      indices.push_back(at->second);
    }
  }
}

std::size_t PartDatabase::section_of(PortRef ref) const {
  expects(ref.part < section_of_.size() && ref.port < section_of_[ref.part].size(), "a port");
  return section_of_[ref.part][ref.port];
}

std::int64_t PartDatabase::cost(PortRef a, PortRef b, Facing facing) const {
  return table_.cost(section_of(a), section_of(b), facing);
}

double PartDatabase::cost_m2(PortRef a, PortRef b, Facing facing) const {
  return static_cast<double>(cost(a, b, facing)) * kCostStep_m2;
}

bool PartDatabase::may_meet(PortRef a, PortRef b, Facing facing) const {
  return !info_.transition_limit_m2 || cost(a, b, facing) <= to_steps(*info_.transition_limit_m2);
}

std::size_t PartDatabase::transition_count() const {
  std::vector<PortRef> entered;
  std::vector<PortRef> left;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    for (std::size_t port = 0; port < parts_[part].ports.size(); ++port)
      (is_entered(parts_[part].ports[port].role) ? entered : left).push_back({part, port});
  }
  std::size_t count = 0;
  for (const PortRef from : left) {
    count += static_cast<std::size_t>(
        std::ranges::count_if(entered, [&](PortRef to) { return may_meet(from, to); }));
  }
  return count;
}

std::optional<std::size_t> PartDatabase::find(std::string_view name) const {
  const auto at = std::ranges::find(parts_, name, &Part::name);
  if (at == parts_.end()) return std::nullopt;
  return static_cast<std::size_t>(at - parts_.begin());
}

PartDatabase with_parts(const PartDatabase& database, std::vector<Part> more) {
  std::vector<Part> parts = database.parts();
  std::ranges::move(more, std::back_inserter(parts));
  return PartDatabase(database.info(), std::move(parts));
}

}  // namespace plat::buildings

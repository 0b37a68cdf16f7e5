#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "buildings/part.h"

namespace plat::buildings {

/// One port of one part: indices into PartDatabase::parts() and Part::ports.
struct PortRef {
  std::size_t part = 0;
  std::size_t port = 0;

  friend auto operator<=>(const PortRef&, const PortRef&) = default;
};

/// Whether two parts that meet have their fronts on the same side of the axis.
enum class Facing { kSame, kMirrored };

/// The step of transition costs: the search is exact on integers.
inline constexpr double kCostStep_m2 = 1e-4;

/// Disagreement of every pair of distinct sections, in steps of kCostStep_m2, rounded to nearest.
class TransitionTable {
 public:
  TransitionTable() = default;
  /// Computes it: one distance per unordered pair of sections, plain and mirrored.
  explicit TransitionTable(std::span<const CrossSection> sections);
  /// As stored: row by row, section_count^2 values each.
  TransitionTable(std::size_t section_count, std::vector<std::int64_t> plain,
                  std::vector<std::int64_t> mirrored);

  [[nodiscard]] std::size_t section_count() const { return section_count_; }
  [[nodiscard]] std::int64_t cost(std::size_t a, std::size_t b, Facing facing) const {
    return (facing == Facing::kSame ? plain_ : mirrored_)[a * section_count_ + b];
  }

  friend bool operator==(const TransitionTable&, const TransitionTable&) = default;

 private:
  std::size_t section_count_ = 0;
  std::vector<std::int64_t> plain_;
  std::vector<std::int64_t> mirrored_;
};

/// What a database is besides its parts.
struct DatabaseInfo {
  std::string name;
  std::string summary;
  std::string origin;              ///< "synthetic: ..." for those that Plat generates
  std::optional<std::string> kit;  ///< the kit it was generated from: make_corner_parts knows it
  /// Parts whose sections disagree by more do not follow each other; none: all may.
  std::optional<double> transition_limit_m2;

  friend bool operator==(const DatabaseInfo&, const DatabaseInfo&) = default;
};

/// Parts with their distinct sections and the costs between them [Har, Sec. 6.2].
///
/// Guarantees: 1. names are unique;  2. every arm is a multiple of kLengthQuantum_m;  3. the cost
/// of two ports is the area of disagreement of their sections, symmetric, 0 between equal sections.
class PartDatabase {
 public:
  /// Parts that are off the quantum are quantised; what was done is in scalings().
  /// @throws InputError where two parts have one name, or there are none
  PartDatabase(DatabaseInfo info, std::vector<Part> parts);
  /// With a table that was stored.
  /// @throws InputError where it is of another number of sections
  PartDatabase(DatabaseInfo info, std::vector<Part> parts, TransitionTable table);

  [[nodiscard]] const DatabaseInfo& info() const { return info_; }
  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  /// The distinct sections, in the order in which parts and ports first have them.
  [[nodiscard]] const std::vector<CrossSection>& sections() const { return sections_; }
  [[nodiscard]] const TransitionTable& transitions() const { return table_; }

  /// The section of a port, index into sections().
  [[nodiscard]] std::size_t section_of(PortRef ref) const;
  /// In steps of kCostStep_m2. Which port is left and which is entered makes no difference.
  [[nodiscard]] std::int64_t cost(PortRef a, PortRef b, Facing facing = Facing::kSame) const;
  [[nodiscard]] double cost_m2(PortRef a, PortRef b, Facing facing = Facing::kSame) const;
  /// Whether the cost is within the database's transition limit.
  [[nodiscard]] bool may_meet(PortRef a, PortRef b, Facing facing = Facing::kSame) const;
  /// Pairs (left by right, entered by left; floors: top, bottom) that may meet with their fronts on
  /// the same side: what the thesis counts as transitions.
  [[nodiscard]] std::size_t transition_count() const;

  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;

  struct Scaling {
    std::string part;
    double factor = 1.0;
  };
  [[nodiscard]] const std::vector<Scaling>& scalings() const { return scalings_; }

 private:
  void index_sections();

  DatabaseInfo info_;
  std::vector<Part> parts_;
  std::vector<Scaling> scalings_;
  std::vector<CrossSection> sections_;
  std::vector<std::vector<std::size_t>> section_of_;  ///< by part and port
  TransitionTable table_;
};

/// The database with more parts, costs computed anew.
PartDatabase with_parts(const PartDatabase& database, std::vector<Part> more);

/// Reads parts.json and the mesh files it names (docs/part_database.md). The transition table is
/// read from transitions.json where that is there, else computed.
/// @throws InputError with file, part and reason; where transitions.json was made of other parts
PartDatabase read_part_database(const std::filesystem::path& folder);

/// Writes parts.json, one mesh file per part, and transitions.json; the folder is made if need be.
/// Same database, same bytes.
/// @param mesh_ending  ".obj", ".ply" or ".off"
/// @throws InputError where the folder cannot be written or has other files in it
void write_part_database(const PartDatabase& database, const std::filesystem::path& folder,
                         const std::string& mesh_ending = ".ply");

}  // namespace plat::buildings

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "blocks/block.h"
#include "core/failure.h"
#include "core/planar_faces.h"
#include "parcels/parcel.h"

namespace plat::parcels {

/// An edge of a block's contour: ring (0 = outer, then holes) and index of the edge in it.
struct ContourEdge {
  std::uint32_t ring = 0;
  std::uint32_t index = 0;
  friend auto operator<=>(const ContourEdge&, const ContourEdge&) = default;
};

/// More lots than this in one block are an option out of all proportion to the block's size: a
/// failure, before they fill the memory.
inline constexpr std::size_t kMaxLotsPerBlock = 10'000;

/// A block cut into cells, and cells joined into regions: the one way in which strategies and
/// tessellations make parcels. A strategy only says where to cut and what to join; that the parcels
/// are a coverage follows from noding contour and cuts together (core/planar_graph.h, ADR 0003).
///
/// Guarantees: 1. the regions' polygons are a coverage: between two of them the same vertices on
/// both sides, bit for bit;  2. their union is the contour, with a vertex more where a cut ends on
/// it, at most kContourTolerance_m (coverage.h) off the contour's edge;  3. cuts may start, end and
/// cross anywhere: what does not separate anything is ignored, what would draw the contour off
/// itself is left out. Regions start as the single cells, numbered by where they lie along the
/// contour, inner ones last.
class BlockPartition {
 public:
  /// @param cuts  segments in the block's frame, snapped here; parts outside the block do no harm
  /// @returns     Failure kNotSimple where the contour touches itself within a grid step
  static Expected<BlockPartition> cut(const blocks::Block& block, std::span<const Segment> cuts);

  [[nodiscard]] std::size_t cell_count() const { return cell_faces_.size(); }
  [[nodiscard]] Polygon cell_polygon(std::uint32_t cell) const;
  [[nodiscard]] double cell_area_m2(std::uint32_t cell) const { return cell_areas_[cell]; }

  /// Regions by number; a number whose region was joined to another is no longer alive.
  [[nodiscard]] std::vector<std::uint32_t> regions() const;
  [[nodiscard]] std::uint32_t region_of_cell(std::uint32_t cell) const {
    return region_of_cell_[cell];
  }
  [[nodiscard]] double area_m2(std::uint32_t region) const { return region_areas_[region]; }
  [[nodiscard]] Polygon polygon(std::uint32_t region) const;

  struct Border {
    std::uint32_t neighbour = 0;
    double length_m = 0.0;
  };
  /// Regions that share a boundary with this one, ordered by number.
  [[nodiscard]] std::vector<Border> borders(std::uint32_t region) const;
  /// The neighbour with which the region shares the longest boundary; the lower number of equals.
  [[nodiscard]] std::optional<std::uint32_t> longest_neighbour(std::uint32_t region) const;
  /// Length of the region's boundary on contour edges that face a street.
  [[nodiscard]] double frontage_m(std::uint32_t region) const;

  /// A stretch of a region's boundary along one logical street.
  struct Frontage {
    std::vector<Point> line;  ///< counter-clockwise, the region on its left; at least two points
    std::uint32_t logical_street = 0;
    double street_width_m = 0.0;
  };
  /// The region's fronts, in the order of its boundary.
  [[nodiscard]] std::vector<Frontage> fronts(std::uint32_t region) const;

  /// The edges between two regions, noded: with them as cuts the same division results.
  [[nodiscard]] std::vector<Segment> inner_edges() const;
  /// Whether any edge of the region lies on the block's contour.
  [[nodiscard]] bool touches_contour(std::uint32_t region) const;

  /// Joins `other` into `region`, which keeps its number.
  void join(std::uint32_t region, std::uint32_t other);

  using IsRegion = std::function<bool(std::uint32_t)>;
  using Heir = std::function<std::optional<std::uint32_t>(std::uint32_t)>;
  /// Joins every region that `must_join` names to its longest neighbour, or the one that `heir`
  /// names, smallest first, until it names none or only one region is left.
  void join_while(const IsRegion& must_join, const Heir& heir = {});

  /// Joins every region smaller than `area_m2`, smallest first, to its longest neighbour.
  void join_slivers(double area_m2);

  /// Regions as parcels, ids in the order of the regions. A vertex where only two boundaries meet
  /// in a straight line is dropped on both sides.
  [[nodiscard]] std::vector<Parcel> parcels() const;

 private:
  static constexpr std::uint32_t kOutside = 0xffffffffU;

  void number_cells(const PlanarFaces& faces, const std::vector<bool>& is_inside);
  [[nodiscard]] std::uint32_t region_left_of(HalfEdge h) const;
  [[nodiscard]] std::vector<std::vector<HalfEdge>> boundary_walks(std::uint32_t region) const;
  [[nodiscard]] std::optional<ContourEdge> contour_edge(std::uint32_t edge) const;
  [[nodiscard]] const blocks::BlockEdge* street_at(HalfEdge h) const;

  const blocks::Block* block_ = nullptr;
  std::vector<ContourEdge> contour_edges_;  ///< by source index; sources beyond are cuts
  PlanarGraph graph_;
  std::vector<HalfEdge> next_;          ///< per half-edge: the next on its face
  std::vector<std::uint32_t> cell_of_;  ///< per half-edge, kOutside beyond the contour
  std::vector<Face> cell_faces_;
  std::vector<double> cell_areas_;
  std::vector<std::uint32_t> region_of_cell_;
  std::vector<std::vector<std::uint32_t>> cells_of_region_;  ///< empty where joined to another
  std::vector<double> region_areas_;
};

}  // namespace plat::parcels

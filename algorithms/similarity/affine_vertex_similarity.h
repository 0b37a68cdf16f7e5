#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "similarity/shape_similarity.h"

namespace plat::similarity {

/// The most corners of an outline that vertex mappings look at.
inline constexpr std::size_t kMaxMappedCorners = 16;

/// An outline as vertex mappings see it: its corners about their mean, in the frame in which
/// distortion is measured. A set of corners is a number: bit i is corner i.
struct CornerOutline {
  std::size_t count = 0;
  std::array<Point, kMaxMappedCorners> corners{};
  std::uint32_t street_corners = 0;    ///< with a street edge before or behind them
  std::uint32_t property_corners = 0;  ///< between two property edges
  double corner_area_m2 = 0.0;         ///< of the corners' polygon, > 0
  double area_m2 = 0.0;                ///< of the outline, holes not taken off
  double perimeter_m = 0.0;            ///< of the outline
  Point mean;                          ///< of the corners
  Point axis{1.0, 0.0};                ///< of the frame, in the city
  /// Sets of corners that may stay when others are removed, by their number: those of n corners end
  /// at choice_ends[n] and begin where those of n - 1 end.
  std::vector<std::uint16_t> choices;
  std::array<std::uint32_t, kMaxMappedCorners + 1> choice_ends{};
};

enum class LabelRule : std::uint8_t { kMatched, kIgnored };
enum class PerimeterUnit : std::uint8_t { kRelative, kMetres };
enum class DistortionFrame : std::uint8_t { kCityAxes, kTileAxes };

/// Lays one outline on another, corner on corner, by the affine map of least squares, and takes the
/// mapping of corners that distorts it least and misses the perimeter least.
///
/// All cyclic mappings are tried; of the outline with more corners, corners are removed one by one,
/// in every order. A removal is rejected where the triangle it adds or takes is more than
/// `area_loss_01` of the tile; a mapping where a corner at a street would come to lie on one
/// between two properties, or where the map mirrors or is singular. Of mappings with
///   e = (1 - alpha) (k_0 e_scale + k_1 e_aspect + k_2 e_shear) + alpha e_perimeter
/// the least e is the distance.
///
/// Guarantees: 1. as by plain recursion over all mappings (tested against it);  2. no rule makes a
/// distance infinite: where every mapping is rejected, labels are given up, then the bound on area
/// (corners of the smallest triangles are removed), then the affine map (a similar figure of the
/// same area on the other, centre on centre), each for kRelaxationPenalty more;  3. at most
/// max_corners over max_corners / 2 choices of corners, times cyclic shifts, are looked at: 5,544
/// mappings for 12;  4. an outline on itself: 0 to the last bit.
/// The correspondence is of corners; the transformation is the affine map of least squares on it,
/// and does not mirror; there is none where the affine map was given up.
///
/// Complexity: prepare O(n log n), and up to 4,096 sets of 12 corners; a pair of 4- to 8-gons
///             0.3 to 4 us, of a 12-gon and a pentagon 30 to 50 us
///
/// Paper:      [ABVA08, Sec. 5, Eq. 4 and 5]
/// Deviation:  outlines of more than `max_corners` are simplified, holes are not looked at; a
///             removal that adds area counts as one that takes it; e_perimeter is relative to the
///             perimeter laid on, unless metres are asked for; where `a` has fewer corners than
///             `b`, the distance is that of `b` laid on `a`; what is done where all mappings are
///             rejected (ADR 0034)
class AffineVertexSimilarity {
 public:
  static constexpr std::string_view kName = "affine_vertex";
  static constexpr std::string_view kSummary =
      "Least affine distortion and perimeter mismatch over all mappings of corners [ABVA08 5].";
  /// What each rule that is given up adds to the distance.
  static constexpr double kRelaxationPenalty = 1.0;

  struct Options {
    double scale_weight = 1.0;   ///< k_0
    double aspect_weight = 1.0;  ///< k_1
    double shear_weight = 1.0;   ///< k_2
    double alpha = 0.5;          ///< of the perimeter mismatch; 1 - alpha of the distortion
    double area_loss_01 = 0.1;   ///< largest change of area by one removal, over the tile's
    int max_corners = 12;        ///< of an outline; longer ones are simplified
    LabelRule labels = LabelRule::kMatched;
    PerimeterUnit perimeter = PerimeterUnit::kRelative;
    DistortionFrame frame = DistortionFrame::kCityAxes;
    static constexpr auto fields() {
      using O = Options;
      return std::tuple{
          Field{"scale_weight", &O::scale_weight, 0.0, 100.0, "k_0: weight of scaling."},
          Field{"aspect_weight", &O::aspect_weight, 0.0, 100.0,
                "k_1: weight of a changed aspect ratio."},
          Field{"shear_weight", &O::shear_weight, 0.0, 100.0, "k_2: weight of shearing."},
          Field{"alpha", &O::alpha, 0.0, 1.0,
                "Weight of the perimeter mismatch; distortion has 1 - alpha."},
          Field{"area_loss_01", &O::area_loss_01, 0.0, 1.0,
                "Largest change of area by the removal of one corner, over the tile's area."},
          Field{"max_corners", &O::max_corners, 3, kMaxMappedCorners,
                "Outlines with more corners are simplified, smallest triangles first."},
          EnumField<O, LabelRule, 2>{
              "labels",
              &O::labels,
              {{"matched", LabelRule::kMatched}, {"ignored", LabelRule::kIgnored}},
              "Whether corners at streets may lie on corners between properties."},
          EnumField<O, PerimeterUnit, 2>{
              "perimeter",
              &O::perimeter,
              {{"relative", PerimeterUnit::kRelative}, {"metres", PerimeterUnit::kMetres}},
              "Unit of the distances of corners: perimeters of the outline laid on, or metres."},
          EnumField<O, DistortionFrame, 2>{
              "frame",
              &O::frame,
              {{"city_axes", DistortionFrame::kCityAxes},
               {"tile_axes", DistortionFrame::kTileAxes}},
              "The unit vectors that distortion is measured on: east and north, as ABVA08, or "
              "along and across the corners' principal axis."}};
    }
  };
  struct Prepared {
    CornerOutline outline;
  };

  explicit AffineVertexSimilarity(const Options& options) : options_(options) {}

  [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const;
  [[nodiscard]] double distance(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] ShapeComparison compare(const Prepared& a, const Prepared& b) const;
  [[nodiscard]] SimilarityClaims claims() const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(ShapeSimilarity<AffineVertexSimilarity> && Registrable<AffineVertexSimilarity>);

}  // namespace plat::similarity

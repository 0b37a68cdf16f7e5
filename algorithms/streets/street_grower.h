#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/failure.h"
#include "core/options.h"
#include "core/polygon.h"
#include "core/registry.h"
#include "core/rng.h"
#include "streets/intersection_point.h"
#include "streets/street_network.h"

namespace plat::streets {

/// A street of the existing network that may go on from one of its nodes.
struct OpenEnd {
  std::uint32_t node = 0;  ///< of the existing network
  PassingStreet street{};  ///< its style
  Point heading{};         ///< unit vector: the direction in which the street would go straight on

  friend bool operator==(const OpenEnd&, const OpenEnd&) = default;
};

/// What streets are grown from.
struct GrowthSite {
  std::vector<IntersectionPoint> points;  ///< to be connected; places on the working grid
  StreetNetwork existing;                 ///< stays as it is; may be empty
  std::vector<OpenEnd> open_ends;         ///< where new streets may be joined to `existing`
  std::optional<Polygon> boundary;        ///< grown streets stay inside it; none: anywhere
  std::vector<Polygon> obstacles;         ///< water, railways: no grown street enters their inside
};

/// How a grown segment came to be; one per street of Growth::network behind the existing ones.
struct GrownSegment {
  int hierarchy = 0;
  std::uint32_t street = 0;  ///< segments of one street, from end to end, share this number
};

struct Growth {
  StreetNetwork network;                  ///< the existing streets, in their order, then the grown
  std::vector<GrownSegment> segments;     ///< of network.streets[existing count + i]
  std::vector<std::uint32_t> left_alone;  ///< points that no grown segment reached, ascending
};

/// Grows streets between attributed points.
///
/// Contract, tested over the whole registry: 1. the network is planar: streets meet at nodes only,
/// exactly, and none has zero length or runs along another;  2. the existing streets are the first
/// ones, unchanged but for the numbers of their nodes, and grown ones meet them at nodes of theirs
/// only;  3. grown streets stay inside the boundary and out of the obstacles' inside;  4. the same
/// site and stream give the same network, bit for bit;  5. grown streets have a width and a level.
/// Where an option of a strategy switches one of these off for an ablation, its sentence says so.
/// A site that cannot be used is a Failure: a coordinate that is not finite, a boundary that is not
/// a polygon, an open end at no node. A site without points is grown to its existing network.
template <class G>
concept StreetGrower = requires(const G& grower, const GrowthSite& site, Rng& rng) {
  { grower.grow(site, rng) } -> std::same_as<Expected<Growth>>;
};

/// Any strategy of the family, chosen at run time.
class AnyStreetGrower {
 public:
  template <class G>
    requires(StreetGrower<G> && Registrable<G> && !std::same_as<G, AnyStreetGrower>)
  explicit AnyStreetGrower(G grower) : self_(std::make_shared<const Model<G>>(std::move(grower))) {}

  [[nodiscard]] Expected<Growth> grow(const GrowthSite& site, Rng& rng) const {
    return self_->grow(site, rng);
  }
  [[nodiscard]] std::string_view name() const { return self_->name(); }
  [[nodiscard]] OptionMap options() const { return self_->options(); }

 private:
  struct Interface {
    virtual ~Interface() = default;
    [[nodiscard]] virtual Expected<Growth> grow(const GrowthSite&, Rng&) const = 0;
    [[nodiscard]] virtual std::string_view name() const = 0;
    [[nodiscard]] virtual OptionMap options() const = 0;
  };
  template <class G>
  struct Model final : Interface {
    explicit Model(G g) : grower(std::move(g)) {}
    [[nodiscard]] Expected<Growth> grow(const GrowthSite& site, Rng& rng) const override {
      return grower.grow(site, rng);
    }
    [[nodiscard]] std::string_view name() const override { return G::kName; }
    [[nodiscard]] OptionMap options() const override { return to_option_map(grower.options()); }
    G grower;
  };
  std::shared_ptr<const Interface> self_;
};
static_assert(StreetGrower<AnyStreetGrower>);

/// The menu of street growth strategies.
const Registry<AnyStreetGrower>& street_growers();

}  // namespace plat::streets

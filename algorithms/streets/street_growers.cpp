#include "streets/street_grower.h"

#include "streets/nearest_grower.h"
#include "streets/random_walk_grower.h"
#include "streets/relative_neighbourhood_grower.h"

namespace plat::streets {

const Registry<AnyStreetGrower>& street_growers() {
  static const Registry<AnyStreetGrower> kMenu = [] {
    Registry<AnyStreetGrower> all;
    all.add<NearestGrower>();
    all.add<RandomWalkGrower>();
    all.add<RelativeNeighbourhoodGrower>();
    return all;
  }();
  return kMenu;
}

}  // namespace plat::streets

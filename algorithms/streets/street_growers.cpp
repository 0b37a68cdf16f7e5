#include "streets/street_grower.h"

namespace plat::streets {

const Registry<AnyStreetGrower>& street_growers() {
  static const Registry<AnyStreetGrower> kMenu = [] {
    Registry<AnyStreetGrower> all;
    return all;
  }();
  return kMenu;
}

}  // namespace plat::streets

#include "parcels/block_subdivider.h"

namespace plat::parcels {

const Registry<AnyBlockSubdivider>& block_subdividers() {
  static const Registry<AnyBlockSubdivider> kMenu = [] {
    Registry<AnyBlockSubdivider> all;
    return all;
  }();
  return kMenu;
}

}  // namespace plat::parcels

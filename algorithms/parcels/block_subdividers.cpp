#include "parcels/block_subdivider.h"
#include "parcels/obb_subdivider.h"
#include "parcels/skeleton_subdivider.h"
#include "parcels/voronoi_subdivider.h"

namespace plat::parcels {

const Registry<AnyBlockSubdivider>& block_subdividers() {
  static const Registry<AnyBlockSubdivider> kMenu = [] {
    Registry<AnyBlockSubdivider> all;
    all.add<VoronoiSubdivider>();
    all.add<SkeletonSubdivider>();
    all.add<ObbSubdivider>();
    return all;
  }();
  return kMenu;
}

}  // namespace plat::parcels

#include "parcels/block_subdivider.h"
#include "parcels/border_voronoi_subdivider.h"
#include "parcels/cube_packing_subdivider.h"
#include "parcels/hybrid_subdivider.h"
#include "parcels/min_box_subdivider.h"
#include "parcels/obb_subdivider.h"
#include "parcels/parish_mueller_subdivider.h"
#include "parcels/recursive_subdivider.h"
#include "parcels/skeleton_subdivider.h"
#include "parcels/voronoi_subdivider.h"

namespace plat::parcels {

const Registry<AnyBlockSubdivider>& block_subdividers() {
  static const Registry<AnyBlockSubdivider> kMenu = [] {
    Registry<AnyBlockSubdivider> all;
    all.add<VoronoiSubdivider>();
    all.add<SkeletonSubdivider>();
    all.add<ObbSubdivider>();
    all.add<BorderVoronoiSubdivider>();
    all.add<MinBoxSubdivider>();
    all.add<CubePackingSubdivider>();
    all.add<ParishMuellerSubdivider>();
    all.add<RecursiveSubdivider>();
    all.add<HybridSubdivider>();
    return all;
  }();
  return kMenu;
}

}  // namespace plat::parcels

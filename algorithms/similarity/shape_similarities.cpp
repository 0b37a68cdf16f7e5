#include "similarity/affine_vertex_similarity.h"
#include "similarity/box_similarity.h"
#include "similarity/descriptor_similarity.h"
#include "similarity/hausdorff_similarity.h"
#include "similarity/shape_context_similarity.h"
#include "similarity/shape_similarity.h"
#include "similarity/turning_similarity.h"

namespace plat::similarity {

const Registry<AnyShapeSimilarity>& shape_similarities() {
  static const Registry<AnyShapeSimilarity> kMenu = [] {
    Registry<AnyShapeSimilarity> all;
    all.add<AffineVertexSimilarity>();
    all.add<BoxSimilarity>();
    all.add<DescriptorSimilarity>();
    all.add<HausdorffSimilarity>();
    all.add<ShapeContextSimilarity>();
    all.add<TurningSimilarity>();
    return all;
  }();
  return kMenu;
}

}  // namespace plat::similarity

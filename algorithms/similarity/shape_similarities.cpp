#include "similarity/affine_vertex_similarity.h"
#include "similarity/box_similarity.h"
#include "similarity/descriptor_similarity.h"
#include "similarity/shape_context_similarity.h"
#include "similarity/shape_similarity.h"

namespace plat::similarity {

const Registry<AnyShapeSimilarity>& shape_similarities() {
  static const Registry<AnyShapeSimilarity> kMenu = [] {
    Registry<AnyShapeSimilarity> all;
    all.add<AffineVertexSimilarity>();
    all.add<BoxSimilarity>();
    all.add<DescriptorSimilarity>();
    all.add<ShapeContextSimilarity>();
    return all;
  }();
  return kMenu;
}

}  // namespace plat::similarity

#include "similarity/shape_similarity.h"

namespace plat::similarity {

const Registry<AnyShapeSimilarity>& shape_similarities() {
  static const Registry<AnyShapeSimilarity> kMenu = [] {
    Registry<AnyShapeSimilarity> all;
    return all;
  }();
  return kMenu;
}

}  // namespace plat::similarity

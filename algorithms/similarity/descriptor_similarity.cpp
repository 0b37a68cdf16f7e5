#include "similarity/descriptor_similarity.h"

#include "similarity/shape_admission.h"

namespace plat::similarity {

Expected<DescriptorSimilarity::Prepared> DescriptorSimilarity::prepare(
    const LabelledShape& shape) const {
  if (auto defect = find_shape_defect(shape)) return tl::unexpected(std::move(*defect));
  return Prepared{descriptor_of(shape)};
}

double DescriptorSimilarity::distance(const Prepared& a, const Prepared& b) const {
  return descriptor_distance(
      a.descriptor, b.descriptor,
      {options_.zone_weight, options_.area_weight, options_.corner_count_weight,
       options_.mean_angle_weight, options_.angle_deviation_weight});
}

ShapeComparison DescriptorSimilarity::compare(const Prepared& a, const Prepared& b) const {
  return {distance(a, b), {}, {}};
}

SimilarityClaims DescriptorSimilarity::claims() const {
  return {.is_symmetric = true,
          .rotation = true,
          .reflection = true,
          .common_scale = true,
          .collinear_vertices = true};
}

}  // namespace plat::similarity

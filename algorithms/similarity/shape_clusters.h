#pragma once

#include <cstdint>
#include <span>
#include <tuple>

#include "core/options.h"
#include "core/parallel.h"
#include "similarity/labelled_shape.h"
#include "similarity/shape_descriptor.h"
#include "similarity/weighted_k_means.h"

namespace plat::similarity {

/// How shapes are put into clusters; weights as in DescriptorWeights.
struct ClusterOptions {
  double percent = 1.0;
  double zone_weight = 1.0;
  double area_weight = 1.0;
  double corner_count_weight = 0.25;
  double mean_angle_weight = 1.0;
  double angle_deviation_weight = 1.0;

  static constexpr auto fields() {
    using O = ClusterOptions;
    return std::tuple{
        Field{"percent", &O::percent, 0.01, 100.0, "clusters, per cent of the shapes"},
        Field{"zone_weight", &O::zone_weight, 0.0, 100.0, "between different zones"},
        Field{"area_weight", &O::area_weight, 0.0, 100.0, "of the difference in log area"},
        Field{"corner_count_weight", &O::corner_count_weight, 0.0, 100.0, "of a corner"},
        Field{"mean_angle_weight", &O::mean_angle_weight, 0.0, 100.0,
              "of a radian of the mean interior angle"},
        Field{"angle_deviation_weight", &O::angle_deviation_weight, 0.0, 100.0,
              "of a radian of the interior angles' deviation"}};
  }
};

/// Clusters of shapes by weighted k-means on their descriptors: the squared distance of two rows is
/// that of descriptor_distance, where both zones are known or both unknown.
///
/// Guarantees: 1. those of weighted_k_means: none empty, the same for any number of threads;  2. a
/// shape of unknown zone is at the zone's weight times sqrt(1/2) from every known one.
/// Pre: at least one shape.
///
/// Paper:      [ABVA08, Sec. 5, Fig. 4]
///
/// Deviation:  a zone is a name, not a number: each is a column of its own, so that any two zones
///             are equally far (ADR 0036)
Clusters cluster_shapes(std::span<const LabelledShape> shapes, const ClusterOptions& options,
                        std::uint64_t seed, Jobs jobs = {});

}  // namespace plat::similarity

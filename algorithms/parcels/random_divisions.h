#pragma once

#include <vector>

#include "core/rng.h"

namespace plat::parcels {

/// The ends of `count` consecutive widths that fill `length_m`, from 0 on (count + 1 numbers). The
/// widths are normal around their mean with `relative_deviation` of it, each kept between a quarter
/// and four times of it.
std::vector<double> random_divisions(double length_m, int count, double relative_deviation,
                                     Rng& rng);

}  // namespace plat::parcels

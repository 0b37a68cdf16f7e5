#pragma once

#include <optional>

#include "core/failure.h"
#include "similarity/labelled_shape.h"

namespace plat::similarity {

/// Why a shape cannot be compared by anything; nullopt where it can.
///
/// Failures: kNotFinite for a coordinate; kTooSmall for fewer than three vertices or no area;
/// kNotSimple where the outer ring is clockwise. That rings do not cross is the caller's to know
/// (find_ogc_defect): to look would cost more than most comparisons.
///
/// @throws LogicError for labels that are neither none nor one per edge
std::optional<Failure> find_shape_defect(const LabelledShape& shape);

}  // namespace plat::similarity

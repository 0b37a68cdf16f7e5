#pragma once

#include "core/rng.h"
#include "editing/editor.h"

namespace plat::testing {

/// An edit of any kind on something that the city has, of tiles too where it has any; many are
/// refused, as a user's would be.
editing::Edit random_edit(const editing::City& city, Rng& rng);

}  // namespace plat::testing

#pragma once

#include <string>

#include "editing/editor.h"

namespace plat::testing {

/// Streets of a grid, `columns` x `rows` nodes 100 m and 80 m apart from the origin, with names.
streets::StreetNetwork grid_network(int columns, int rows);
editing::City grid_city(int columns, int rows, const editing::CityOptions& options = {});

/// A grid with an island in a block, dead ends, a diagonal and streets of several widths.
streets::StreetNetwork town_network();

editing::NodeId node_near(const editing::City& city, Point p);
/// The street whose line passes nearest to `p`.
StreetId street_near(const editing::City& city, Point p);
/// The block that `p` lies in.
BlockId block_at(const editing::City& city, Point p);

/// Everything a user can see of a city, as text: equal texts are equal cities, to the last bit.
std::string bytes_of(const editing::City& city);

/// The blocks, labels and coverages are those that extract_blocks() finds in the network.
void expect_as_from_scratch(const editing::City& city);
/// The report names the blocks that differ, and no others.
void expect_exactly_changed(const editing::City& before, const editing::City& after,
                            const editing::EditReport& report);

}  // namespace plat::testing

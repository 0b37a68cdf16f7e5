#pragma once

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/point.h"
#include "streets/raw_street.h"

namespace plat::testing {

/// The places of an ASCII drawing: each letter is a point, one column or row is `step_m`, the last
/// row lies at y = 0. Lines between them are for the reader only.
inline std::map<char, Point> ascii_points(std::string_view drawing, double step_m) {
  std::vector<std::string> rows;
  std::istringstream text{std::string(drawing)};
  for (std::string row; std::getline(text, row);) rows.push_back(row);
  while (!rows.empty() && rows.front().find_first_not_of(' ') == std::string::npos)
    rows.erase(rows.begin());
  while (!rows.empty() && rows.back().find_first_not_of(' ') == std::string::npos) rows.pop_back();
  std::map<char, Point> places;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const char letter = rows[r][c];
      if ((letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z'))
        places[letter] = {step_m * static_cast<double>(c),
                          step_m * static_cast<double>(rows.size() - 1 - r)};
    }
  }
  return places;
}

/// Streets along the letters of each way: {"AB", "BCD"}; a way's source id is its letters.
inline std::vector<streets::RawStreet> streets_on(const std::map<char, Point>& places,
                                                  const std::vector<std::string>& ways) {
  std::vector<streets::RawStreet> out;
  for (const std::string& way : ways) {
    streets::RawStreet street;
    street.source_id = way;
    street.attributes.street_class = "residential";
    for (const char letter : way) street.line.push_back(places.at(letter));
    out.push_back(std::move(street));
  }
  return out;
}

}  // namespace plat::testing

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sequences/search_graph.h"

namespace plat::sequences {

/// Index into `SequenceDatabase::elements`.
using ElementIndex = std::uint32_t;

/// The sides of an element that touch a neighbour. As seen from the front, a row of elements runs
/// from left to right: each one's `kRight` meets the next one's `kLeft`. A branching element has a
/// stem besides [Har, Fig. 6.4].
enum class Port : std::uint8_t { kLeft = 0, kRight = 1, kStem = 2 };
inline constexpr std::size_t kPortCount = 3;

/// A resource and its quantum: amounts are whole multiples of `step` [Har, Sec. 3.3.1].
struct Resource {
  std::string name;   ///< with its unit, e.g. "length_m"
  double step = 1.0;  ///< in the resource's unit
};

/// What sequences are made of [Har, Sec. 3.2].
struct Element {
  std::string name;
  std::vector<std::string> classes = {};  ///< what key points ask for, e.g. "corner_90"
  std::vector<Amount> uses = {};          ///< by resource
  /// By port, then by resource: what the element consumes of the segment at that port when it
  /// stands at a key point, e.g. the two arms of a corner. Empty: nothing. Between key points, and
  /// towards the bounds of the whole, an element counts with `uses`.
  std::vector<std::vector<Amount>> arms = {};
  bool is_filling = true;  ///< may stand between key points, and in a plain sequence
  bool is_front = true;    ///< may begin a sequence whose first end is free
  bool is_back = true;     ///< may end a sequence whose last end is free
};

/// Two elements may be neighbours: `from`'s port touches `to`'s port. Read from left to right; a
/// segment that is walked against its front reads it the other way round.
struct Transition {
  ElementIndex from = 0;
  ElementIndex to = 0;
  Port from_port = Port::kRight;
  Port to_port = Port::kLeft;
  Cost cost = 0;                  ///< delta of [Har, Eq. 3.1], in quanta of `cost_step`
  std::vector<Amount> uses = {};  ///< by resource, beside those of the elements; empty: nothing
};

/// The elements, what they consume and who may follow whom: D of [Har, Sec. 3.2].
struct SequenceDatabase {
  std::vector<Resource> resources;
  double cost_step = 1.0;
  std::vector<Element> elements;
  std::vector<Transition> transitions;  ///< parallel ones allowed
};

}  // namespace plat::sequences

#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace plat {

/// How many threads a loop may use; 0 means all that the machine has.
struct Jobs {
  int count = 0;
};

/// Calls body(i) for i in 0 .. n-1, on several threads, in no particular order. `body` must only
/// write what belongs to i: then the result cannot depend on the thread count. The first exception
/// thrown is thrown again here.
void parallel_for(std::size_t n, Jobs jobs, const std::function<void(std::size_t)>& body);

/// The values body(0), body(1), ... in order. T must be default-constructible.
template <class T, class Body>
std::vector<T> parallel_map(std::size_t n, Jobs jobs, Body body) {
  std::vector<T> out(n);
  parallel_for(n, jobs, [&](std::size_t i) { out[i] = body(i); });
  return out;
}

}  // namespace plat

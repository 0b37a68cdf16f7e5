#include "similarity/prepared_shapes.h"

#include <utility>

namespace plat::similarity {

PreparedShapes prepare_all(std::span<const LabelledShape> shapes, const AnyShapeSimilarity& measure,
                           Jobs jobs) {
  PreparedShapes out;
  out.shapes.resize(shapes.size());
  std::vector<std::optional<Failure>> failures(shapes.size());
  parallel_for(shapes.size(), jobs, [&](std::size_t i) {
    auto prepared = measure.prepare(shapes[i]);
    if (prepared) {
      out.shapes[i] = std::move(*prepared);
    } else {
      failures[i] = std::move(prepared.error());
    }
  });
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    if (failures[i]) out.failures.push_back({i, std::move(*failures[i])});
  }
  return out;
}

}  // namespace plat::similarity

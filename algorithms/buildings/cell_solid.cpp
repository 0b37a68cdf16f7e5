#include "buildings/cell_solid.h"

#include <algorithm>
#include <array>
#include <map>

namespace plat::buildings {
namespace {

/// Grid lines nearer than this are one: coordinates of kits are multiples of a millimetre, what is
/// less comes of rounding.
constexpr double kSameLine_m = 1e-6;

std::vector<double> distinct(std::vector<double> values) {
  std::ranges::sort(values);
  const auto last = std::unique(values.begin(), values.end(),
                                [](double kept, double next) { return next - kept < kSameLine_m; });
  values.erase(last, values.end());
  return values;
}

std::size_t line_at(const std::vector<double>& lines, double value) {
  const auto at = std::ranges::lower_bound(lines, value - kSameLine_m);
  return static_cast<std::size_t>(at - lines.begin());
}

using Index3 = std::array<std::size_t, 3>;

/// The cells between grid lines, and the surface between full and empty ones.
class Cells {
 public:
  explicit Cells(std::array<std::vector<double>, 3> lines) : lines_(std::move(lines)) {
    for (std::size_t axis = 0; axis < 3; ++axis) count_[axis] = lines_[axis].size() - 1;
    cells_.assign(count_[0] * count_[1] * count_[2], 0);
  }

  void set(const Box3& box, std::uint32_t cell) {
    const Index3 low{line_at(lines_[0], box.low.x), line_at(lines_[1], box.low.y),
                     line_at(lines_[2], box.low.z)};
    const Index3 high{line_at(lines_[0], box.high.x), line_at(lines_[1], box.high.y),
                      line_at(lines_[2], box.high.z)};
    for (std::size_t x = low[0]; x < high[0]; ++x) {
      for (std::size_t y = low[1]; y < high[1]; ++y) {
        for (std::size_t z = low[2]; z < high[2]; ++z) cells_[offset({x, y, z})] = cell;
      }
    }
  }

  Mesh surface(const CellSolid::Placement& place) {
    mesh_ = {};
    vertex_of_.clear();
    Index3 at{};
    for (at[0] = 0; at[0] < count_[0]; ++at[0]) {
      for (at[1] = 0; at[1] < count_[1]; ++at[1]) {
        for (at[2] = 0; at[2] < count_[2]; ++at[2]) {
          if (cells_[offset(at)] != 0) add_sides(at, place);
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::size_t offset(const Index3& at) const {
    return (at[0] * count_[1] + at[1]) * count_[2] + at[2];
  }

  [[nodiscard]] bool is_empty_beyond(Index3 at, std::size_t axis, bool is_high) const {
    if (is_high ? at[axis] + 1 == count_[axis] : at[axis] == 0) return true;
    at[axis] += is_high ? 1 : std::size_t(-1);
    return cells_[offset(at)] == 0;
  }

  void add_sides(const Index3& at, const CellSolid::Placement& place) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool is_high : {false, true}) {
        if (is_empty_beyond(at, axis, is_high)) add_side(at, axis, is_high, place);
      }
    }
  }

  /// The four corners walk around the outward axis: (axis + 1, axis + 2) is right-handed.
  void add_side(const Index3& at, std::size_t axis, bool is_high,
                const CellSolid::Placement& place) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    std::array<Index3, 4> corners{at, at, at, at};
    for (Index3& corner : corners) corner[axis] += is_high ? 1 : 0;
    ++corners[1][u];
    ++corners[2][u];
    ++corners[2][v];
    ++corners[3][v];
    if (!is_high) std::swap(corners[1], corners[3]);
    std::array<std::uint32_t, 4> ring{};
    for (std::size_t k = 0; k < 4; ++k) ring[k] = vertex(corners[k], place);
    const Point3 middle = place(0.5 * (grid_point(corners[0]) + grid_point(corners[2])));
    const auto miss = [&](std::size_t a, std::size_t b) {
      return length(0.5 * (mesh_.vertices[ring[a]] + mesh_.vertices[ring[b]]) - middle);
    };
    // Where the face is flat both diagonals will do: the first, whatever the last digits say.
    const std::size_t start = miss(1, 3) < miss(0, 2) - kSameLine_m ? 1 : 0;
    for (const std::size_t turn : {std::size_t{0}, std::size_t{2}}) {
      Face& face = mesh_.faces.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) face.vertices[k] = ring[(start + turn + k) % 4];
      face.material = cells_[offset(at)] - 1;
    }
  }

  [[nodiscard]] Point3 grid_point(const Index3& at) const {
    return {lines_[0][at[0]], lines_[1][at[1]], lines_[2][at[2]]};
  }

  std::uint32_t vertex(const Index3& at, const CellSolid::Placement& place) {
    const auto [found, is_new] =
        vertex_of_.try_emplace(at, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(place(grid_point(at)));
    return found->second;
  }

  std::array<std::vector<double>, 3> lines_;
  Index3 count_{};
  std::vector<std::uint32_t> cells_;
  Mesh mesh_;
  std::map<Index3, std::uint32_t> vertex_of_;
};

bool has_volume(const Box3& box) {
  return box.high.x - box.low.x > kSameLine_m && box.high.y - box.low.y > kSameLine_m &&
         box.high.z - box.low.z > kSameLine_m;
}

}  // namespace

void CellSolid::fill(const Box3& box, std::uint32_t material) {
  if (has_volume(box)) steps_.push_back({box, material + 1});
}

void CellSolid::carve(const Box3& box) {
  if (has_volume(box)) steps_.push_back({box, 0});
}

std::vector<double> CellSolid::xs() const {
  std::vector<double> out = extra_x_;
  for (const Step& step : steps_) out.insert(out.end(), {step.box.low.x, step.box.high.x});
  return distinct(std::move(out));
}

std::vector<double> CellSolid::ys() const {
  std::vector<double> out = extra_y_;
  for (const Step& step : steps_) out.insert(out.end(), {step.box.low.y, step.box.high.y});
  return distinct(std::move(out));
}

Mesh CellSolid::surface(const Placement& place) const {
  if (steps_.empty()) return {};
  std::vector<double> zs;
  for (const Step& step : steps_) zs.insert(zs.end(), {step.box.low.z, step.box.high.z});
  Cells cells({xs(), ys(), distinct(std::move(zs))});
  for (const Step& step : steps_) cells.set(step.box, step.cell);
  return cells.surface(place);
}

}  // namespace plat::buildings

#include <algorithm>
#include <cmath>

#include "tiles/layout_equations_internal.h"

namespace plat::tiles::detail {
namespace {

/// Per tile: root mean square distance of its joints' points from its centroid, no less than its
/// radius. Points across a street may be much farther out than a tile is large.
std::vector<double> reaches_m(const TileGraph& graph) {
  std::vector<double> sum(graph.tiles.size());
  std::vector<double> count(graph.tiles.size());
  const auto add = [&](std::uint32_t tile, Point rest) {
    sum[tile] += squared_length(rest - graph.tiles[tile].centroid);
    ++count[tile];
  };
  for (const Joint& joint : graph.joints) {
    add(joint.a, joint.rest_a);
    add(joint.b, joint.rest_b);
  }
  std::vector<double> out(graph.tiles.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double mean = count[i] > 0.0 ? sum[i] / count[i] : 0.0;
    out[i] = std::max(graph.tiles[i].radius_m, std::sqrt(mean));
  }
  return out;
}

}  // namespace

LayoutEquations::LayoutEquations(const TileGraph& graph, const SolverOptions& options)
    : graph_(&graph),
      rigidity_(options.rigidity),
      street_weight_(options.street_weight),
      keep_size_(options.keep_size),
      reach_m_(reaches_m(graph)) {}

void LayoutEquations::set_state(State& state, std::uint32_t tile, const Affine& placement) const {
  const Complex x_axis(placement.xx, placement.yx);
  const Complex y_axis(placement.xy, placement.yy);
  const Complex turned = Complex(0.0, -1.0) * y_axis;
  const Eigen::Index first = static_cast<Eigen::Index>(tile) * kUnknownsPerTile;
  state[first] = complex_of(placement(graph_->tiles[tile].centroid));
  state[first + 1] = reach_m_[tile] * 0.5 * (x_axis + turned);
  state[first + 2] = reach_m_[tile] * 0.5 * (x_axis - turned);
}

Affine LayoutEquations::placement(const State& state, std::uint32_t tile) const {
  const Eigen::Index first = static_cast<Eigen::Index>(tile) * kUnknownsPerTile;
  const Complex a = state[first + 1] / reach_m_[tile];
  const Complex b = state[first + 2] / reach_m_[tile];
  const Complex x_axis = a + b;
  const Complex y_axis = Complex(0.0, 1.0) * (a - b);
  Affine out{x_axis.real(), y_axis.real(), x_axis.imag(), y_axis.imag(), {}};
  out.shift = point_of(state[first]) - out.linear(graph_->tiles[tile].centroid);
  return out;
}

Equation LayoutEquations::gap(const Joint& joint) const {
  Equation out;
  out.weight = joint_weight(joint);
  const auto add = [&](std::uint32_t tile, Point rest, double sign) {
    const Complex d = complex_of(rest - graph_->tiles[tile].centroid) / reach_m_[tile];
    const std::uint32_t first = tile * kUnknownsPerTile;
    out.terms[out.size++] = {first, sign};
    out.terms[out.size++] = {first + 1, sign * d};
    out.terms[out.size++] = {first + 2, sign * std::conj(d)};
  };
  add(joint.a, joint.rest_a, 1.0);
  add(joint.b, joint.rest_b, -1.0);
  return out;
}

Equation LayoutEquations::common_map(const Joint& joint, std::uint32_t part) const {
  const double reach = 0.5 * (reach_m_[joint.a] + reach_m_[joint.b]);
  Equation out;
  out.weight = kCommonMapWeight * joint_weight(joint);
  out.terms[0] = {joint.a * kUnknownsPerTile + part, reach / reach_m_[joint.a]};
  out.terms[1] = {joint.b * kUnknownsPerTile + part, -reach / reach_m_[joint.b]};
  out.size = 2;
  return out;
}

Equation LayoutEquations::deformation(std::uint32_t tile) const {
  Equation out;
  out.weight = rigidity_ * graph_->tiles[tile].rigidity;
  out.terms[0] = {tile * kUnknownsPerTile + 2, 2.0 * graph_->tiles[tile].radius_m / reach_m_[tile]};
  out.size = 1;
  return out;
}

Equation LayoutEquations::size(std::uint32_t tile) const {
  Equation out;
  out.weight = rigidity_ * graph_->tiles[tile].rigidity * keep_size_;
  out.terms[0] = {tile * kUnknownsPerTile + 1, 2.0 * graph_->tiles[tile].radius_m / reach_m_[tile]};
  out.size = 1;
  return out;
}

Complex LayoutEquations::size_wish(const State& state, std::uint32_t tile) const {
  const Complex a = state[static_cast<Eigen::Index>(tile) * kUnknownsPerTile + 1];
  const double norm = std::abs(a);
  return 2.0 * graph_->tiles[tile].radius_m * (norm > 0.0 ? a / norm : Complex(1.0));
}

}  // namespace plat::tiles::detail

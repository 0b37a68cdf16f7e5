#include "streets/segment_index.h"

#include <numeric>

namespace plat::streets {

SegmentIndex::SegmentIndex(std::vector<Segment> segments) : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  double total_m = 0.0;
  for (const Segment& s : segments_) {
    bounds_.add(s.a);
    bounds_.add(s.b);
    total_m += length(s);
  }
  const auto count = static_cast<double>(segments_.size());
  cell_m_ = std::max({total_m / count, std::sqrt(bounds_.width() * bounds_.height() / count) / 2.0,
                      std::max(bounds_.width(), bounds_.height()) / 2048.0, 0.5});
  columns_ = static_cast<std::int64_t>(bounds_.width() / cell_m_) + 1;
  rows_ = static_cast<std::int64_t>(bounds_.height() / cell_m_) + 1;
  const auto for_each_cell = [&](const Segment& s, auto visit) {
    Box box;
    box.add(s.a);
    box.add(s.b);
    const auto [c0, r0] = cell(box.min);
    const auto [c1, r1] = cell(box.max);
    for (std::int64_t r = r0; r <= r1; ++r) {
      for (std::int64_t c = c0; c <= c1; ++c) visit(static_cast<std::size_t>(r * columns_ + c));
    }
  };
  offsets_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const Segment& s : segments_) for_each_cell(s, [&](std::size_t b) { ++offsets_[b + 1]; });
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  items_.resize(offsets_.back());
  std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::uint32_t i = 0; i < segments_.size(); ++i)
    for_each_cell(segments_[i], [&](std::size_t b) { items_[next[b]++] = i; });
}

}  // namespace plat::streets

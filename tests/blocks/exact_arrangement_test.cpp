// The oracle of noding and faces: CGAL's arrangement with an exact kernel. CGAL is in this file of
// the tests only.
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/planar_faces.h"
#include "core/working_grid.h"
#include "geodata/layer_io.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"
#include "support/data_folder.h"
#include "support/property.h"

namespace plat {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Arrangement = CGAL::Arrangement_2<CGAL::Arr_segment_traits_2<Kernel>>;

struct FaceSummary {
  std::size_t bounded_faces = 0;
  double area_m2 = 0.0;  ///< of what the outer boundaries enclose, islands left out
  std::size_t islands = 0;
};

/// The same edges as an exact arrangement: nothing crosses in it any more if noding is right.
FaceSummary exact_faces(const std::vector<Segment>& segments, bool expect_noded) {
  std::vector<Kernel::Segment_2> curves;
  for (const Segment& s : segments) {
    if (s.a != s.b)
      curves.emplace_back(Kernel::Point_2(s.a.x, s.a.y), Kernel::Point_2(s.b.x, s.b.y));
  }
  Arrangement arrangement;
  CGAL::insert(arrangement, curves.begin(), curves.end());
  if (expect_noded) {
    EXPECT_EQ(arrangement.number_of_edges(), curves.size());
  }
  FaceSummary out;
  const auto walk_area = [](Arrangement::Ccb_halfedge_const_circulator first) {
    Kernel::FT twice(0);
    auto h = first;
    do {
      const auto& p = h->source()->point();
      const auto& q = h->target()->point();
      twice += p.x() * q.y() - p.y() * q.x();
    } while (++h != first);
    return 0.5 * CGAL::to_double(twice);
  };
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) {
    if (f->is_unbounded()) continue;
    ++out.bounded_faces;
    out.area_m2 += walk_area(f->outer_ccb());
    for (auto i = f->inner_ccbs_begin(); i != f->inner_ccbs_end(); ++i) {
      out.area_m2 += walk_area(*i);  // clockwise: negative
      ++out.islands;
    }
  }
  return out;
}

FaceSummary own_faces(const PlanarGraph& graph) {
  const PlanarFaces faces = find_faces(graph);
  FaceSummary out;
  for (const Face& face : faces.faces) {
    ++out.bounded_faces;
    out.islands += face.islands.size();
    out.area_m2 += signed_area_m2(ring_of(graph, face.outer));
    for (const auto& island : face.islands) out.area_m2 += signed_area_m2(ring_of(graph, island));
  }
  return out;
}

std::vector<Segment> edges_of(const PlanarGraph& graph) {
  std::vector<Segment> out;
  for (const auto& e : graph.edges) out.push_back({graph.nodes[e.from], graph.nodes[e.to]});
  return out;
}

void expect_same(const FaceSummary& own, const FaceSummary& exact) {
  EXPECT_EQ(own.bounded_faces, exact.bounded_faces);
  EXPECT_EQ(own.islands, exact.islands);
  EXPECT_NEAR(own.area_m2, exact.area_m2, 1e-6 * (1.0 + exact.area_m2));
}

TEST(ExactArrangement, NodedRandomSegmentsHaveItsFacesToTheLastOne) {
  Rng rng = plat::testing::property_rng("NodedRandomSegmentsHaveItsFacesToTheLastOne");
  std::size_t faces = 0;
  for (int i = 0; i < plat::testing::iterations(12); ++i) {
    std::vector<Segment> segments;
    const double length = i % 2 == 0 ? 40.0 : 8.0;  // dense, and falling apart into components
    for (int k = 0; k < 250; ++k) {
      const Point a{rng.uniform(0, 200), rng.uniform(0, 200)};
      segments.push_back(
          {a, a + Point{rng.uniform(-length, length), rng.uniform(-length, length)}});
    }
    const PlanarGraph graph = node_segments(segments);
    const FaceSummary own = own_faces(graph);
    expect_same(own, exact_faces(edges_of(graph), true));
    faces += own.bounded_faces;
  }
  EXPECT_GT(faces, 1000U);
}

TEST(ExactArrangement, RoundingCrossingsMovesTheAreaByLessThanTheGrid) {
  // Raw segments against their noded twins: rounding may close or open slivers, so areas only.
  Rng rng = plat::testing::property_rng("RoundingCrossingsMovesTheAreaByLessThanTheGrid");
  for (int i = 0; i < plat::testing::iterations(4); ++i) {
    std::vector<Segment> segments;
    double total_m = 0.0;
    for (int k = 0; k < 150; ++k) {
      const Point a = snap({rng.uniform(0, 200), rng.uniform(0, 200)});
      segments.push_back({a, snap(a + Point{rng.uniform(-60, 60), rng.uniform(-60, 60)})});
      total_m += length(segments.back());
    }
    const FaceSummary own = own_faces(node_segments(segments));
    const FaceSummary exact = exact_faces(segments, false);
    EXPECT_NEAR(own.area_m2, exact.area_m2, kGridStep_m * total_m);
  }
}

TEST(ExactArrangement, GridOfStreetsHasTheFacesThatOneCounts) {
  std::vector<Segment> segments;
  for (int i = 0; i <= 12; ++i) {
    // Turned, so that no crossing lies on the grid.
    const auto turned = [](double x, double y) {
      return Point{0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y};
    };
    segments.push_back({turned(7.3 * i, 0), turned(7.3 * i, 87.6)});
    segments.push_back({turned(0, 7.3 * i), turned(87.6, 7.3 * i)});
  }
  const PlanarGraph graph = node_segments(segments);
  EXPECT_EQ(own_faces(graph).bounded_faces, 144U);
  expect_same(own_faces(graph), exact_faces(edges_of(graph), true));
}

/// The streets of a file that pass within `radius_m` of the local origin, cleaned.
std::vector<Segment> cropped_streets(const geodata::LayerSource& source, Point center,
                                     double radius_m) {
  const std::vector<streets::RawStreet> all =
      streets::import_streets(geodata::read_layer(source)).streets;
  std::vector<streets::RawStreet> near;
  for (const streets::RawStreet& street : all) {
    const bool is_near = std::any_of(street.line.begin(), street.line.end(),
                                     [&](Point p) { return distance(p, center) < radius_m; });
    if (is_near && street.attributes.level == 0) near.push_back(street);
  }
  std::vector<Segment> out;
  for (const streets::Street& street : streets::build_network(near).network.streets) {
    for (std::size_t i = 1; i < street.line.size(); ++i)
      out.push_back({street.line[i - 1], street.line[i]});
  }
  return out;
}

void expect_exact_faces(const std::vector<Segment>& segments, std::size_t least_faces) {
  const PlanarGraph graph = node_segments(segments);
  EXPECT_EQ(graph.edges.size(), segments.size());  // build_network() left nothing to node
  const FaceSummary own = own_faces(graph);
  expect_same(own, exact_faces(edges_of(graph), true));
  EXPECT_GT(own.bounded_faces, least_faces);
}

TEST(ExactArrangement, MontevideoCroppedHasItsFaces) {
  PLAT_REAL_DATA_OR_SKIP(file, "montevideo_uy/montevideo_osm.gpkg");
  expect_exact_faces(cropped_streets({file, "roads"}, {0, 0}, 2500.0), 200);
}

TEST(ExactArrangement, SanFranciscoHasItsFaces) {
  PLAT_REAL_DATA_OR_SKIP(file, "san_francisco_us/san_francisco_us.gpkg");
  expect_exact_faces(cropped_streets({file, "road"}, {0, 0}, 5000.0), 200);
}

TEST(ExactArrangement, CambridgeHasItsFaces) {
  PLAT_REAL_DATA_OR_SKIP(file, "cambridge_ma/cambridge_ma.gpkg");
  expect_exact_faces(cropped_streets({file, "streets"}, {0, 0}, 2000.0), 100);
}

}  // namespace
}  // namespace plat

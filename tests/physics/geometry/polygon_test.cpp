#include "physics/geometry/polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "physics/geometry/predicates.h"

namespace urto {
namespace {

using Points = std::vector<Vec2>;

// Relative to the extent: what decompose_polygon() may move the outline by (its kFlatness).
constexpr double kOutlineTolerance = 1e-6;

double area_of(const Points& points) { return polygon_area_properties(points).area; }

// Even-odd rule; points on the outline may fall either way.
bool inside(const Points& polygon, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 a = polygon[i], b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      in = !in;
    }
  }
  return in;
}

double distance_to_outline(const Points& polygon, const Vec2& p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
    const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - a - t * edge).norm());
  }
  return best;
}

Points star(std::mt19937_64& random, std::size_t n) {
  std::uniform_real_distribution<double> radius(0.2, 3.0);
  Points points;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n);
    points.push_back(radius(random) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

bool crosses(const Points& p, std::size_t i, std::size_t j) {
  const std::size_t n = p.size();
  if (j == i + 1 || (i == 0 && j == n - 1)) return false;
  return segments_meet(p[i], p[(i + 1) % n], p[j], p[(j + 1) % n]);
}

// Random points, whose tour is reversed between two crossing edges until none cross (each reversal shortens it).
Points untangled(std::mt19937_64& random, std::size_t n) {
  std::uniform_real_distribution<double> coordinate(-5, 5);
  Points points;
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(coordinate(random), coordinate(random));
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < n && !again; ++i) {
      for (std::size_t j = i + 1; j < n && !again; ++j) {
        if (!crosses(points, i, j)) continue;
        std::reverse(points.begin() + static_cast<long>(i) + 1, points.begin() + static_cast<long>(j) + 1);
        again = true;
      }
    }
  }
  return points;
}

void expect_convex(const Points& part) {
  ASSERT_GE(part.size(), 3u);
  ASSERT_LE(part.size(), kPolygonVerticesMax);
  for (std::size_t i = 0; i < part.size(); ++i) {
    EXPECT_EQ(orientation(part[i], part[(i + 1) % part.size()], part[(i + 2) % part.size()]), 1);
  }
}

void expect_decomposes(const Points& polygon, std::mt19937_64& random) {
  const auto parts = decompose_polygon(polygon);
  ASSERT_TRUE(parts) << parts.error().field << ": " << parts.error().message;
  Vec2 low = polygon[0], high = polygon[0];
  double length = 0, sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    low = low.cwiseMin(polygon[i]);
    high = high.cwiseMax(polygon[i]);
    length += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  }
  const double tolerance = kOutlineTolerance * (high - low).maxCoeff();
  for (const Points& part : *parts) {
    expect_convex(part);
    sum += area_of(part);
  }
  EXPECT_NEAR(sum, std::abs(area_of(polygon)), tolerance * length + 1e-12 * sum);
  EXPECT_LE(parts->size(), polygon.size() - 2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int sample = 0; sample < 200; ++sample) {
    const Vec2 p = low + Vec2(unit(random) * (high - low).x(), unit(random) * (high - low).y());
    if (distance_to_outline(polygon, p) <= 2 * tolerance) continue;
    int holders = 0;
    bool on_seam = false;
    for (const Points& part : *parts) {
      on_seam = on_seam || distance_to_outline(part, p) <= 2 * tolerance;
      holders += inside(part, p) ? 1 : 0;
    }
    if (!on_seam) {
      EXPECT_EQ(holders, inside(polygon, p) ? 1 : 0) << "at " << p.transpose();
    }
  }
}

Error error_of(const Points& polygon) {
  const auto parts = decompose_polygon(polygon);
  EXPECT_FALSE(parts);
  return parts ? Error{} : parts.error();
}

TEST(PolygonTest, BoxAsPolygonHasTheRectanglesMoment) {
  const Points box{{1, 2}, {4, 2}, {4, 4}, {1, 4}};
  const AreaProperties p = polygon_area_properties(box);
  const AreaProperties q = box_area_properties(3, 2, {2.5, 3});
  EXPECT_DOUBLE_EQ(p.area, 6);
  EXPECT_NEAR((p.centroid - q.centroid).norm(), 0, 1e-15);
  EXPECT_NEAR(p.second_moment, q.second_moment, 1e-14);
  EXPECT_DOUBLE_EQ(q.second_moment, 6.0 * (9 + 4) / 12);  // m (w² + h²)/12, as the thesis has it
}

TEST(PolygonTest, TriangleAreaCentroidAndMomentInClosedForm) {
  const Points triangle{{0, 0}, {6, 0}, {0, 3}};
  const AreaProperties p = polygon_area_properties(triangle);
  EXPECT_DOUBLE_EQ(p.area, 9);
  EXPECT_NEAR((p.centroid - Vec2(2, 1)).norm(), 0, 1e-15);
  // A/36 · (sum of the squared sides).
  EXPECT_NEAR(p.second_moment, 9.0 / 36 * (36 + 9 + 45), 1e-13);
}

TEST(PolygonTest, MomentDoesNotSufferFarFromTheOrigin) {
  Points box{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (Vec2& v : box) v += Vec2(65536, -65536);
  EXPECT_NEAR(polygon_area_properties(box).second_moment, 1.0 / 6, 1e-15);
}

TEST(PolygonTest, ManySidedPolygonApproachesTheDisc) {
  Points points;
  for (int i = 0; i < 20000; ++i) {
    const double angle = 6.283185307179586 * i / 20000;
    points.emplace_back(2 * std::cos(angle) + 7, 2 * std::sin(angle));
  }
  const AreaProperties p = polygon_area_properties(points), q = circle_area_properties(2, {7, 0});
  // The area of an inscribed n-gon is short by (2π²/3)/n² of itself, its moment by about twice that.
  EXPECT_NEAR(p.area, q.area, q.area * 2e-8);
  EXPECT_NEAR(p.second_moment, q.second_moment, q.second_moment * 4e-8);
  EXPECT_NEAR((p.centroid - q.centroid).norm(), 0, 1e-12);
}

TEST(PolygonTest, SmallConvexPolygonIsReturnedCounterClockwise) {
  const Points box{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Points clockwise(box.rbegin(), box.rend());
  ASSERT_EQ(decompose_polygon(box)->size(), 1u);
  EXPECT_EQ(decompose_polygon(box)->front(), box);
  EXPECT_EQ(decompose_polygon(clockwise)->front(), box);
}

TEST(PolygonTest, CollinearVerticesAreLeftOut) {
  const Points box{{0, 0}, {0.5, 0}, {0.75, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0, 1}, {0, 0.3}};
  const auto parts = decompose_polygon(box);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 1u);
  EXPECT_THAT(parts->front(), testing::UnorderedElementsAre(Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)));
}

TEST(PolygonTest, FineArcKeepsItsShape) {
  // 60 vertices within 3 mrad: each is nearer than the tolerance to its neighbours' line, all together are not.
  Points points{{0, 0}};
  for (int i = 0; i < 60; ++i) points.emplace_back(10 * std::cos(5e-5 * i), 10 * std::sin(5e-5 * i));
  const auto parts = decompose_polygon(points);
  ASSERT_TRUE(parts);
  double sum = 0;
  for (const Points& part : *parts) sum += area_of(part);
  EXPECT_NEAR(sum, area_of(points), 0.03 * kOutlineTolerance * 10);
}

TEST(PolygonTest, ConvexPolygonOf64VerticesTakesTheLeastNumberOfParts) {
  Points points;
  for (int i = 0; i < 64; ++i)
    points.emplace_back(std::cos(6.283185307179586 * i / 64), std::sin(6.283185307179586 * i / 64));
  std::mt19937_64 random(1);
  expect_decomposes(points, random);
  EXPECT_EQ(decompose_polygon(points)->size(), 11u);  // ⌈62/6⌉
}

TEST(PolygonTest, KnownConcaveShapesNeedFewParts) {
  const Points ell{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const Points cross{{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  const Points arrow{{0, 0}, {2, 1}, {0, 2}, {0.5, 1}};
  std::mt19937_64 random(2);
  for (const Points& shape : {ell, cross, arrow}) expect_decomposes(shape, random);
  EXPECT_EQ(decompose_polygon(ell)->size(), 2u);
  EXPECT_LE(decompose_polygon(cross)->size(), 5u);
  EXPECT_EQ(decompose_polygon(arrow)->size(), 2u);
}

TEST(PolygonTest, RandomStarsDecompose) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    Points polygon = star(random, 5 + seed % 60);
    if (seed % 2) std::reverse(polygon.begin(), polygon.end());
    expect_decomposes(polygon, random);
    if (HasFailure()) return;
  }
}

TEST(PolygonTest, RandomSimplePolygonsDecompose) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    expect_decomposes(untangled(random, 5 + seed % 60), random);
    if (HasFailure()) return;
  }
}

TEST(PolygonTest, GridPolygonsWithManyAlignedVerticesDecompose) {
  // Combs: every tooth's vertices lie on common lines, where a rounded predicate would go wrong.
  for (int teeth = 1; teeth <= 15; ++teeth) {
    Points comb{{0, 0}, {0.1 * (2 * teeth + 1), 0}};
    for (int i = teeth; i >= 0; --i) {
      comb.emplace_back(0.1 * (2 * i + 1), 0.3);
      comb.emplace_back(0.1 * (2 * i), 0.3);
      if (i > 0) {
        comb.emplace_back(0.1 * (2 * i), 0.1);
        comb.emplace_back(0.1 * (2 * i - 1), 0.1);
      }
    }
    std::mt19937_64 random(static_cast<std::uint64_t>(teeth));
    expect_decomposes(comb, random);
  }
}

TEST(PolygonTest, SameInputSameParts) {
  std::mt19937_64 random(9);
  const Points polygon = star(random, 40);
  EXPECT_EQ(*decompose_polygon(polygon), *decompose_polygon(polygon));
}

TEST(PolygonTest, WrongValuesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error_of({{0, 0}, {1, 0}}).code, ErrorCode::kInvalidValue);
  EXPECT_EQ(error_of({{0, 0}, {1, 0}}).field, "vertices");
  EXPECT_EQ(error_of(Points(65, Vec2(0, 0))).code, ErrorCode::kInvalidValue);
  for (const double bad : {nan, infinity, -infinity, 1.01 * kSizeMax}) {
    const Error error = error_of({{0, 0}, {1, 0}, {1, bad}});
    EXPECT_EQ(error.code, ErrorCode::kInvalidValue);
    EXPECT_EQ(error.field, "vertices[2]");
  }
}

TEST(PolygonTest, DegenerateShapesAreRefused) {
  const Points bow_tie{{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  const Points spike{{0, 0}, {1, 0}, {2, 0}, {1, 0}, {0, 1}};
  const Points touching{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}};  // a vertex on another edge
  const Points line{{0, 0}, {1, 0}, {2, 0}};
  const Points doubled{{0, 0}, {1, 0}, {1, 0}, {0, 1}};
  const Points thin{{0, 0}, {1, 0}, {1, 0.5 * kSizeMin}, {0, 0.5 * kSizeMin}};
  for (const Points& shape : {bow_tie, spike, touching, line, doubled, thin}) {
    EXPECT_EQ(error_of(shape).code, ErrorCode::kDegenerateShape);
  }
  EXPECT_EQ(error_of(doubled).field, "vertices[2]");
  EXPECT_FALSE(error_of(bow_tie).message.empty());
}

TEST(PolygonTest, ThinnestAllowedBoxPassesAtAnyAngle) {
  for (int k = 0; k < 100; ++k) {
    const Vec2 u(std::cos(0.1 * k), std::sin(0.1 * k)), v(-u.y(), u.x());
    const auto parts = decompose_polygon({Vec2(0, 0), Vec2(u), Vec2(u + kSizeMin * v), Vec2(kSizeMin * v)});
    ASSERT_TRUE(parts) << parts.error().message;
    EXPECT_EQ(parts->front().size(), 4u);
  }
}

// A capsule: rectangle and two half discs, I = 2rL (L² + 4r²)/12 + πr²·r²/2 + πr²·L²/4 + 2·πr²·(L/2)·(4r/3π)
// (a half disc about its own centre: its distance squared averages (L/2 + s)², s the distance along the axis).
TEST(RoundedAreaTest, ACapsuleHasItsClosedForm) {
  const double pi = 3.14159265358979323846, r = 0.3, l = 1.7;
  const AreaProperties p = rounded_area_properties({{2, 1}, {2 + l, 1}}, r);
  EXPECT_NEAR(p.area, 2 * r * l + pi * r * r, 1e-12);
  EXPECT_NEAR(p.centroid.x(), 2 + l / 2, 1e-12);
  EXPECT_NEAR(p.centroid.y(), 1, 1e-12);
  const double strip = 2 * r * l * (l * l + 4 * r * r) / 12;
  const double ends = pi * r * r * (0.5 * r * r + 0.25 * l * l) + 2 * pi * r * r * (l / 2) * (4 * r / (3 * pi));
  EXPECT_NEAR(p.second_moment, strip + ends, 1e-12);
}

// Against a sum over a fine grid of the points within the radius of the polygon.
TEST(RoundedAreaTest, ARoundedPolygonHasTheMomentsOfItsPoints) {
  const std::vector<Vec2> v = {{0, 0}, {2, 0.3}, {1.5, 1.4}, {0.2, 0.9}};
  const double r = 0.25, step = 0.004;
  const auto inside = [&](const Vec2& p) {
    bool core = true;
    double nearest = 1e9;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vec2 a = v[i], e = v[(i + 1) % v.size()] - a;
      const Vec2 d = p - a;
      core = core && e.x() * d.y() - e.y() * d.x() >= 0;
      const double t = std::clamp(e.dot(d) / e.dot(e), 0.0, 1.0);
      nearest = std::min(nearest, (d - t * e).norm());
    }
    return core || nearest <= r;
  };
  double area = 0, moment = 0;
  Vec2 first(0, 0);
  const AreaProperties p = rounded_area_properties(v, r);
  for (double x = -0.3; x < 2.3; x += step) {
    for (double y = -0.3; y < 1.8; y += step) {
      const Vec2 at(x + step / 2, y + step / 2);
      if (!inside(at)) continue;
      area += step * step;
      first += step * step * at;
      moment += step * step * (at - p.centroid).squaredNorm();
    }
  }
  // Cells on the outline, about 6.3 m long, err by half a cell each at random: far below 1e-3.
  EXPECT_NEAR(p.area, area, 1e-3);
  EXPECT_NEAR((p.centroid - first / area).norm(), 0, 1e-3);
  EXPECT_NEAR(p.second_moment, moment, 1e-3);
}

TEST(ChainTest, RefusesWhatIsNoChain) {
  EXPECT_TRUE(check_chain({{0, 0}, {1, 0}}, false));
  EXPECT_TRUE(check_chain({{0, 0}, {1, 0}, {0, 1}}, true));
  EXPECT_TRUE(check_chain({{0, 0}, {2, 0}, {2, 1}, {1, -1}}, false));  // it may cross itself
  EXPECT_EQ(check_chain({{0, 0}}, false).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(check_chain({{0, 0}, {1, 0}}, true).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(check_chain({{0, 0}, {1, 0}, {1, 0}}, false).error().field, "vertices[2]");
  EXPECT_EQ(check_chain({{0, 0}, {1, 0}, {0.5, 0}}, false).error().code, ErrorCode::kDegenerateShape);
  EXPECT_EQ(check_chain({{0, 0}, {1, 0}, {0, 0}}, true).error().code, ErrorCode::kDegenerateShape);
  EXPECT_EQ(check_chain({{0, 0}, {std::nan(""), 0}}, false).error().field, "vertices[1]");
  EXPECT_EQ(check_chain(std::vector<Vec2>(kChainVerticesMax + 1), false).error().code, ErrorCode::kInvalidValue);
}

}  // namespace
}  // namespace urto

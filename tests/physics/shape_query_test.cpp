#include "physics/shape_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "physics/brute_force.h"
#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

QueryShape point_at(double x, double y) { return {PointGeometry{}, {x, y}, 0}; }
QueryShape disc_at(double x, double y, double radius) { return {Circle{radius, {0, 0}}, {x, y}, 0}; }
QueryShape box_at(double x, double y, double width, double height, double angle = 0) {
  return {Box{width, height, {0, 0}, 0}, {x, y}, angle};
}

std::vector<BodyId> bodies_of(const auto& hits) {
  std::vector<BodyId> ids;
  for (const auto& hit : hits) ids.push_back(hit.body);
  return ids;
}

// A box of 2 m at the origin, a ball of 1 m at (5, 0), a chain as a wall at x = −4, and a sensor over all.
class ShapeQueryTest : public ::testing::TestWithParam<Precision> {
 protected:
  ShapeQueryTest() {
    world_ = make_world(settings_for(GetParam()));
    box_ = add(*world_, box_body(0, 0, 2, 2));
    BodyDef ball = ball_body(5, 0, 1);
    ball.shapes[0].filter = {2, 6};
    ball_ = add(*world_, ball);
    wall_ = add(*world_, body_with({Chain{{{0, 3}, {0, -3}}, false}, {}, {}, false}, {-4, 0}, BodyType::kStatic));
    BodyDef sensor = box_body(0, 0, 20, 20, BodyType::kStatic);
    sensor.shapes[0].sensor = true;
    add(*world_, sensor);
  }
  std::unique_ptr<World> world_;
  BodyId box_ = 0, ball_ = 0, wall_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Precisions, ShapeQueryTest, ::testing::Values(Precision::kFloat, Precision::kDouble));

TEST_P(ShapeQueryTest, ACastMeetsEachBodyAtItsFirstTouchInOrder) {
  const auto found = *world_->query_cast(disc_at(10, 0, 0.5), {-20, 0}, {});
  EXPECT_FALSE(found.truncated);
  ASSERT_EQ(bodies_of(found.hits), (std::vector<BodyId>{ball_, box_, wall_}));
  const double expected[] = {3.5 / 20, 8.5 / 20, 13.5 / 20}, surface[] = {6, 1, -4};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.hits[i].fraction, expected[i], 1e-14);
    EXPECT_NEAR((found.hits[i].point - Vec2(surface[i], 0)).norm(), 0, 1e-12);
    EXPECT_NEAR((found.hits[i].normal - Vec2(1, 0)).norm(), 0, 1e-12);
  }
}

TEST_P(ShapeQueryTest, ACastSeesAChainFromBothSides) {
  for (const double side : {-1.0, 1.0}) {
    const auto found = *world_->query_cast(box_at(-4 + 2 * side, 0, 1, 1), {-2 * side, 0}, {});
    ASSERT_EQ(bodies_of(found.hits), (std::vector<BodyId>{wall_}));
    EXPECT_NEAR(found.hits[0].fraction, 0.75, 1e-14);
    EXPECT_NEAR(found.hits[0].normal.x(), side, 1e-14);
  }
}

TEST_P(ShapeQueryTest, ACastThatStartsInABodyMeetsItAtOnceAndWithoutANormal) {
  const auto found = *world_->query_cast(disc_at(0.5, 0, 1), {10, 0}, {});
  ASSERT_EQ(bodies_of(found.hits), (std::vector<BodyId>{box_, ball_}));
  EXPECT_EQ(found.hits[0].fraction, 0);
  EXPECT_EQ(found.hits[0].normal, Vec2(0, 0));
  EXPECT_NEAR(found.hits[1].fraction, 0.25, 1e-14);
}

TEST_P(ShapeQueryTest, ACornerMeetsABoxThatIsTurned) {
  // A square of side 1 on its corner comes down onto the box: its lowest corner is √½ below its middle.
  const auto found = *world_->query_cast(box_at(0, 5, 1, 1, 0.7853981633974483), {0, -5}, {});
  ASSERT_EQ(bodies_of(found.hits), (std::vector<BodyId>{box_}));
  EXPECT_NEAR(found.hits[0].fraction, (4 - std::sqrt(0.5)) / 5, 1e-14);
  EXPECT_NEAR((found.hits[0].point - Vec2(0, 1)).norm(), 0, 1e-12);
}

TEST_P(ShapeQueryTest, AnOverlapIsThatOfTheShapesNotOfTheirBounds) {
  const auto ids = [&](const QueryShape& shape) { return world_->query_overlap(shape, {})->hits; };
  EXPECT_EQ(ids(point_at(0.5, 0.5)), std::vector<BodyId>{box_});
  EXPECT_EQ(ids(disc_at(1.5, 1.5, 0.7)), std::vector<BodyId>{});  // √½ from the corner
  EXPECT_EQ(ids(disc_at(1.5, 1.5, 0.71)), std::vector<BodyId>{box_});
  EXPECT_EQ(ids(box_at(2.5, 0, 3, 0.1)), (std::vector<BodyId>{box_, ball_}));  // touches both
  EXPECT_EQ(ids(box_at(0, 0, 50, 50)), (std::vector<BodyId>{box_, ball_, wall_}));
  EXPECT_EQ(ids({Capsule{{-4, 0}, {3, 0}, 0.1}, {0, 2}, 0}), std::vector<BodyId>{wall_});
  EXPECT_EQ(ids({Polygon{{{0, 0}, {4, 0}, {0, 4}}, 0}, {3, -3}, 0}), std::vector<BodyId>{ball_});
}

TEST_P(ShapeQueryTest, TheClosestPointsOfTwoShapes) {
  const auto found = *world_->query_closest(disc_at(2.5, 0, 0.5), 10, {});
  ASSERT_EQ(bodies_of(found.hits), (std::vector<BodyId>{box_, ball_, wall_}));  // 1 m, 1 m, 6 m
  EXPECT_NEAR(found.hits[0].distance, 1, 1e-14);
  EXPECT_NEAR((found.hits[0].point - Vec2(1, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((found.hits[0].query_point - Vec2(2, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((found.hits[0].normal - Vec2(1, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR(found.hits[1].distance, 1, 1e-14);
  EXPECT_NEAR((found.hits[1].normal - Vec2(-1, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR(found.hits[2].distance, 6, 1e-14);
  EXPECT_EQ(bodies_of(world_->query_closest(disc_at(2.5, 0, 0.5), 0.999, {})->hits), std::vector<BodyId>{});
  EXPECT_EQ(bodies_of(world_->query_closest(point_at(-5, 4), 1.5, {})->hits), std::vector<BodyId>{wall_});
}

TEST_P(ShapeQueryTest, WhatOverlapsHasANegativeDistanceByWhichItIsParted) {
  const auto found = *world_->query_closest(box_at(1.25, 0, 1, 1), 0, {});
  ASSERT_EQ(bodies_of(found.hits), (std::vector<BodyId>{box_}));
  EXPECT_NEAR(found.hits[0].distance, -0.25, 1e-14);
  EXPECT_NEAR((found.hits[0].normal - Vec2(1, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR(found.hits[0].point.x(), 1, 1e-14);
  EXPECT_NEAR(found.hits[0].query_point.x(), 0.75, 1e-14);
}

TEST_P(ShapeQueryTest, FiltersAreThoseOfTwoShapesThatTouch) {
  const QueryShape all = box_at(0, 0, 50, 50);
  const auto ids = [&](std::uint32_t category, std::uint32_t mask) {
    QueryOptions options;
    options.filter = Filter{category, mask};
    const auto overlapping = world_->query_overlap(all, options)->hits;
    EXPECT_EQ(bodies_of(world_->query_closest(point_at(100, 0), 1000, options)->hits).size(), overlapping.size());
    EXPECT_EQ(bodies_of(world_->query_cast(disc_at(20, 0, 1), {-40, 0}, options)->hits).size(), overlapping.size());
    return overlapping;
  };
  EXPECT_EQ(ids(~0u, ~0u), (std::vector<BodyId>{box_, ball_, wall_}));
  EXPECT_EQ(ids(~0u, 2), std::vector<BodyId>{ball_});
  EXPECT_EQ(ids(~0u, 1), (std::vector<BodyId>{box_, wall_}));
  EXPECT_EQ(ids(1, ~0u), (std::vector<BodyId>{box_, wall_}));  // the ball's mask is 6
  EXPECT_EQ(ids(4, ~0u), (std::vector<BodyId>{box_, ball_, wall_}));
  EXPECT_EQ(ids(~0u, 0), std::vector<BodyId>{});
}

TEST_P(ShapeQueryTest, WhatComesFirstIsKeptWhenThereIsTooMuch) {
  QueryOptions two;
  two.count_max = 2;
  const auto cast = *world_->query_cast(disc_at(10, 0, 0.5), {-20, 0}, two);
  EXPECT_TRUE(cast.truncated);
  EXPECT_EQ(bodies_of(cast.hits), (std::vector<BodyId>{ball_, box_}));
  const auto overlap = *world_->query_overlap(box_at(0, 0, 50, 50), two);
  EXPECT_TRUE(overlap.truncated);
  EXPECT_EQ(overlap.hits, (std::vector<BodyId>{box_, ball_}));
  const auto closest = *world_->query_closest(point_at(-3, 0), 100, two);
  EXPECT_TRUE(closest.truncated);
  EXPECT_EQ(bodies_of(closest.hits), (std::vector<BodyId>{wall_, box_}));
  two.count_max = 3;
  EXPECT_FALSE(world_->query_overlap(box_at(0, 0, 50, 50), two)->truncated);
}

TEST_P(ShapeQueryTest, BadArgumentsAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto field = [](const auto& answer) { return answer ? std::string() : answer.error().field; };
  EXPECT_EQ(field(world_->query_cast(disc_at(0, 0, 0), {1, 0}, {})), "shape.circle.radius");
  EXPECT_EQ(field(world_->query_cast(disc_at(0, nan, 1), {1, 0}, {})), "shape.position.y");
  EXPECT_EQ(field(world_->query_cast(box_at(0, 0, 1, 1, nan), {1, 0}, {})), "shape.angle");
  EXPECT_EQ(field(world_->query_cast(point_at(0, 0), {1, 2e7}, {})), "translation.y");
  EXPECT_EQ(field(world_->query_overlap(box_at(0, 0, -1, 1), {})), "shape.box.width");
  EXPECT_EQ(field(world_->query_overlap(point_at(0, 0), {std::nullopt, 0})), "count_max");
  EXPECT_EQ(field(world_->query_overlap(point_at(0, 0), {std::nullopt, kQueryHitsMax + 1})), "count_max");
  EXPECT_EQ(field(world_->query_closest(point_at(0, 0), -1, {})), "distance_max");
  EXPECT_EQ(field(world_->query_closest(point_at(0, 0), nan, {})), "distance_max");
  EXPECT_EQ(field(world_->query_overlap({Capsule{{1, 1}, {1, 1}, 1}, {0, 0}, 0}, {})), "shape.capsule.b");
  const auto polygon = world_->query_overlap({Polygon{{{0, 0}, {1, 0}, {2, 0}}, 0}, {0, 0}, 0}, {});
  EXPECT_EQ(polygon.error().code, ErrorCode::kDegenerateShape);
  const auto concave = world_->query_overlap({Polygon{{{0, 0}, {2, 0}, {2, 2}, {1, 0.5}}, 0}, {0, 0}, 0}, {});
  EXPECT_EQ(field(concave), "shape.polygon.vertices");
  EXPECT_EQ(concave.error().code, ErrorCode::kInvalidValue);
}

TEST(ShapeQuery, AnEmptyWorldHasNothingToFind) {
  const auto world = make_world();
  EXPECT_TRUE(world->query_cast(disc_at(0, 0, 1), {1, 0}, {})->hits.empty());
  EXPECT_TRUE(world->query_overlap(disc_at(0, 0, 1), {})->hits.empty());
  EXPECT_TRUE(world->query_closest(disc_at(0, 0, 1), 1e7, {})->hits.empty());
}

// A crowd in motion, and every body's outline as a test can know it.
class Crowd {
 public:
  Crowd(std::uint64_t seed, Precision precision, BroadPhaseKind kind) : random_(seed) {
    WorldSettings settings = settings_for(precision);
    settings.broad_phase = kind;
    settings.gravity = {0, 0};
    world = make_world(settings);
    for (int i = 0; i < 120; ++i) {
      BodyDef def = body_with({Box{size(), size(), {0, 0}, 0}, {}, {}, false}, place(), type());
      if (i % 3 == 1) def.shapes[0].geometry = Circle{size(), {0, 0}};
      if (i % 3 == 2) def.shapes[0].geometry = Capsule{{-size(), 0}, {size(), 0.3}, 0.5 * size()};
      def.angle = 3 * unit();
      if (def.type != BodyType::kStatic) def.velocity = {20 * unit(), 20 * unit()};
      if (def.type != BodyType::kStatic) def.angular_velocity = 10 * unit();
      defs.push_back(def);
      ids.push_back(add(*world, def));
    }
    step_for(*world, 0.5);
  }

  double unit() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  double size() { return 0.65 + 0.55 * unit(); }
  Vec2 place() { return {15 * unit(), 15 * unit()}; }
  BodyType type() { return unit() < -0.5 ? BodyType::kStatic : BodyType::kDynamic; }

  static Convex<double> outline(const Geometry& geometry) {
    Convex<double> out;
    if (const auto* circle = std::get_if<Circle>(&geometry)) {
      out.count = 1;
      out.radius = circle->radius;
    } else if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
      out.count = 2;
      out.vertices[0] = capsule->a;
      out.vertices[1] = capsule->b;
      out.radius = capsule->radius;
    } else {
      const auto& box = std::get<Box>(geometry);
      const double x = 0.5 * box.width, y = 0.5 * box.height;
      const Vec2 corners[] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
      out.count = 4;
      std::copy(corners, corners + 4, out.vertices);
    }
    return out;
  }

  double separation(std::size_t i, const Convex<double>& probe, const Vec2& at, double angle) const {
    const BodyState state = *world->body(ids[i]);
    const auto frame = [](const Vec2& p, double a) { return Transform<double>{p, {std::cos(a), std::sin(a)}}; };
    return testing_shapes::brute_force(outline(defs[i].shapes[0].geometry), probe,
                                       frame(state.position, state.angle).inverse_times(frame(at, angle)));
  }

  std::unique_ptr<World> world;
  std::vector<BodyDef> defs;
  std::vector<BodyId> ids;

 private:
  std::mt19937_64 random_;
};

TEST_P(ShapeQueryTest, AgreeWithABruteForceOverAllBodiesOfACrowd) {
  // What the test reads of a float world was rounded to float once more: 20 m and 3 rad, a few roundings each.
  const double rounding = GetParam() == Precision::kFloat ? 2e-5 : 1e-12;
  int overlaps = 0, hits = 0, near = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Crowd crowd(seed, GetParam(), BroadPhaseKind::kBvh);
    for (int query = 0; query < 40; ++query) {
      const Geometry geometry =
          query % 2 ? Geometry(Circle{crowd.size(), {0, 0}}) : Geometry(Box{crowd.size(), 3 * crowd.size(), {0, 0}, 0});
      const Convex<double> probe = Crowd::outline(geometry);
      const Vec2 at = crowd.place(), way = {8 * crowd.unit(), 8 * crowd.unit()};
      const double angle = crowd.unit(), distance_max = 3;
      QueryShape shape{Box{}, at, angle};
      if (query % 2)
        shape.geometry = std::get<Circle>(geometry);
      else
        shape.geometry = std::get<Box>(geometry);
      const auto overlapping = crowd.world->query_overlap(shape, {})->hits;
      const auto cast = crowd.world->query_cast(shape, way, {})->hits;
      const auto closest = crowd.world->query_closest(shape, distance_max, {})->hits;
      EXPECT_TRUE(std::is_sorted(overlapping.begin(), overlapping.end()));
      for (std::size_t i = 0; i + 1 < cast.size(); ++i) EXPECT_LE(cast[i].fraction, cast[i + 1].fraction);
      for (std::size_t i = 0; i + 1 < closest.size(); ++i) EXPECT_LE(closest[i].distance, closest[i + 1].distance);
      for (std::size_t i = 0; i < crowd.ids.size(); ++i) {
        const auto is_it = [&](const auto& hit) { return hit.body == crowd.ids[i]; };
        const double separation = crowd.separation(i, probe, at, angle);
        const bool overlaps_it = std::count(overlapping.begin(), overlapping.end(), crowd.ids[i]) > 0;
        if (std::abs(separation) > rounding) {
          EXPECT_EQ(overlaps_it, separation < 0);
        }
        overlaps += overlaps_it;
        const auto nearest = std::find_if(closest.begin(), closest.end(), is_it);
        if (std::abs(separation - distance_max) > rounding) {
          ASSERT_EQ(nearest != closest.end(), separation < distance_max);
        }
        if (nearest != closest.end()) {
          ++near;
          EXPECT_NEAR(nearest->distance, separation, rounding);
          const Vec2 across = nearest->query_point - nearest->point;
          EXPECT_NEAR((across - nearest->distance * nearest->normal).norm(), 0, 1e-12);
        }
        const auto met = std::find_if(cast.begin(), cast.end(), is_it);
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k <= 100; ++k)
          least = std::min(least, crowd.separation(i, probe, at + (k / 100.0) * way, angle));
        if (least < -rounding) {
          ASSERT_TRUE(met != cast.end());
        }
        if (met == cast.end()) continue;
        ++hits;
        EXPECT_LT(least, 0.2);  // the samples are up to 0.11 m apart
        const double touching = crowd.separation(i, probe, at + met->fraction * way, angle);
        EXPECT_NEAR(met->fraction > 0 ? touching : std::max(touching, 0.0), 0, rounding);
        for (int k = 0; k < 100 && k / 100.0 < met->fraction; ++k)
          EXPECT_GT(crowd.separation(i, probe, at + (k / 100.0) * way, angle), -rounding);
      }
    }
  }
  EXPECT_GT(overlaps, 100);
  EXPECT_GT(hits, 400);
  EXPECT_GT(near, 500);
}

TEST_P(ShapeQueryTest, DoNotDependOnTheBroadPhase) {
  const std::uint64_t seed = 77;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Crowd tree(seed, GetParam(), BroadPhaseKind::kBvh), all(seed, GetParam(), BroadPhaseKind::kBruteForce),
      quad(seed, GetParam(), BroadPhaseKind::kQuadtree);
  ASSERT_EQ(tree.world->body(tree.ids[7])->position, all.world->body(all.ids[7])->position);
  for (int query = 0; query < 50; ++query) {
    const Vec2 at = tree.place(), way = tree.place();
    const QueryShape shape = box_at(at.x(), at.y(), tree.size(), tree.size(), tree.unit());
    const auto expected = tree.world->query_cast(shape, way, {})->hits;
    const auto closest = tree.world->query_closest(shape, 4, {})->hits;
    for (const World* world : {all.world.get(), quad.world.get()}) {
      const auto other = world->query_cast(shape, way, {})->hits;
      ASSERT_EQ(bodies_of(other), bodies_of(expected));
      for (std::size_t i = 0; i < other.size(); ++i) EXPECT_EQ(other[i].fraction, expected[i].fraction);
      EXPECT_EQ(bodies_of(world->query_closest(shape, 4, {})->hits), bodies_of(closest));
      EXPECT_EQ(world->query_overlap(shape, {})->hits, tree.world->query_overlap(shape, {})->hits);
    }
  }
}

}  // namespace
}  // namespace urto

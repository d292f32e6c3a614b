#include "physics/motion_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "physics/body_factory.h"
#include "physics/bounds.h"
#include "physics/constants.h"
#include "physics/motion.h"
#include "physics/simd/lanes.h"
#include "physics/solver/contact_kernels.h"

namespace urto {
namespace {

constexpr std::size_t kCount = 37;  // no whole number of blocks at any width

// Bodies with a disc, a box, a rounded triangle, or two shapes, centred or not, awake and on their way.
template <class S>
struct Crowd {
  std::vector<Body<S>> bodies{kCount};
  std::vector<Motion<S>> motions{kCount};
  std::vector<Shape<S>> shapes{kCount};
  std::vector<Place<S>> places{kCount};
  std::vector<Convex<S>> convexes{kCount};
  std::vector<OutlineRows<S>> outlines{kCount};
  std::vector<std::uint32_t> slots;

  explicit Crowd(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<S> any(S(-1), S(1));
    slots.resize(kCount);
    std::iota(slots.begin(), slots.end(), 0u);
    std::shuffle(slots.begin(), slots.end(), random);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      Body<S>& body = bodies[i];
      body.x = 100 * any(random);
      body.y = 100 * any(random);
      body.angle = S(3.1415) * any(random);
      sin_cos(body.angle, body.s, body.c);
      body.type = static_cast<std::uint32_t>(random() % 5 != 0 ? BodyType::kDynamic : BodyType::kKinematic);
      if (body.dynamic()) body.mass = body.inv_mass = body.inertia = body.inv_inertia = S(1);
      body.extent_min = S(0.25);
      body.extent_max = S(0.5);
      body.sleep_time = S(0.49);
      body.first_shape = i;
      body.shape_count = random() % 4 == 0 ? 2 : 1;
      set_motion(motions[i], random, any);
      const ShapeKind kinds[] = {ShapeKind::kCircle, ShapeKind::kBox, ShapeKind::kPolygon};
      set_shape(i, kinds[random() % 3], random() % 3 == 0, random() % 2 == 0);
    }
  }

  StepEnd<S> ends(S time_step) {
    return {bodies.data(), motions.data(), places.data(), shapes.data(), convexes.data(), outlines.data(), time_step};
  }

 private:
  static void set_motion(Motion<S>& m, std::mt19937& random, std::uniform_real_distribution<S>& any) {
    const S size = random() % 3 == 0 ? S(0.01) : S(30);
    m.vx = size * any(random);
    m.vy = size * any(random);
    m.w = size * any(random);
    m.dx = m.vx / 60;
    m.dy = m.vy / 60;
    if (random() % 4 != 0) m.da = (random() % 8 == 0 ? 40 : 1) * m.w / 60;
    rotation_by(m.da, m.c, m.s);
  }

  void set_shape(std::uint32_t i, ShapeKind kind, bool off_centre, bool wide) {
    const bool box = kind == ShapeKind::kBox, polygon = kind == ShapeKind::kPolygon;
    Shape<S>& shape = shapes[i];
    shape.body = i;
    shape.kind = static_cast<std::uint32_t>(kind);
    shape.flags = kShapeAlive | kShapeUpright | (off_centre ? 0u : kShapeCentred);
    shape.reach = S(0.02);
    shape.margin = S(0.1);
    const Vec<S> at(bodies[i].x, bodies[i].y);
    shape.fat = Aabb<S>{at, at}.expanded(wide ? S(2) : S(0.7));
    Convex<S>& convex = convexes[i];
    convex.count = polygon ? 3 : 1;
    if (polygon) {
      convex.vertices[0] = Vec<S>(S(-0.4), S(-0.2));
      convex.vertices[1] = Vec<S>(S(0.4), S(-0.2));
      convex.vertices[2] = Vec<S>(S(0), S(0.4));
      convex.radius = S(0.05);
    }
    if (off_centre) convex.centroid = Vec<S>(S(0.125), S(0.25));
    outlines[i] = outline_of(convex);
    places[i].half_width = box ? S(0.4) : polygon ? convex.radius : S(0.5);
    places[i].half_height = box ? S(0.3) : S(0);
    places[i].reach = shape.reach;
    places[i].bound = S(0.125);
    places[i].vertices = box ? S(4) : polygon ? S(-3) : S(0);
    places[i].fast = S(1);
  }
};

// A step's end, one body after the other.
template <class S>
void end_one(Body<S>& body, Motion<S>& m, S time_step) {
  saturate(m);
  body.x += m.dx;
  body.y += m.dy;
  if (m.da != S(0)) {
    body.angle = wrap_angle(body.angle + m.da);
    sin_cos(body.angle, body.s, body.c);
  }
  const S turn = absolute(m.da) * body.extent_max, turning = absolute(m.w) * body.extent_max;
  const S way2 = (m.dx * m.dx + m.dy * m.dy + turn * turn) / (time_step * time_step);
  const S speed2 = max_of(way2, m.vx * m.vx + m.vy * m.vy + turning * turning);
  body.sleep_time = speed2 > S(kSleepSpeed * kSleepSpeed) ? S(0) : body.sleep_time + time_step;
  m.dx = m.dy = m.da = m.s = S(0);
  m.c = S(1);
}

template <class S>
void expect_same(const Motion<S>& m, const Motion<S>& n) {
  for (const auto field : {&Motion<S>::vx, &Motion<S>::vy, &Motion<S>::w, &Motion<S>::dx, &Motion<S>::dy,
                           &Motion<S>::da, &Motion<S>::c, &Motion<S>::s})
    EXPECT_EQ(m.*field, n.*field);
}

template <class S>
void compare_positions(std::uint32_t seed) {
  Crowd<S> crowd(seed);
  std::vector<Motion<S>> expected = crowd.motions;
  const S h = S(1.0 / 240);
  for (Motion<S>& m : expected) {
    m.dx += h * m.vx;
    m.dy += h * m.vy;
    m.da += h * m.w;
    rotation_by(m.da, m.c, m.s);
  }
  motion_kernels<S>().integrate_positions(crowd.motions.data(), crowd.slots.data(), kCount, h);
  for (std::size_t i = 0; i < kCount; ++i) expect_same(crowd.motions[i], expected[i]);
}

// Of a shape at its place, its body's way to come and its reach included.
template <class S>
Aabb<S> swept(const Crowd<S>& crowd, std::uint32_t slot, S time_step) {
  const Body<S>& body = crowd.bodies[slot];
  const Motion<S>& m = crowd.motions[slot];
  const Place<S>& place = crowd.places[slot];
  const S c = absolute(body.c), s = absolute(body.s);
  const bool box = place.half_height > S(0);
  Vec<S> high(box ? c * place.half_width + s * place.half_height : body.extent_max,
              box ? c * place.half_height + s * place.half_width : body.extent_max);
  Vec<S> low = -high;
  if (place.vertices < S(0)) {
    low = high = body.rotation().apply(crowd.convexes[slot].vertices[0] - crowd.convexes[slot].centroid);
    for (int k = 1; k < 3; ++k) {
      const Vec<S> v = body.rotation().apply(crowd.convexes[slot].vertices[k] - crowd.convexes[slot].centroid);
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    low -= Vec<S>::Constant(place.half_width);
    high += Vec<S>::Constant(place.half_width);
  }
  const Vec<S> center(place.x, place.y);
  Aabb<S> bounds{center + low, center + high};
  (m.vx < S(0) ? bounds.lower : bounds.upper).x() += m.vx * time_step;
  (m.vy < S(0) ? bounds.lower : bounds.upper).y() += m.vy * time_step;
  return bounds.expanded(place.reach);
}

// A shape's bounds are as they were if they hold it, else they are new ones.
template <class S>
void expect_followed(const Crowd<S>& crowd, const Crowd<S>& before, std::uint32_t slot, bool left, S time_step) {
  const Aabb<S> bounds = swept(crowd, slot, time_step), &fat = crowd.shapes[slot].fat, &old = before.shapes[slot].fat;
  EXPECT_EQ(left, !old.contains(bounds)) << "slot " << slot;
  const Aabb<S> wanted = left ? bounds.expanded(crowd.shapes[slot].margin) : old;
  EXPECT_EQ(fat.lower, wanted.lower) << "slot " << slot;
  EXPECT_EQ(fat.upper, wanted.upper) << "slot " << slot;
}

template <class S>
bool simple(const Crowd<S>& crowd, std::uint32_t slot) {
  const Body<S>& body = crowd.bodies[slot];
  return body.dynamic() && body.shape_count == 1 && (crowd.shapes[slot].flags & kShapeCentred) != 0;
}

template <class S>
void compare_end(std::uint32_t seed) {
  constexpr std::size_t kBlock = static_cast<std::size_t>(kLanes<S>);
  const S time_step = S(1.0 / 60);
  Crowd<S> crowd(seed), expected(seed);
  for (std::size_t i = 0; i < kCount; ++i) end_one(expected.bodies[i], expected.motions[i], time_step);
  const StepEnd<S> ends = crowd.ends(time_step);
  for (std::size_t first = 0; first < kCount; first += kBlock) {
    const std::size_t count = std::min(kBlock, kCount - first);
    const BlockEnd end = motion_kernels<S>().end_step(ends, &crowd.slots[first], count);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::uint32_t slot = crowd.slots[first + lane];
      const Body<S>&body = crowd.bodies[slot], &wanted = expected.bodies[slot];
      expect_same(crowd.motions[slot], expected.motions[slot]);
      for (const auto field : {&Body<S>::x, &Body<S>::y, &Body<S>::angle, &Body<S>::c, &Body<S>::s,
                               &Body<S>::sleep_time, &Body<S>::extent_max, &Body<S>::local_x})
        EXPECT_EQ(body.*field, wanted.*field) << "slot " << slot;
      EXPECT_EQ((end.restful >> lane & 1u) != 0, wanted.sleep_time >= S(kSleepTime));
      EXPECT_EQ((end.followed >> lane & 1u) != 0, simple(crowd, slot)) << "slot " << slot;
      if (!simple(crowd, slot)) continue;
      expect_followed(crowd, expected, slot, (end.left >> lane & 1u) != 0, time_step);
      const Place<S>& place = crowd.places[slot];
      EXPECT_EQ(place.x, body.x);
      EXPECT_EQ(place.s, body.s);
      EXPECT_EQ(place.way_y, expected.motions[slot].vy * time_step);
      EXPECT_EQ(place.turn, absolute(expected.motions[slot].w) * body.extent_max * time_step);
      EXPECT_EQ(place.fast, S(0));
      EXPECT_EQ(place.bound, S(0.125));
    }
  }
}

// Shapes of which a body may have several, or one beside its middle.
template <class S>
void compare_follow(std::uint32_t seed) {
  constexpr std::size_t kBlock = static_cast<std::size_t>(kLanes<S>);
  const S time_step = S(1.0 / 60);
  Crowd<S> crowd(seed);
  const Crowd<S> before(seed);
  const StepEnd<S> ends = crowd.ends(time_step);
  std::vector<std::uint32_t> proxies;
  for (const std::uint32_t slot : crowd.slots)
    if (crowd.bodies[slot].dynamic() && crowd.places[slot].vertices != S(0)) proxies.push_back(slot);
  for (std::size_t first = 0; first < proxies.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, proxies.size() - first);
    const std::uint32_t left = motion_kernels<S>().follow(ends, &proxies[first], count);
    EXPECT_EQ(left >> count, 0u);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::uint32_t slot = proxies[first + lane];
      const Body<S>& body = crowd.bodies[slot];
      const Place<S>& place = crowd.places[slot];
      const Vec<S> offset = body.rotation().apply(crowd.convexes[slot].centroid - body.local_center());
      EXPECT_EQ(place.offset_x, offset.x());
      EXPECT_EQ(place.offset_y, offset.y());
      EXPECT_EQ(place.x, body.x + offset.x());
      EXPECT_EQ(place.y, body.y + offset.y());
      EXPECT_EQ(place.turn, absolute(crowd.motions[slot].w) * body.extent_max * time_step);
      EXPECT_EQ(place.half_height, before.places[slot].half_height);
      EXPECT_EQ(place.fast, S(0));
      expect_followed(crowd, before, slot, (left >> lane & 1u) != 0, time_step);
    }
  }
}

template <class S>
void compare_fast(std::uint32_t seed) {
  constexpr std::size_t kBlock = static_cast<std::size_t>(kLanes<S>);
  const Crowd<S> crowd(seed);
  for (std::size_t first = 0; first < kCount; first += kBlock) {
    const std::size_t count = std::min(kBlock, kCount - first);
    std::uint32_t expected = 0;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Body<S>& body = crowd.bodies[crowd.slots[first + lane]];
      const Motion<S>& m = crowd.motions[crowd.slots[first + lane]];
      const S way = std::sqrt(m.dx * m.dx + m.dy * m.dy) + absolute(m.da) * body.extent_max;
      const S most = body.dynamic() ? S(kFastFraction) * body.extent_min : S(0);
      expected |= static_cast<std::uint32_t>(way > most) << lane;
    }
    EXPECT_EQ(motion_kernels<S>().fast(crowd.bodies.data(), crowd.motions.data(), &crowd.slots[first], count),
              expected);
  }
}

TEST(MotionKernelsTest, MoveAsOneBodyAfterTheOtherAtEveryWidth) {
  for (const SimdTarget& target : simd_targets()) {
    use_simd_target(target.id);
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
      SCOPED_TRACE(target.name + ", seed " + std::to_string(seed));
      compare_positions<float>(seed);
      compare_positions<double>(seed);
      compare_end<float>(seed);
      compare_end<double>(seed);
      compare_follow<float>(seed);
      compare_follow<double>(seed);
      compare_fast<float>(seed);
      compare_fast<double>(seed);
    }
  }
  use_simd_target(0);
}

// A body of a box, a polygon, a disc, a capsule and a box across, in turns alone and together.
BodyDef body_of_shapes(std::mt19937& random, std::uint32_t which) {
  std::uniform_real_distribution<double> any(-1, 1);
  const Geometry shapes[] = {Box{0.8, 0.3}, Polygon{{{0.4, 0.1}, {1.2, 0.1}, {0.7, 0.8}}, 0.02}, Circle{0.3},
                             Capsule{{-0.4, 0.2}, {0.3, 0.2}, 0.1}, Box{0.4, 0.2, {0.5, 0}, 0.7}};
  BodyDef def;
  def.position = Vec2(10 * any(random), 10 * any(random));
  def.angle = 3 * any(random);
  def.velocity = Vec2(any(random), any(random));
  def.angular_velocity = any(random);
  for (std::uint32_t i = 0; i < 5; ++i)
    if ((which >> i & 1u) != 0) def.shapes.push_back({shapes[i], {}, {}, false});
  return def;
}

struct Leavers {
  int left = 0, stayed = 0, asked_in_vain = 0;
};

// Every shape whose way leads out of its bounds is named, and few others.
template <class S>
void count_leavers(std::uint32_t seed, Leavers& leavers) {
  constexpr std::size_t kBlock = static_cast<std::size_t>(kLanes<S>);
  std::mt19937 random(seed);
  std::uniform_real_distribution<S> off(S(-0.15), S(0.15));
  WorldData<S> world;
  for (std::uint32_t which = 1; which < 32; ++which) {
    Motion<S>& m = world.motions[create_body(world, body_of_shapes(random, which))];
    m.dx = m.vx / 60 + off(random);
    m.dy = m.vy / 60 + off(random);
    m.da = (which % 8 == 0 ? 10 : 2) * off(random);
    rotation_by(m.da, m.c, m.s);
  }
  std::vector<Proxy> proxies(world.shapes.size());
  std::iota(proxies.begin(), proxies.end(), 0u);
  for (std::size_t first = 0; first < proxies.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, proxies.size() - first);
    const std::uint32_t named = motion_kernels<S>().leaving(step_end(world), &proxies[first], count);
    EXPECT_EQ(named >> count, 0u);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Proxy p = proxies[first + lane];
      const bool leaves = !world.shapes[p].fat.contains(way_bounds(world, p)), asked = (named >> lane & 1u) != 0;
      EXPECT_LE(leaves, asked) << "proxy " << p << ", seed " << seed;
      leavers.left += leaves;
      leavers.stayed += !leaves;
      leavers.asked_in_vain += asked && !leaves && world.places[p].vertices != S(0);
    }
  }
}

TEST(MotionKernelsTest, NameWhatLeavesItsBoundsAtEveryWidth) {
  Leavers leavers;
  for (const SimdTarget& target : simd_targets()) {
    use_simd_target(target.id);
    SCOPED_TRACE(target.name);
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
      count_leavers<float>(seed, leavers);
      count_leavers<double>(seed, leavers);
    }
  }
  use_simd_target(0);
  EXPECT_GT(leavers.left, 100);
  EXPECT_GT(leavers.stayed, 100);
  EXPECT_LT(leavers.asked_in_vain, leavers.stayed / 50);
}

}  // namespace
}  // namespace urto

// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/motion_kernels.h"

#include "physics/constants.h"
#include "physics/motion.h"
#include "physics/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/motion_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "physics/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {
namespace {

template <class S>
HWY_INLINE Vector<S> clamped(Vector<S> v, S most) {
  const auto high = set(most), low = set(-most);
  return hn::IfThenElse(hn::Lt(v, low), low, hn::IfThenElse(hn::Gt(v, high), high, v));
}

template <class S>
HWY_INLINE Vector<S> square(Vector<S> v) {
  return hn::Mul(v, v);
}

// Within a sub-step ------------------------------------------------------------------------------------------------

// first + q (second + q (third + …)).
template <class S>
HWY_INLINE Vector<S> polynomial(Vector<S>, S last) {
  return set(last);
}
template <class S, class... Rest>
HWY_INLINE Vector<S> polynomial(Vector<S> q, S first, Rest... rest) {
  return hn::Add(set(first), hn::Mul(q, polynomial<S>(q, rest...)));
}

// Of angles of at most kSmallTurn: as rotation_by (motion.h).
template <class S>
HWY_INLINE void small_rotation(Vector<S> angle, Vector<S>& c, Vector<S>& s) {
  const auto q = hn::Mul(angle, angle);
  if constexpr (sizeof(S) == 4) {
    s = hn::Mul(angle, polynomial<S>(q, S(1), S(-1.0 / 6), S(1.0 / 120), S(-1.0 / 5040)));
    c = polynomial<S>(q, S(1), S(-0.5), S(1.0 / 24), S(-1.0 / 720));
  } else {
    s = hn::Mul(angle, polynomial<S>(q, 1.0, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800,
                                     1.0 / 6227020800.0));
    c = polynomial<S>(q, 1.0, -0.5, 1.0 / 24, -1.0 / 720, 1.0 / 40320, -1.0 / 3628800, 1.0 / 479001600.0);
  }
}

template <class S, class Row>
HWY_INLINE void integrate_vector(const Row& motion, Vector<S> h) {
  const auto m0 = load_rows<S>([&](std::size_t i) { return &motion(i)->vx; });
  const auto m1 = load_rows<S>([&](std::size_t i) { return &motion(i)->dy; });
  const auto dx = hn::Add(m0.c3, hn::Mul(h, m0.c0));
  const auto dy = hn::Add(m1.c0, hn::Mul(h, m0.c1));
  const auto da = hn::Add(m1.c1, hn::Mul(h, m0.c2));
  Vector<S> c, s;
  small_rotation<S>(da, c, s);
  store_rows<S>({m0.c0, m0.c1, m0.c2, dx}, [&](std::size_t i) { return &motion(i)->vx; });
  store_rows<S>({dy, da, c, s}, [&](std::size_t i) { return &motion(i)->dy; });
  std::uint32_t large = bits_of<S>(hn::Gt(hn::Abs(da), set(S(kSmallTurn))));
  for (; large != 0; large &= large - 1) {
    Motion<S>& m = *motion(static_cast<std::size_t>(__builtin_ctz(large)));
    rotation_by(m.da, m.c, m.s);
  }
}

template <class S>
void integrate_positions(Motion<S>* motions, const std::uint32_t* slots, std::size_t count, S h) {
  const std::size_t width = hn::Lanes(Tag<S>());
  const auto step = set(h);
  std::size_t i = 0;
  for (; i + width <= count; i += width) {
    const std::uint32_t* const block = slots + i;
    integrate_vector<S>([&](std::size_t lane) { return &motions[block[lane]]; }, step);
  }
  if (i == count) return;
  Motion<S> nobody;
  integrate_vector<S>([&](std::size_t lane) { return i + lane < count ? &motions[slots[i + lane]] : &nobody; }, step);
}

// At the end of a step ---------------------------------------------------------------------------------------------

// (k[2] z + k[1]) z + k[0].
template <class D>
HWY_INLINE hn::Vec<D> quadratic(D d, hn::Vec<D> z, const double (&k)[3]) {
  return hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Set(d, k[2]), z), hn::Set(d, k[1])), z), hn::Set(d, k[0]));
}

// sin_cos of angles within ±π, its bits: the same operations in the same order (geometry/trigonometry.h).
HWY_INLINE void sin_cos_vectors(const float* angles, float* sines, float* cosines) {
  using namespace trigonometry;
  const hn::CappedTag<double, static_cast<std::size_t>(kLanes<double>)> d;
  const hn::Rebind<float, decltype(d)> f;
  const std::size_t width = hn::Lanes(Tag<float>());
  for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
    const auto angle = hn::PromoteTo(d, hn::Load(f, angles + i));
    const auto quarters = hn::Mul(angle, hn::Set(d, kTwoOverPi));
    const auto half = hn::IfThenElse(hn::Lt(quarters, hn::Zero(d)), hn::Set(d, -0.5), hn::Set(d, 0.5));
    const auto turns = hn::Trunc(hn::Add(quarters, half));  // −2 to 2
    const auto r = hn::Sub(hn::Sub(angle, hn::Mul(turns, hn::Set(d, kHalfPi1))), hn::Mul(turns, hn::Set(d, kHalfPi2)));
    const auto z = hn::Mul(r, r);
    const auto p = quadratic(d, z, kFloatSine);
    const auto q = quadratic(d, z, kFloatCosine);
    const auto s = hn::Add(r, hn::Mul(hn::Mul(r, z), p));
    const auto c = hn::Add(hn::Sub(hn::Set(d, 1.0), hn::Mul(hn::Set(d, 0.5), z)), hn::Mul(hn::Mul(z, z), q));
    const auto size = hn::Abs(turns);
    const auto odd = hn::Eq(size, hn::Set(d, 1.0)), whole = hn::Eq(size, hn::Set(d, 2.0));
    const auto a = hn::IfThenElse(odd, c, s), b = hn::IfThenElse(odd, s, c);
    const auto turn_a = hn::Or(whole, hn::Eq(turns, hn::Set(d, -1.0)));
    const auto turn_b = hn::Or(whole, hn::Eq(turns, hn::Set(d, 1.0)));
    hn::Store(hn::DemoteTo(f, hn::IfThenElse(turn_a, hn::Neg(a), a)), f, sines + i);
    hn::Store(hn::DemoteTo(f, hn::IfThenElse(turn_b, hn::Neg(b), b)), f, cosines + i);
  }
}
HWY_INLINE void sin_cos_vectors(const double* angles, double* sines, double* cosines) {
  for (std::size_t i = 0; i < hn::Lanes(Tag<double>()); ++i) sin_cos(angles[i], sines[i], cosines[i]);
}

// The angles that bodies have come to, and their rotations.
template <class S>
struct Turned {
  Vector<S> angle, c, s;

  HWY_INLINE Turned(Vector<S> before, Vector<S> by) {
    HWY_ALIGN S angles[kLanes<S>], sines[kLanes<S>], cosines[kLanes<S>];
    const auto sum = hn::Add(before, by);
    store(sum, angles);
    const auto inside = hn::And(hn::Gt(sum, set(-trigonometry::kPi<S>)), hn::Le(sum, set(trigonometry::kPi<S>)));
    std::uint32_t beyond = bits_of<S>(hn::Not(inside));
    for (; beyond != 0; beyond &= beyond - 1) {
      S& each = angles[__builtin_ctz(beyond)];
      each = wrap_angle(each);
    }
    sin_cos_vectors(angles, sines, cosines);
    angle = load(angles);
    c = load(cosines);
    s = load(sines);
  }
};

// The one shape of a body that lies in its middle with the body's axes, or kNone: then there is more to a place than
// the body's pose.
template <class S>
HWY_INLINE std::uint32_t simple_shape(const StepEnd<S>& world, std::uint32_t slot) {
  const Body<S>& body = world.bodies[slot];
  if (body.shape_count != 1 || !body.dynamic()) return kNone;
  const Shape<S>& shape = world.shapes[body.first_shape];
  const std::uint32_t asked = kShapeCentred | (shape.shape_kind() == ShapeKind::kBox ? kShapeUpright : 0u);
  return (shape.flags & asked) == asked ? body.first_shape : kNone;
}

// How far shapes reach from their centroids.
template <class S>
struct Extents {
  Vector<S> low_x, low_y, high_x, high_y;

  // A box reaches as far as its corners, an outline as far as its vertices and its radius, and what has neither here (a
  // chain) no further than the disc around it. `half`: row half_width of the places; counts: of vertices.
  template <class RowsOf>
  HWY_INLINE Extents(const Columns<S>& half, Vector<S> counts, Vector<S> cosine, Vector<S> sine, Vector<S> disc,
                     const RowsOf& rows_of) {
    const auto zero = hn::Zero(Tag<S>());
    const auto box = hn::Gt(half.c1, zero);
    const auto outline = hn::AndNot(box, hn::Gt(counts, zero));
    const auto c = hn::Abs(cosine), s = hn::Abs(sine);
    high_x = hn::IfThenElse(box, hn::Add(hn::Mul(c, half.c0), hn::Mul(s, half.c1)), disc);
    high_y = hn::IfThenElse(box, hn::Add(hn::Mul(c, half.c1), hn::Mul(s, half.c0)), disc);
    low_x = hn::Neg(high_x);
    low_y = hn::Neg(high_y);
    if (hn::AllFalse(Tag<S>(), outline)) return;
    const int most = most_of(hn::IfThenElseZero(outline, counts));
    auto x0 = zero, y0 = zero, x1 = zero, y1 = zero;
    for (int k = 0; k < most; ++k) {
      const auto row = load_rows<S>([&](std::size_t i) { return rows_of(i)[k]; });
      const auto x = hn::Sub(hn::Mul(cosine, row.c0), hn::Mul(sine, row.c1));
      const auto y = hn::Add(hn::Mul(sine, row.c0), hn::Mul(cosine, row.c1));
      x0 = k == 0 ? x : smaller(x0, x);
      y0 = k == 0 ? y : smaller(y0, y);
      x1 = k == 0 ? x : larger(x1, x);
      y1 = k == 0 ? y : larger(y1, y);
    }
    low_x = hn::IfThenElse(outline, hn::Sub(x0, half.c0), low_x);
    low_y = hn::IfThenElse(outline, hn::Sub(y0, half.c0), low_y);
    high_x = hn::IfThenElse(outline, hn::Add(x1, half.c0), high_x);
    high_y = hn::IfThenElse(outline, hn::Add(y1, half.c0), high_y);
  }

 private:
  static HWY_INLINE int most_of(Vector<S> counts) {
    HWY_ALIGN S lanes[kLanes<S>];
    store(counts, lanes);
    S most = 0;
    for (std::size_t i = 0; i < hn::Lanes(Tag<S>()); ++i) most = lanes[i] > most ? lanes[i] : most;
    return static_cast<int>(most);
  }
};

// What a vector of shapes is followed by: where their bodies are, and how far those come and turn in a step.
template <class S>
struct Following {
  Vector<S> x, y, c, s;  // of the centroid, of the body
  Vector<S> way_x, way_y, turn;
  Vector<S> disc;  // m, around the body
};

// Sets places, but for the offsets of their centroids, and the bounds of those shapes that left them, a bit each.
template <class S, class PlaceOf, class ShapeOf, class RowsOf>
HWY_INLINE std::uint32_t follow_vector(const PlaceOf& place, const ShapeOf& shape, const RowsOf& rows_of,
                                       const Following<S>& to, std::uint32_t lanes) {
  const auto p1 = load_rows<S>([&](std::size_t i) { return &place(i)->half_width; });
  const auto p2 = load_rows<S>([&](std::size_t i) { return &place(i)->reach; });
  const auto p3 = load_rows<S>([&](std::size_t i) { return &place(i)->way_x; });
  const auto sizes = load_rows<S>([&](std::size_t i) { return &shape(i)->reach; });
  const auto fat = load_rows<S>([&](std::size_t i) { return shape(i)->fat.lower.data(); });
  const auto zero = hn::Zero(Tag<S>());
  store_rows<S>({to.x, to.y, to.c, to.s}, [&](std::size_t i) { return &place(i)->x; });
  store_rows<S>({p2.c0, p2.c1, to.turn, p2.c3}, [&](std::size_t i) { return &place(i)->reach; });
  store_rows<S>({to.way_x, to.way_y, p3.c2, zero}, [&](std::size_t i) { return &place(i)->way_x; });
  const Extents<S> extents(p1, hn::Abs(p3.c2), to.c, to.s, to.disc, rows_of);
  const auto low_x = hn::Sub(hn::Add(hn::Add(to.x, extents.low_x), smaller(to.way_x, zero)), sizes.c0);
  const auto low_y = hn::Sub(hn::Add(hn::Add(to.y, extents.low_y), smaller(to.way_y, zero)), sizes.c0);
  const auto high_x = hn::Add(hn::Add(hn::Add(to.x, extents.high_x), larger(to.way_x, zero)), sizes.c0);
  const auto high_y = hn::Add(hn::Add(hn::Add(to.y, extents.high_y), larger(to.way_y, zero)), sizes.c0);
  const auto inside = hn::And(hn::And(hn::Ge(low_x, fat.c0), hn::Ge(low_y, fat.c1)),
                              hn::And(hn::Le(high_x, fat.c2), hn::Le(high_y, fat.c3)));
  const std::uint32_t left = bits_of<S>(hn::Not(inside)) & lanes;
  if (left == 0) return 0;
  HWY_ALIGN S bounds[4][kLanes<S>];
  store(hn::Sub(low_x, sizes.c1), bounds[0]);
  store(hn::Sub(low_y, sizes.c1), bounds[1]);
  store(hn::Add(high_x, sizes.c1), bounds[2]);
  store(hn::Add(high_y, sizes.c1), bounds[3]);
  for (std::uint32_t rest = left; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<std::size_t>(__builtin_ctz(rest));
    S* const box = shape(i)->fat.lower.data();
    for (int k = 0; k < 4; ++k) box[k] = bounds[k][i];
  }
  return left;
}

// Nobody: what lanes without a body, or bodies without a simple shape, write to.
template <class S>
struct Nobody {
  Body<S> body;
  Motion<S> motion;
  Place<S> place;
  Shape<S> shape;
  Convex<S> convex;
  OutlineRows<S> outline{};
};

template <class S>
HWY_INLINE BlockEnd end_vector(const StepEnd<S>& world, const std::uint32_t* slots, std::size_t count,
                               Nobody<S>& nobody) {
  std::uint32_t proxies[kLanes<S>];
  std::uint32_t simple = 0;
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t i = 0; i < width; ++i) {
    proxies[i] = i < count ? simple_shape(world, slots[i]) : kNone;
    simple |= (proxies[i] != kNone ? 1u : 0u) << i;
  }
  const auto body = [&](std::size_t i) { return i < count ? &world.bodies[slots[i]] : &nobody.body; };
  const auto motion = [&](std::size_t i) { return i < count ? &world.motions[slots[i]] : &nobody.motion; };
  const auto m0 = load_rows<S>([&](std::size_t i) { return &motion(i)->vx; });
  const auto m1 = load_rows<S>([&](std::size_t i) { return &motion(i)->dy; });
  const auto b0 = load_rows<S>([&](std::size_t i) { return &body(i)->x; });
  const auto b1 = load_rows<S>([&](std::size_t i) { return &body(i)->s; });
  const auto b4 = load_rows<S>([&](std::size_t i) { return &body(i)->torque; });
  const auto zero = hn::Zero(Tag<S>()), one = set(S(1)), time_step = set(world.time_step);

  const S way_most = S(kSpeedMax) * world.time_step, turn_most = S(kAngularSpeedMax) * world.time_step;
  const auto vx = clamped(m0.c0, S(kSpeedMax)), vy = clamped(m0.c1, S(kSpeedMax));
  const auto w = clamped(m0.c2, S(kAngularSpeedMax));
  const auto dx = clamped(m0.c3, way_most), dy = clamped(m1.c0, way_most), da = clamped(m1.c1, turn_most);
  const auto x = hn::Add(b0.c0, dx), y = hn::Add(b0.c1, dy);
  const Turned<S> turned(b0.c2, da);
  const auto turns = hn::Ne(da, zero);
  const auto angle = hn::IfThenElse(turns, turned.angle, b0.c2);
  const auto c = hn::IfThenElse(turns, turned.c, b0.c3), s = hn::IfThenElse(turns, turned.s, b1.c0);

  // Also what the velocities do not show: bodies that overlap are pushed apart by bias alone.
  const auto extent_max = b4.c2;
  const auto turn = hn::Mul(hn::Abs(da), extent_max), turning = hn::Mul(hn::Abs(w), extent_max);
  const auto way2 = hn::Div(hn::Add(hn::Add(square<S>(dx), square<S>(dy)), square<S>(turn)), square<S>(time_step));
  const auto speed2 = larger(way2, hn::Add(hn::Add(square<S>(vx), square<S>(vy)), square<S>(turning)));
  const auto slow = hn::Le(speed2, set(S(kSleepSpeed * kSleepSpeed)));
  const auto sleep_time = hn::IfThenElse(slow, hn::Add(b4.c3, time_step), zero);

  store_rows<S>({x, y, angle, c}, [&](std::size_t i) { return &body(i)->x; });
  store_rows<S>({s, b1.c1, b1.c2, b1.c3}, [&](std::size_t i) { return &body(i)->s; });
  store_rows<S>({b4.c0, b4.c1, b4.c2, sleep_time}, [&](std::size_t i) { return &body(i)->torque; });
  store_rows<S>({vx, vy, w, zero}, [&](std::size_t i) { return &motion(i)->vx; });
  store_rows<S>({zero, zero, one, zero}, [&](std::size_t i) { return &motion(i)->dy; });

  const std::uint32_t all = (1u << (count < width ? count : width)) - 1;
  BlockEnd end{simple, 0, bits_of<S>(hn::Ge(sleep_time, set(S(kSleepTime)))) & all};
  if (simple == 0) return end;
  const auto place = [&](std::size_t i) { return proxies[i] != kNone ? &world.places[proxies[i]] : &nobody.place; };
  const auto shape = [&](std::size_t i) { return proxies[i] != kNone ? &world.shapes[proxies[i]] : &nobody.shape; };
  const auto rows_of = [&](std::size_t i) {
    return proxies[i] != kNone ? world.outlines[proxies[i]].rows : nobody.outline.rows;
  };
  const Following<S> to{x,         y, c, s, hn::Mul(vx, time_step), hn::Mul(vy, time_step), hn::Mul(turning, time_step),
                        extent_max};
  end.left = follow_vector<S>(place, shape, rows_of, to, simple);
  return end;
}

// As many shapes as a vector has lanes, with their bodies. Lanes from `count` on are nobody's.
template <class S>
struct SomeShapes {
  const StepEnd<S>& world;
  const std::uint32_t* proxies;
  std::size_t count;
  Nobody<S>& nobody;

  Shape<S>* shape(std::size_t i) const { return i < count ? &world.shapes[proxies[i]] : &nobody.shape; }
  Place<S>* place(std::size_t i) const { return i < count ? &world.places[proxies[i]] : &nobody.place; }
  auto rows(std::size_t i) const { return i < count ? world.outlines[proxies[i]].rows : nobody.outline.rows; }
  const Convex<S>* convex(std::size_t i) const { return i < count ? &world.convexes[proxies[i]] : &nobody.convex; }
  const Body<S>* body(std::size_t i) const { return i < count ? &world.bodies[shape(i)->body] : &nobody.body; }
  const Motion<S>* motion(std::size_t i) const { return i < count ? &world.motions[shape(i)->body] : &nobody.motion; }
  std::uint32_t lanes() const { return (1u << (count < hn::Lanes(Tag<S>()) ? count : hn::Lanes(Tag<S>()))) - 1; }
};

// Of shapes whose bodies have ended their step.
template <class S>
HWY_INLINE std::uint32_t follow_shapes(const SomeShapes<S>& of) {
  const auto m0 = load_rows<S>([&](std::size_t i) { return &of.motion(i)->vx; });
  const auto b0 = load_rows<S>([&](std::size_t i) { return &of.body(i)->x; });
  const auto b1 = load_rows<S>([&](std::size_t i) { return &of.body(i)->s; });
  const auto b4 = load_rows<S>([&](std::size_t i) { return &of.body(i)->torque; });
  const auto p1 = load_rows<S>([&](std::size_t i) { return &of.place(i)->half_width; });
  const auto middle = load_rows<S>([&](std::size_t i) { return of.convex(i)->centroid.data(); });
  const auto c = b0.c3, s = b1.c0, time_step = set(of.world.time_step);
  const auto arm_x = hn::Sub(middle.c0, b1.c1), arm_y = hn::Sub(middle.c1, b1.c2);
  const auto offset_x = hn::Sub(hn::Mul(c, arm_x), hn::Mul(s, arm_y));
  const auto offset_y = hn::Add(hn::Mul(s, arm_x), hn::Mul(c, arm_y));
  store_rows<S>({p1.c0, p1.c1, offset_x, offset_y}, [&](std::size_t i) { return &of.place(i)->half_width; });
  const auto turn = hn::Mul(hn::Mul(hn::Abs(m0.c2), b4.c2), time_step);
  const Following<S> to{hn::Add(b0.c0, offset_x),  hn::Add(b0.c1, offset_y),  c,    s,
                        hn::Mul(m0.c0, time_step), hn::Mul(m0.c1, time_step), turn, b4.c2};
  return follow_vector<S>([&](std::size_t i) { return of.place(i); }, [&](std::size_t i) { return of.shape(i); },
                          [&](std::size_t i) { return of.rows(i); }, to, of.lanes());
}

// Calls work(shapes) for each vector of as many shapes; what it answers, a bit a shape.
template <class S, class Work>
HWY_INLINE std::uint32_t for_each_vector(const StepEnd<S>& world, const std::uint32_t* proxies, std::size_t count,
                                         const Work& work) {
  Nobody<S> nobody;
  std::uint32_t found = 0;
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t lane = 0; lane < count; lane += width)
    found |= work(SomeShapes<S>{world, proxies + lane, count - lane, nobody}) << lane;
  return found;
}

template <class S>
std::uint32_t follow(const StepEnd<S>& world, const std::uint32_t* proxies, std::size_t count) {
  return for_each_vector(world, proxies, count, [](const SomeShapes<S>& of) HWY_ATTR { return follow_shapes(of); });
}

template <class S>
BlockEnd end_step(const StepEnd<S>& world, const std::uint32_t* slots, std::size_t count) {
  Nobody<S> nobody;
  BlockEnd all{0, 0, 0};
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t lane = 0; lane < count; lane += width) {
    const BlockEnd end = end_vector(world, slots + lane, count - lane, nobody);
    all.followed |= end.followed << lane;
    all.left |= end.left << lane;
    all.restful |= end.restful << lane;
  }
  return all;
}

// The way of a shape is within the boxes around it at its start and at its end and a little more for the arc between
// (bounds.cpp says how much), and a little more still for rounding.
template <class S>
HWY_INLINE std::uint32_t leaving_shapes(const SomeShapes<S>& of) {
  const auto m0 = load_rows<S>([&](std::size_t i) { return &of.motion(i)->vx; });
  const auto m1 = load_rows<S>([&](std::size_t i) { return &of.motion(i)->dy; });
  const auto b0 = load_rows<S>([&](std::size_t i) { return &of.body(i)->x; });
  const auto b4 = load_rows<S>([&](std::size_t i) { return &of.body(i)->torque; });
  const auto p0 = load_rows<S>([&](std::size_t i) { return &of.place(i)->x; });
  const auto p1 = load_rows<S>([&](std::size_t i) { return &of.place(i)->half_width; });
  const auto p3 = load_rows<S>([&](std::size_t i) { return &of.place(i)->way_x; });
  const auto fat = load_rows<S>([&](std::size_t i) { return of.shape(i)->fat.lower.data(); });
  const auto vertices = hn::Abs(p3.c2), disc = b4.c2;
  const auto turn_c = m1.c2, turn_s = m1.c3;
  const auto c = hn::Sub(hn::Mul(turn_c, p0.c2), hn::Mul(turn_s, p0.c3));
  const auto s = hn::Add(hn::Mul(turn_s, p0.c2), hn::Mul(turn_c, p0.c3));
  const auto x = hn::Add(hn::Add(b0.c0, m0.c3), hn::Sub(hn::Mul(turn_c, p1.c2), hn::Mul(turn_s, p1.c3)));
  const auto y = hn::Add(hn::Add(b0.c1, m1.c0), hn::Add(hn::Mul(turn_s, p1.c2), hn::Mul(turn_c, p1.c3)));
  const auto rows_of = [&](std::size_t i) { return of.rows(i); };
  const Extents<S> start(p1, vertices, p0.c2, p0.c3, disc, rows_of), end(p1, vertices, c, s, disc, rows_of);
  const auto turn = hn::Abs(m1.c1);
  const auto more = hn::Mul(disc, hn::Add(hn::Mul(set(S(0.125)), square<S>(turn)), set(S(kDiscSlack))));
  const auto low_x = hn::Sub(smaller(hn::Add(p0.c0, start.low_x), hn::Add(x, end.low_x)), more);
  const auto low_y = hn::Sub(smaller(hn::Add(p0.c1, start.low_y), hn::Add(y, end.low_y)), more);
  const auto high_x = hn::Add(larger(hn::Add(p0.c0, start.high_x), hn::Add(x, end.high_x)), more);
  const auto high_y = hn::Add(larger(hn::Add(p0.c1, start.high_y), hn::Add(y, end.high_y)), more);
  const auto inside = hn::And(hn::And(hn::Ge(low_x, fat.c0), hn::Ge(low_y, fat.c1)),
                              hn::And(hn::Le(high_x, fat.c2), hn::Le(high_y, fat.c3)));
  const auto known = hn::And(hn::Gt(vertices, hn::Zero(Tag<S>())), hn::Le(turn, set(S(1))));
  return of.lanes() & ~bits_of<S>(hn::And(inside, known));
}

template <class S>
std::uint32_t leaving(const StepEnd<S>& world, const std::uint32_t* proxies, std::size_t count) {
  return for_each_vector(world, proxies, count, [](const SomeShapes<S>& of) HWY_ATTR { return leaving_shapes(of); });
}

template <class S>
std::uint32_t fast(const Body<S>* bodies, const Motion<S>* motions, const std::uint32_t* slots, std::size_t count) {
  const Body<S> no_body;
  const Motion<S> no_motion;
  std::uint32_t found = 0;
  const auto width = hn::Lanes(Tag<S>());
  for (std::size_t lane = 0; lane < count; lane += width) {
    const auto body = [&](std::size_t i) { return lane + i < count ? &bodies[slots[lane + i]] : &no_body; };
    const auto motion = [&](std::size_t i) { return lane + i < count ? &motions[slots[lane + i]] : &no_motion; };
    const auto m0 = load_rows<S>([&](std::size_t i) { return &motion(i)->vx; });
    const auto m1 = load_rows<S>([&](std::size_t i) { return &motion(i)->dy; });
    const auto b2 = load_rows<S>([&](std::size_t i) { return &body(i)->inv_inertia; });
    const auto b4 = load_rows<S>([&](std::size_t i) { return &body(i)->torque; });
    const auto way = hn::Add(hn::Sqrt(hn::Add(square<S>(m0.c3), square<S>(m1.c0))), hn::Mul(hn::Abs(m1.c1), b4.c2));
    const auto dynamic = hn::Gt(b2.c1, hn::Zero(Tag<S>()));  // it has a mass
    const auto most = hn::IfThenElseZero(dynamic, hn::Mul(set(S(kFastFraction)), b4.c1));
    found |= bits_of<S>(hn::Gt(way, most)) << lane;
  }
  return found;
}

template <class S>
constexpr MotionKernels<S> kKernels{integrate_positions<S>, end_step<S>, follow<S>, leaving<S>, fast<S>};

}  // namespace

const MotionKernels<float>* float_motion_kernels() { return &kKernels<float>; }
const MotionKernels<double>* double_motion_kernels() { return &kKernels<double>; }

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace urto {

HWY_EXPORT(float_motion_kernels);
HWY_EXPORT(double_motion_kernels);

template <>
const MotionKernels<float>& motion_kernels<float>() {
  return *HWY_DYNAMIC_DISPATCH(float_motion_kernels)();
}
template <>
const MotionKernels<double>& motion_kernels<double>() {
  return *HWY_DYNAMIC_DISPATCH(double_motion_kernels)();
}

}  // namespace urto
#endif

// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/solver/contact_kernels.h"

#include <cstring>

#include "physics/constants.h"

// A few builds of these kernels are enough: the oldest processors, and each doubling of the width. Vectors of a length
// unknown to the compiler (SVE) cannot be members of a struct.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/solver/contact_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Multiplications and additions stay apart (no MulAdd), and comparisons choose by IfThenElse instead of Min and Max:
// both would differ between machines in rounding, or in the sign of zero.

template <class S>
using Tag = hn::CappedTag<S, static_cast<std::size_t>(kLanes<S>)>;
template <class S>
using Vector = hn::Vec<Tag<S>>;

template <class S>
HWY_INLINE Vector<S> load(const S* lanes) {
  return hn::Load(Tag<S>(), lanes);
}
template <class S>
HWY_INLINE void store(Vector<S> v, S* lanes) {
  hn::Store(v, Tag<S>(), lanes);
}
template <class S>
HWY_INLINE Vector<S> set(S value) {
  return hn::Set(Tag<S>(), value);
}
template <class V>
HWY_INLINE V larger(V a, V b) {
  return hn::IfThenElse(hn::Gt(b, a), b, a);
}

// The motions of the lanes' bodies, field by field.
template <class S>
struct Motions {
  Vector<S> vx, vy, w, dx, dy, da, c, s;
};

template <class S>
HWY_INLINE void load_velocities(const Motion<S>* motions, const std::uint32_t* slots, Motions<S>& m) {
  HWY_ALIGN S rows[4 * kLanes<S>];
  const std::size_t n = hn::Lanes(Tag<S>());
  for (std::size_t i = 0; i < n; ++i) std::memcpy(rows + 4 * i, &motions[slots[i]].vx, 4 * sizeof(S));
  hn::LoadInterleaved4(Tag<S>(), rows, m.vx, m.vy, m.w, m.dx);
}

template <class S>
HWY_INLINE void load_places(const Motion<S>* motions, const std::uint32_t* slots, Motions<S>& m) {
  HWY_ALIGN S rows[4 * kLanes<S>];
  const std::size_t n = hn::Lanes(Tag<S>());
  for (std::size_t i = 0; i < n; ++i) std::memcpy(rows + 4 * i, &motions[slots[i]].dy, 4 * sizeof(S));
  hn::LoadInterleaved4(Tag<S>(), rows, m.dy, m.da, m.c, m.s);
}

template <class S>
HWY_INLINE void store_velocities(const Motions<S>& m, Motion<S>* motions, const std::uint32_t* slots,
                                 const std::uint8_t* movable) {
  HWY_ALIGN S rows[4 * kLanes<S>];
  const std::size_t n = hn::Lanes(Tag<S>());
  hn::StoreInterleaved4(m.vx, m.vy, m.w, m.dx, Tag<S>(), rows);
  for (std::size_t i = 0; i < n; ++i)
    if (movable[i]) std::memcpy(&motions[slots[i]].vx, rows + 4 * i, 4 * sizeof(S));
}

// What all passes need of a few lanes of a block.
template <class S>
struct Lanes {
  using V = Vector<S>;
  ContactBlock<S>& block;
  std::size_t lane;
  Motions<S> a, b;
  V nx, ny, im_a, ii_a, im_b, ii_b, share_a, share_b, driftx, drifty;
  V shiftx, shifty;  // of the arms: the drift, unless it is too long

  HWY_INLINE Lanes(const Motion<S>* motions, ContactBlock<S>& from, std::size_t first) : block(from), lane(first) {
    load_velocities(motions, block.a + lane, a);
    load_velocities(motions, block.b + lane, b);
    load_places(motions, block.a + lane, a);
    load_places(motions, block.b + lane, b);
    nx = load(block.nx + lane);
    ny = load(block.ny + lane);
    im_a = load(block.inv_mass_a + lane);
    ii_a = load(block.inv_inertia_a + lane);
    im_b = load(block.inv_mass_b + lane);
    ii_b = load(block.inv_inertia_b + lane);
    share_a = load(block.share_a + lane);
    share_b = hn::Sub(set(S(1)), share_a);
    driftx = hn::Sub(b.dx, a.dx);
    drifty = hn::Sub(b.dy, a.dy);
    const auto drift2 = hn::Add(hn::Mul(driftx, driftx), hn::Mul(drifty, drifty));
    const auto follow = hn::Le(drift2, load(block.drift2_max + lane));
    shiftx = hn::IfThenElseZero(follow, driftx);
    shifty = hn::IfThenElseZero(follow, drifty);
  }
  HWY_INLINE void store_to(Motion<S>* motions) const {
    store_velocities(a, motions, block.a + lane, block.movable_a + lane);
    store_velocities(b, motions, block.b + lane, block.movable_b + lane);
  }
};

// The lever arms of a point now. Both bodies have moved by different amounts since the point was found; were the arms
// frozen, the two halves of an impulse would act at different world points and angular momentum would be made from
// nothing. So the drift of the centres is shared out between the arms, more of it to the heavier body's, unless the
// bodies race past each other (kDriftFraction).
template <class S>
struct Arms {
  Vector<S> ax, ay, bx, by;
  HWY_INLINE Arms(const Lanes<S>& k, const PointLanes<S>& p)
      : ax(hn::Add(load(p.ax + k.lane), hn::Mul(k.share_a, k.shiftx))),
        ay(hn::Add(load(p.ay + k.lane), hn::Mul(k.share_a, k.shifty))),
        bx(hn::Sub(load(p.bx + k.lane), hn::Mul(k.share_b, k.shiftx))),
        by(hn::Sub(load(p.by + k.lane), hn::Mul(k.share_b, k.shifty))) {}
};

template <class S>
HWY_INLINE void apply(Lanes<S>& k, const Arms<S>& r, Vector<S> px, Vector<S> py) {
  k.a.vx = hn::Sub(k.a.vx, hn::Mul(k.im_a, px));
  k.a.vy = hn::Sub(k.a.vy, hn::Mul(k.im_a, py));
  k.a.w = hn::Sub(k.a.w, hn::Mul(k.ii_a, hn::Sub(hn::Mul(r.ax, py), hn::Mul(r.ay, px))));
  k.b.vx = hn::Add(k.b.vx, hn::Mul(k.im_b, px));
  k.b.vy = hn::Add(k.b.vy, hn::Mul(k.im_b, py));
  k.b.w = hn::Add(k.b.w, hn::Mul(k.ii_b, hn::Sub(hn::Mul(r.bx, py), hn::Mul(r.by, px))));
}

// Of b's point against a's along a direction.
template <class S>
HWY_INLINE Vector<S> relative_velocity(const Lanes<S>& k, const Arms<S>& r, Vector<S> ux, Vector<S> uy) {
  const auto dvx = hn::Sub(hn::Sub(k.b.vx, hn::Mul(k.b.w, r.by)), hn::Sub(k.a.vx, hn::Mul(k.a.w, r.ay)));
  const auto dvy = hn::Sub(hn::Add(k.b.vy, hn::Mul(k.b.w, r.bx)), hn::Add(k.a.vy, hn::Mul(k.a.w, r.ax)));
  return hn::Add(hn::Mul(dvx, ux), hn::Mul(dvy, uy));
}

// r × u.
template <class V>
HWY_INLINE V lever(V rx, V ry, V ux, V uy) {
  return hn::Sub(hn::Mul(rx, uy), hn::Mul(ry, ux));
}

template <class S>
HWY_INLINE void prepare_point(Lanes<S>& k, PointLanes<S>& p) {
  const std::size_t i = k.lane;
  const auto one = set(S(1)), zero = hn::Zero(Tag<S>());
  const auto ax = load(p.ax + i), ay = load(p.ay + i), bx = load(p.bx + i), by = load(p.by + i);
  const auto tx = k.ny, ty = hn::Sub(zero, k.nx);
  const auto na = lever(ax, ay, k.nx, k.ny), nb = lever(bx, by, k.nx, k.ny);
  const auto ta = lever(ax, ay, tx, ty), tb = lever(bx, by, tx, ty);
  const auto masses = hn::Add(k.im_a, k.im_b);
  const auto kn = hn::Add(hn::Add(masses, hn::Mul(hn::Mul(k.ii_a, na), na)), hn::Mul(hn::Mul(k.ii_b, nb), nb));
  const auto kt = hn::Add(hn::Add(masses, hn::Mul(hn::Mul(k.ii_a, ta), ta)), hn::Mul(hn::Mul(k.ii_b, tb), tb));
  store(kn, p.inverse_mass + i);
  store(hn::Div(one, kt), p.tangent_mass + i);
  const Arms<S> r(k, p);
  store(relative_velocity(k, r, k.nx, k.ny), p.approach + i);
}

// m², the shorter of a point's two arms.
template <class S>
HWY_INLINE Vector<S> shortest_arm2(const Lanes<S>& k, const PointLanes<S>& p) {
  const auto ax = load(p.ax + k.lane), ay = load(p.ay + k.lane), bx = load(p.bx + k.lane), by = load(p.by + k.lane);
  const auto a2 = hn::Add(hn::Mul(ax, ax), hn::Mul(ay, ay)), b2 = hn::Add(hn::Mul(bx, bx), hn::Mul(by, by));
  return hn::IfThenElse(hn::Lt(b2, a2), b2, a2);
}

template <class S>
HWY_INLINE void prepare_lanes(Lanes<S>& k) {
  const std::size_t i = k.lane;
  PointLanes<S>&p = k.block.points[0], &q = k.block.points[1];
  k.share_a = hn::Div(k.im_b, hn::Add(k.im_a, k.im_b));
  store(k.share_a, k.block.share_a + i);
  prepare_point(k, p);
  prepare_point(k, q);
  const auto arm2 = shortest_arm2(k, p);
  const auto second = hn::IfThenElse(hn::Gt(load(k.block.two + i), hn::Zero(Tag<S>())), shortest_arm2(k, q), arm2);
  store(hn::Mul(set(S(kDriftFraction * kDriftFraction)), hn::IfThenElse(hn::Lt(second, arm2), second, arm2)),
        k.block.drift2_max + i);
  const auto pa = lever(load(p.ax + i), load(p.ay + i), k.nx, k.ny),
             pb = lever(load(p.bx + i), load(p.by + i), k.nx, k.ny);
  const auto qa = lever(load(q.ax + i), load(q.ay + i), k.nx, k.ny),
             qb = lever(load(q.bx + i), load(q.by + i), k.nx, k.ny);
  const auto turning = hn::Add(hn::Mul(hn::Mul(k.ii_a, pa), qa), hn::Mul(hn::Mul(k.ii_b, pb), qb));
  store(hn::Add(hn::Add(k.im_a, k.im_b), turning), k.block.coupling + i);
}

template <class S>
HWY_INLINE void warm_start_lanes(Lanes<S>& k) {
  for (PointLanes<S>& p : k.block.points) {
    const Arms<S> r(k, p);
    const auto normal = load(p.normal_impulse + k.lane), tangent = load(p.tangent_impulse + k.lane);
    apply(k, r, hn::Add(hn::Mul(normal, k.nx), hn::Mul(tangent, k.ny)),
          hn::Sub(hn::Mul(normal, k.ny), hn::Mul(tangent, k.nx)));
  }
}

template <class S>
HWY_INLINE void solve_friction(Lanes<S>& k) {
  const auto zero = hn::Zero(Tag<S>());
  const auto friction = load(k.block.friction + k.lane);
  const auto tx = k.ny, ty = hn::Sub(zero, k.nx);
  for (PointLanes<S>& p : k.block.points) {
    const Arms<S> r(k, p);
    const auto vt = relative_velocity(k, r, tx, ty);
    const auto bound = hn::Mul(friction, load(p.normal_impulse + k.lane)), low = hn::Sub(zero, bound);
    const auto before = load(p.tangent_impulse + k.lane);
    auto next = hn::Sub(before, hn::Mul(load(p.tangent_mass + k.lane), vt));
    next = hn::IfThenElse(hn::Gt(next, bound), bound, next);
    next = hn::IfThenElse(hn::Lt(next, low), low, next);
    store(next, p.tangent_impulse + k.lane);
    const auto impulse = hn::Sub(next, before);
    apply(k, r, hn::Mul(impulse, tx), hn::Mul(impulse, ty));
  }
}

// What a point asks of its relative normal velocity: v + bias = −γ (λ − P), where γ is its compliance, P its preload.
template <class S>
struct Demand {
  Vector<S> bias, compliance;
};

template <class S, bool kUseBias>
HWY_INLINE Demand<S> demand_of(const Lanes<S>& k, const PointLanes<S>& p, const PassSettings<S>& settings) {
  const auto zero = hn::Zero(Tag<S>());
  const auto ax = load(p.ax + k.lane), ay = load(p.ay + k.lane), bx = load(p.bx + k.lane), by = load(p.by + k.lane);
  // Where the anchors are now: material points, turned with their bodies.
  const auto rx = hn::Sub(hn::Sub(hn::Sub(hn::Mul(k.b.c, bx), hn::Mul(k.b.s, by)), bx),
                          hn::Sub(hn::Sub(hn::Mul(k.a.c, ax), hn::Mul(k.a.s, ay)), ax));
  const auto ry = hn::Sub(hn::Sub(hn::Add(hn::Mul(k.b.s, bx), hn::Mul(k.b.c, by)), by),
                          hn::Sub(hn::Add(hn::Mul(k.a.s, ax), hn::Mul(k.a.c, ay)), ay));
  const auto along = hn::Add(hn::Mul(hn::Add(k.driftx, rx), k.nx), hn::Mul(hn::Add(k.drifty, ry), k.ny));
  const auto s = hn::Add(load(p.separation + k.lane), along);
  const auto apart = hn::Gt(s, zero);
  const auto closing = hn::Mul(s, set(settings.inv_h));  // may close the gap in this sub-step, not more
  if (!kUseBias) return {hn::IfThenElse(apart, closing, zero), zero};
  const auto pushing = larger(hn::Mul(set(settings.bias_rate), s), set(S(-kPushSpeedMax)));
  const auto soft = hn::Mul(set(settings.compliance), load(p.inverse_mass + k.lane));
  return {hn::IfThenElse(apart, closing, pushing), hn::IfThenElse(apart, zero, soft)};
}

template <class V>
struct TwoImpulses {
  V first, second;
};

// Both points of a manifold at once, so that neither side is favoured: the linear complementarity problem
//   w = K λ − q ≥ 0,  λ ≥ 0,  w·λ = 0
// by trying which points push (Catto, "Block solver", Box2D 2). Lanes with one point solve that alone.
template <class S, class V = Vector<S>>
HWY_INLINE TwoImpulses<V> solve_two(V two, V k11, V k12, V k22, V q1, V q2) {
  const auto zero = hn::Zero(Tag<S>());
  const auto k11_k22 = hn::Mul(k11, k22);
  const auto determinant = hn::Sub(k11_k22, hn::Mul(k12, k12));
  const auto d1 = hn::Sub(hn::Mul(k22, q1), hn::Mul(k12, q2)), d2 = hn::Sub(hn::Mul(k11, q2), hn::Mul(k12, q1));
  const auto has_two = hn::Gt(two, zero);
  const auto regular = hn::And(has_two, hn::Gt(determinant, hn::Mul(set(S(kDeterminantMin)), k11_k22)));
  const auto both = hn::And(regular, hn::And(hn::Ge(d1, zero), hn::Ge(d2, zero)));
  const auto first = hn::And(hn::Ge(q1, zero), hn::Or(hn::Not(has_two), hn::Ge(hn::Mul(k12, q1), hn::Mul(k11, q2))));
  const auto second = hn::And(has_two, hn::And(hn::Ge(q2, zero), hn::Ge(hn::Mul(k12, q2), hn::Mul(k22, q1))));
  const auto l1 = hn::Div(hn::IfThenElse(both, d1, q1), hn::IfThenElse(both, determinant, k11));
  const auto l2 = hn::Div(hn::IfThenElse(both, d2, q2), hn::IfThenElse(both, determinant, k22));
  const auto only_second = hn::AndNot(hn::Or(both, first), second);
  return {hn::IfThenElseZero(hn::Or(both, first), l1), hn::IfThenElseZero(hn::Or(both, only_second), l2)};
}

// Changes the normal impulse of a point to `next`.
template <class S>
HWY_INLINE void push(Lanes<S>& k, PointLanes<S>& p, const Arms<S>& r, Vector<S> next) {
  const auto impulse = hn::Sub(next, load(p.normal_impulse + k.lane));
  store(next, p.normal_impulse + k.lane);
  apply(k, r, hn::Mul(impulse, k.nx), hn::Mul(impulse, k.ny));
}

// λ of both points: (K + γ) λ = K λ₀ − v − bias + γ P where they push.
template <class S, bool kUseBias>
HWY_INLINE void solve_normals(Lanes<S>& k, const PassSettings<S>& settings) {
  PointLanes<S>&p1 = k.block.points[0], &p2 = k.block.points[1];
  const Demand<S> d1 = demand_of<S, kUseBias>(k, p1, settings), d2 = demand_of<S, kUseBias>(k, p2, settings);
  const Arms<S> r1(k, p1), r2(k, p2);
  const auto v1 = relative_velocity(k, r1, k.nx, k.ny), v2 = relative_velocity(k, r2, k.nx, k.ny);
  const auto l1 = load(p1.normal_impulse + k.lane), l2 = load(p2.normal_impulse + k.lane);
  const auto m1 = load(p1.inverse_mass + k.lane), m2 = load(p2.inverse_mass + k.lane);
  const auto two = load(k.block.two + k.lane), coupling = load(k.block.coupling + k.lane);
  auto q1 = hn::Sub(hn::Sub(hn::Add(hn::Mul(m1, l1), hn::Mul(coupling, l2)), v1), d1.bias);
  auto q2 = hn::Sub(hn::Sub(hn::Add(hn::Mul(coupling, l1), hn::Mul(m2, l2)), v2), d2.bias);
  auto k11 = m1, k22 = m2;
  if (kUseBias) {
    q1 = hn::Add(q1, hn::Mul(d1.compliance, load(p1.preload + k.lane)));
    q2 = hn::Add(q2, hn::Mul(d2.compliance, load(p2.preload + k.lane)));
    k11 = hn::Add(k11, d1.compliance);
    k22 = hn::Add(k22, d2.compliance);
  }
  const auto next = solve_two<S>(two, k11, coupling, k22, q1, q2);
  push(k, p1, r1, next.first);
  push(k, p2, r2, next.second);
}

template <class S>
HWY_INLINE void add_to_totals(Lanes<S>& k, const PassSettings<S>& settings) {
  for (PointLanes<S>& p : k.block.points) {
    const auto normal = load(p.normal_impulse + k.lane), preload = load(p.preload + k.lane);
    store(hn::Add(preload, hn::Mul(set(settings.preload_rate), hn::Sub(normal, preload))), p.preload + k.lane);
    store(hn::Add(load(p.total_normal_impulse + k.lane), normal), p.total_normal_impulse + k.lane);
    store(hn::Add(load(p.total_tangent_impulse + k.lane), load(p.tangent_impulse + k.lane)),
          p.total_tangent_impulse + k.lane);
  }
}

// The speed at which restitution lets a point leave: e times that at which it closed in, if that was fast enough and
// the point pushed; 0 if not.
template <class S>
HWY_INLINE Vector<S> leaving_speed(const Lanes<S>& k, const PointLanes<S>& p, const PassSettings<S>& settings) {
  const auto zero = hn::Zero(Tag<S>());
  const auto approach = load(p.approach + k.lane);
  const auto bounces =
      hn::And(hn::Le(approach, set(-settings.threshold)), hn::Gt(load(p.total_normal_impulse + k.lane), zero));
  return hn::IfThenElseZero(bounces, hn::Mul(load(k.block.restitution + k.lane), hn::Sub(zero, approach)));
}

// Newton's restitution for a contact that was hit in this step: each point that closed in faster than the threshold
// and pushed leaves at e times that speed; the others must only not close in.
template <class S>
HWY_INLINE void restitute_lanes(Lanes<S>& k, const PassSettings<S>& settings) {
  const auto zero = hn::Zero(Tag<S>());
  PointLanes<S>&p1 = k.block.points[0], &p2 = k.block.points[1];
  const auto two = load(k.block.two + k.lane), coupling = load(k.block.coupling + k.lane);
  const auto u1 = leaving_speed(k, p1, settings), u2 = leaving_speed(k, p2, settings);
  const auto bounces = hn::Or(hn::Gt(u1, zero), hn::Gt(u2, zero));
  const Arms<S> r1(k, p1), r2(k, p2);
  const auto v1 = relative_velocity(k, r1, k.nx, k.ny), v2 = relative_velocity(k, r2, k.nx, k.ny);
  const auto l1 = load(p1.normal_impulse + k.lane), l2 = load(p2.normal_impulse + k.lane);
  const auto m1 = load(p1.inverse_mass + k.lane), m2 = load(p2.inverse_mass + k.lane);
  const auto q1 = hn::Add(hn::Sub(hn::Add(hn::Mul(m1, l1), hn::Mul(coupling, l2)), v1), u1);
  const auto q2 = hn::Add(hn::Sub(hn::Add(hn::Mul(coupling, l1), hn::Mul(m2, l2)), v2), u2);
  auto next = solve_two<S>(two, m1, coupling, m2, q1, q2);
  next.first = hn::IfThenElse(bounces, next.first, l1);
  next.second = hn::IfThenElse(bounces, next.second, l2);
  store(hn::Add(load(p1.total_normal_impulse + k.lane), hn::Sub(next.first, l1)), p1.total_normal_impulse + k.lane);
  store(hn::Add(load(p2.total_normal_impulse + k.lane), hn::Sub(next.second, l2)), p2.total_normal_impulse + k.lane);
  push(k, p1, r1, next.first);
  push(k, p2, r2, next.second);
}

// Calls work(lanes) for each vector of each block, in order; writes velocities back if kMoves.
template <class S, bool kMoves, class Work>
HWY_INLINE void for_each_vector(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const Work& work) {
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t lane = 0; lane < blocks[i].count; lane += width) {
      Lanes<S> k(motions, blocks[i], lane);
      work(k);
      if (kMoves) k.store_to(motions);
    }
  }
}

template <class S>
void prepare(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const PassSettings<S>&) {
  for_each_vector<S, false>(motions, blocks, count, [](Lanes<S>& k) HWY_ATTR { prepare_lanes(k); });
}

template <class S>
void warm_start(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const PassSettings<S>&) {
  for_each_vector<S, true>(motions, blocks, count, [](Lanes<S>& k) HWY_ATTR { warm_start_lanes(k); });
}

// With bias friction comes first, so that the last word before bodies move is that they do not penetrate.
template <class S>
void solve(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const PassSettings<S>& settings) {
  for_each_vector<S, true>(motions, blocks, count, [&settings](Lanes<S>& k) HWY_ATTR {
    if (settings.friction) solve_friction(k);
    solve_normals<S, true>(k, settings);
  });
}

// In the relaxation friction comes last, bounded by the impulse without the spring's share: a bound from the spring
// would make a slope a little too slippery.
template <class S>
void relax(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const PassSettings<S>& settings) {
  for_each_vector<S, true>(motions, blocks, count, [&settings](Lanes<S>& k) HWY_ATTR {
    solve_normals<S, false>(k, settings);
    if (settings.friction) solve_friction(k);
    add_to_totals(k, settings);
  });
}

template <class S>
void restitute(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const PassSettings<S>& settings) {
  for_each_vector<S, true>(motions, blocks, count, [&settings](Lanes<S>& k) HWY_ATTR { restitute_lanes(k, settings); });
}

template <class S>
constexpr ContactPasses<S> kPasses{prepare<S>, warm_start<S>, solve<S>, relax<S>, restitute<S>};

}  // namespace

const ContactPasses<float>* float_passes() { return &kPasses<float>; }
const ContactPasses<double>* double_passes() { return &kPasses<double>; }

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace urto {

HWY_EXPORT(float_passes);
HWY_EXPORT(double_passes);

template <>
const ContactPasses<float>& contact_passes<float>() {
  return *HWY_DYNAMIC_DISPATCH(float_passes)();
}
template <>
const ContactPasses<double>& contact_passes<double>() {
  return *HWY_DYNAMIC_DISPATCH(double_passes)();
}

#ifdef HWY_COMPILE_ONLY_STATIC  // for one processor, without Highway's library
std::vector<SimdTarget> simd_targets() { return {{HWY_STATIC_TARGET, "static"}}; }
void use_simd_target(std::int64_t) {}
#else
std::vector<SimdTarget> simd_targets() {
  std::vector<SimdTarget> out;
  const std::int64_t usable = HWY_TARGETS & hwy::SupportedTargets();
  for (std::int64_t rest = usable; rest != 0; rest &= rest - 1) {
    const std::int64_t id = rest & ~(rest - 1);
    out.push_back({id, hwy::TargetName(id)});
  }
  return out;
}

void use_simd_target(std::int64_t id) {
  hwy::SetSupportedTargetsForTest(id);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
#endif

}  // namespace urto
#endif

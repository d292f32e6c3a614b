// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/solver/contact_kernels.h"

#include <atomic>

#include "physics/constants.h"
#include "physics/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/solver/contact_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "physics/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {
namespace {

// The first rows of what bodies have. Those that cannot move are left alone: other lanes may hold them too. In most
// vectors all can, or none.
template <class S, class Record>
HWY_INLINE void store_movable(const Columns<S>& m, Record* records, const std::uint32_t* slots, std::uint32_t movable) {
  const std::uint32_t all = (1u << hn::Lanes(Tag<S>())) - 1;
  if ((movable & all) == all) {
    store_rows<S>(m, [&](std::size_t i) { return &records[slots[i]].vx; });
  } else if ((movable & all) != 0) {
    Record nowhere;
    store_rows<S>(m, [&](std::size_t i) { return (movable >> i) & 1u ? &records[slots[i]].vx : &nowhere.vx; });
  }
}

// The velocities and the ways of a few lanes' bodies.
template <class S>
struct Bodies {
  Vector<S> vx, vy, w, dx, dy, da, c, s;
  Vector<S> im, ii;

  HWY_INLINE Bodies(const Motion<S>* motions, const std::uint32_t* slots, const S* inv_mass, const S* inv_inertia,
                    bool moved) {
    const auto m0 = load_rows<S>([&](std::size_t i) { return &motions[slots[i]].vx; });
    vx = m0.c0;
    vy = m0.c1;
    w = m0.c2;
    dx = m0.c3;
    dy = da = s = hn::Zero(Tag<S>());
    c = set(S(1));
    if (moved) {
      const auto m1 = load_rows<S>([&](std::size_t i) { return &motions[slots[i]].dy; });
      dy = m1.c0;
      da = m1.c1;
      c = m1.c2;
      s = m1.c3;
    }
    im = load(inv_mass);
    ii = load(inv_inertia);
  }
  HWY_INLINE void store_to(Motion<S>* motions, const std::uint32_t* slots, std::uint32_t movable) const {
    store_movable<S>({vx, vy, w, dx}, motions, slots, movable);
  }
};

// What all passes need of a few lanes of a block, in the contact's own axes: n and t = (n_y, −n_x).
//
// The lever arms are those of now. Both bodies have moved by different amounts since the point was found; were the arms
// frozen, the two halves of an impulse would act at different world points and angular momentum would be made from
// nothing. So the drift of the centres is shared out between the arms, more of it to the heavier body's, unless the
// bodies race past each other (kDriftFraction).
template <class S>
struct Lanes {
  using V = Vector<S>;
  ContactBlock<S>& block;
  const std::size_t lane;
  const bool moved;  // bodies have, in this step: known when this is compiled
  Bodies<S> a, b;
  V nx, ny;
  V drift_along;  // m, of b against a since the start of the step
  V between_along, between_lever;
  V shift_a_along, shift_a_lever, shift_b_along, shift_b_lever;  // m, of the arms
  V speed_along, speed_across;                                   // m/s, of b's centre against a's: along n, along t
  V push_along, push_across;                                     // N·s, applied so far in this pass

  HWY_INLINE Lanes(const Motion<S>* motions, ContactBlock<S>& from, std::size_t first, bool have_moved)
      : block(from),
        lane(first),
        moved(have_moved),
        a(motions, from.a + first, from.inv_mass_a + first, from.inv_inertia_a + first, have_moved),
        b(motions, from.b + first, from.inv_mass_b + first, from.inv_inertia_b + first, have_moved),
        nx(load(from.nx + first)),
        ny(load(from.ny + first)),
        between_along(load(from.between_along + first)),
        between_lever(load(from.between_lever + first)),
        push_along(hn::Zero(Tag<S>())),
        push_across(hn::Zero(Tag<S>())) {
    const auto vx = hn::Sub(b.vx, a.vx), vy = hn::Sub(b.vy, a.vy);
    speed_along = hn::Add(hn::Mul(vx, nx), hn::Mul(vy, ny));
    speed_across = hn::Sub(hn::Mul(vx, ny), hn::Mul(vy, nx));
    if (moved) {
      find_shifts();
    } else {
      drift_along = shift_a_along = shift_a_lever = hn::Zero(Tag<S>());
      shift_b_along = hn::Neg(between_along);
      shift_b_lever = hn::Neg(between_lever);
    }
  }

  HWY_INLINE void find_shifts() {
    const auto driftx = hn::Sub(b.dx, a.dx), drifty = hn::Sub(b.dy, a.dy);
    const auto drift2 = hn::Add(hn::Mul(driftx, driftx), hn::Mul(drifty, drifty));
    const auto follow = hn::Le(drift2, load(block.drift2_max + lane));
    const auto share_a = load(block.share_a + lane);
    drift_along = hn::Add(hn::Mul(driftx, nx), hn::Mul(drifty, ny));
    const auto along = hn::IfThenElseZero(follow, drift_along);
    const auto lever = hn::IfThenElseZero(follow, hn::Sub(hn::Mul(driftx, ny), hn::Mul(drifty, nx)));
    shift_a_along = hn::Mul(share_a, along);
    shift_a_lever = hn::Mul(share_a, lever);
    shift_b_along = hn::Sub(shift_a_along, hn::Add(between_along, along));
    shift_b_lever = hn::Sub(shift_a_lever, hn::Add(between_lever, lever));
  }

  HWY_INLINE void store_to(Motion<S>* motions) {
    const auto px = hn::Add(hn::Mul(push_along, nx), hn::Mul(push_across, ny));
    const auto py = hn::Sub(hn::Mul(push_along, ny), hn::Mul(push_across, nx));
    a.vx = hn::Sub(a.vx, hn::Mul(a.im, px));
    a.vy = hn::Sub(a.vy, hn::Mul(a.im, py));
    b.vx = hn::Add(b.vx, hn::Mul(b.im, px));
    b.vy = hn::Add(b.vy, hn::Mul(b.im, py));
    a.store_to(motions, block.a + lane, block.movable_a >> lane);
    b.store_to(motions, block.b + lane, block.movable_b >> lane);
  }
};

// The arms of a point's impulses: r×n of the normal one, r×t = −r·n of the tangential one.
template <class S>
struct Arms {
  Vector<S> along, lever;  // of the anchor as it was found
  Vector<S> normal_a, normal_b, tangent_a, tangent_b;

  HWY_INLINE Arms(const Lanes<S>& k, const PointLanes<S>& p)
      : along(load(p.along + k.lane)),
        lever(load(p.lever + k.lane)),
        normal_a(k.moved ? hn::Add(lever, k.shift_a_lever) : lever),
        normal_b(hn::Add(lever, k.shift_b_lever)),
        tangent_a(hn::Neg(k.moved ? hn::Add(along, k.shift_a_along) : along)),
        tangent_b(hn::Neg(hn::Add(along, k.shift_b_along))) {}
};

// m/s, of b's point against a's.
template <class S>
HWY_INLINE Vector<S> normal_speed(const Lanes<S>& k, const Arms<S>& r) {
  return hn::Add(k.speed_along, hn::Sub(hn::Mul(k.b.w, r.normal_b), hn::Mul(k.a.w, r.normal_a)));
}

// What an impulse along one direction at one point does to the bodies: its arms, and how much an impulse of 1 turns.
template <class S>
struct Direction {
  Vector<S> arm_a, arm_b;    // m
  Vector<S> turn_a, turn_b;  // 1/(kg·m)

  HWY_INLINE Direction(const Lanes<S>& k, Vector<S> of_a, Vector<S> of_b)
      : arm_a(of_a), arm_b(of_b), turn_a(hn::Mul(k.a.ii, of_a)), turn_b(hn::Mul(k.b.ii, of_b)) {}
};
template <class S>
HWY_INLINE Direction<S> normal_of(const Lanes<S>& k, const Arms<S>& r) {
  return {k, r.normal_a, r.normal_b};
}
template <class S>
HWY_INLINE Direction<S> tangent_of(const Lanes<S>& k, const Arms<S>& r) {
  return {k, r.tangent_a, r.tangent_b};
}

// m/s across the normal, of b against a.
template <class S>
HWY_INLINE Vector<S> sliding_speed(const Lanes<S>& k, const Direction<S>& t) {
  return hn::Add(k.speed_across, hn::Sub(hn::Mul(k.b.w, t.arm_b), hn::Mul(k.a.w, t.arm_a)));
}

// 1/kg: the speed that an impulse of 1 along one direction makes along the other by turning the bodies.
template <class S>
HWY_INLINE Vector<S> coupling(const Direction<S>& p, const Direction<S>& q) {
  return hn::Add(hn::Mul(p.turn_a, q.arm_a), hn::Mul(p.turn_b, q.arm_b));
}

template <class V>
struct TwoImpulses {
  V first, second;
};

template <class S>
struct PointImpulses {
  TwoImpulses<Vector<S>> normal, tangent;
};

// The directions in which both points of a manifold push.
template <class S>
struct Points {
  Arms<S> r1, r2;
  Direction<S> n1, n2, t1, t2;

  HWY_INLINE explicit Points(const Lanes<S>& k)
      : r1(k, k.block.points[0]),
        r2(k, k.block.points[1]),
        n1(normal_of(k, r1)),
        n2(normal_of(k, r2)),
        t1(tangent_of(k, r1)),
        t2(tangent_of(k, r2)) {}
};

// Impulses at both points along parallel directions, on the bodies' spins and on what is pushed along those.
template <class S>
HWY_INLINE void push(Lanes<S>& k, const Direction<S>& p, const Direction<S>& q, const TwoImpulses<Vector<S>>& impulses,
                     Vector<S>& pushed) {
  pushed = hn::Add(pushed, hn::Add(impulses.first, impulses.second));
  k.a.w = hn::Sub(k.a.w, hn::Add(hn::Mul(p.turn_a, impulses.first), hn::Mul(q.turn_a, impulses.second)));
  k.b.w = hn::Add(k.b.w, hn::Add(hn::Mul(p.turn_b, impulses.first), hn::Mul(q.turn_b, impulses.second)));
}

// The same impulses once more, on what the bodies' next sub-step begins with; or less.
template <class S>
HWY_INLINE void kick(const Lanes<S>& k, const Points<S>& at, const PointImpulses<S>& i, Kick<S>* kicks) {
  const auto along = hn::Add(i.normal.first, i.normal.second), across = hn::Add(i.tangent.first, i.tangent.second);
  const auto px = hn::Add(hn::Mul(along, k.nx), hn::Mul(across, k.ny));
  const auto py = hn::Sub(hn::Mul(along, k.ny), hn::Mul(across, k.nx));
  const auto turned = [&](Vector<S> Direction<S>::*turn) HWY_ATTR {
    const auto by_normals = hn::Add(hn::Mul(at.n1.*turn, i.normal.first), hn::Mul(at.n2.*turn, i.normal.second));
    const auto by_tangents = hn::Add(hn::Mul(at.t1.*turn, i.tangent.first), hn::Mul(at.t2.*turn, i.tangent.second));
    return hn::Add(by_normals, by_tangents);
  };
  const std::uint32_t *a = k.block.a + k.lane, *b = k.block.b + k.lane;
  const auto of_a = load_rows<S>([&](std::size_t lane) { return &kicks[a[lane]].vx; });
  const auto of_b = load_rows<S>([&](std::size_t lane) { return &kicks[b[lane]].vx; });
  store_movable<S>({hn::Sub(of_a.c0, hn::Mul(k.a.im, px)), hn::Sub(of_a.c1, hn::Mul(k.a.im, py)),
                    hn::Sub(of_a.c2, turned(&Direction<S>::turn_a)), of_a.c3},
                   kicks, a, k.block.movable_a >> k.lane);
  store_movable<S>({hn::Add(of_b.c0, hn::Mul(k.b.im, px)), hn::Add(of_b.c1, hn::Mul(k.b.im, py)),
                    hn::Add(of_b.c2, turned(&Direction<S>::turn_b)), of_b.c3},
                   kicks, b, k.block.movable_b >> k.lane);
}

// Taking over manifolds -------------------------------------------------------------------------------------------

// An impulse of the points before, for the point with this id: what the feature had, 0 if it is new.
template <class S>
struct Match {
  Mask<S> first, second;
  HWY_INLINE Vector<S> carry(Vector<S> of_first, Vector<S> of_second) const {
    return hn::IfThenElse(first, of_first, hn::IfThenElseZero(second, of_second));
  }
};

template <class S>
HWY_INLINE void carry_over(PointLanes<S>& p, PointLanes<S>& q, const Match<S>& to_p, const Match<S>& to_q,
                           S (PointLanes<S>::*field)[kLanes<S>], std::size_t lane) {
  const auto first = load(&(p.*field)[lane]), second = load(&(q.*field)[lane]);
  store(to_p.carry(first, second), &(p.*field)[lane]);
  store(to_q.carry(first, second), &(q.*field)[lane]);
}

template <class S>
HWY_INLINE void take_point(Lanes<S>& k, PointLanes<S>& p, S* approach) {
  const std::size_t i = k.lane;
  const auto one = set(S(1)), zero = hn::Zero(Tag<S>());
  const Arms<S> r(k, p);
  const auto masses = hn::Add(k.a.im, k.b.im);
  const auto square = [](auto inertia, auto arm) HWY_ATTR { return hn::Mul(hn::Mul(inertia, arm), arm); };
  const auto kn = hn::Add(hn::Add(masses, square(k.a.ii, r.normal_a)), square(k.b.ii, r.normal_b));
  const auto kt = hn::Add(hn::Add(masses, square(k.a.ii, r.tangent_a)), square(k.b.ii, r.tangent_b));
  store(kn, p.inverse_mass + i);
  store(hn::Div(one, kt), p.tangent_mass + i);
  store(zero, p.total_normal_impulse + i);
  store(zero, p.total_tangent_impulse + i);
  store(normal_speed(k, r), approach + i);
}

template <class S>
HWY_INLINE void take_lanes(const Motion<S>* motions, const ManifoldLanes<S>& m, ContactBlock<S>& block,
                           ContactBlockRest<S>& rest, std::size_t i) {
  PointLanes<S>&p = block.points[0], &q = block.points[1];
  const auto two = hn::Gt(load(m.count + i), set(S(1)));
  const auto id_p = load(m.id[0] + i), id_q = hn::IfThenElse(two, load(m.id[1] + i), set(S(kNoPoint)));
  const auto old_p = load(rest.id[0] + i), old_q = load(rest.id[1] + i);
  const Match<S> to_p{hn::Eq(id_p, old_p), hn::Eq(id_p, old_q)};
  const Match<S> to_q{hn::And(two, hn::Eq(id_q, old_p)), hn::And(two, hn::Eq(id_q, old_q))};
  carry_over(p, q, to_p, to_q, &PointLanes<S>::normal_impulse, i);
  carry_over(p, q, to_p, to_q, &PointLanes<S>::tangent_impulse, i);
  carry_over(p, q, to_p, to_q, &PointLanes<S>::preload, i);
  store(id_p, rest.id[0] + i);
  store(id_q, rest.id[1] + i);

  const auto nx = load(m.nx + i), ny = load(m.ny + i);
  const auto along = [&](auto x, auto y) HWY_ATTR { return hn::Add(hn::Mul(x, nx), hn::Mul(y, ny)); };
  const auto lever = [&](auto x, auto y) HWY_ATTR { return hn::Sub(hn::Mul(x, ny), hn::Mul(y, nx)); };
  const auto px = load(m.x[0] + i), py = load(m.y[0] + i);
  const auto qx = hn::IfThenElse(two, load(m.x[1] + i), px), qy = hn::IfThenElse(two, load(m.y[1] + i), py);
  const auto dx = load(m.between_x + i), dy = load(m.between_y + i);
  store(nx, block.nx + i);
  store(ny, block.ny + i);
  store(along(dx, dy), block.between_along + i);
  store(lever(dx, dy), block.between_lever + i);
  store(along(px, py), p.along + i);
  store(lever(px, py), p.lever + i);
  store(along(qx, qy), q.along + i);
  store(lever(qx, qy), q.lever + i);
  store(load(m.separation[0] + i), p.separation + i);
  store(hn::IfThenElse(two, load(m.separation[1] + i), set(S(kFarSeparation))), q.separation + i);

  // Arms follow the drift up to a share of the shortest one.
  const auto square = [](auto x, auto y) HWY_ATTR { return hn::Add(hn::Mul(x, x), hn::Mul(y, y)); };
  const auto shortest = smaller(smaller(square(px, py), square(hn::Sub(px, dx), hn::Sub(py, dy))),
                                smaller(square(qx, qy), square(hn::Sub(qx, dx), hn::Sub(qy, dy))));
  store(hn::Mul(set(S(kDriftFraction * kDriftFraction)), shortest), block.drift2_max + i);

  Lanes<S> k(motions, block, i, false);
  take_point(k, p, rest.approach[0]);
  take_point(k, q, rest.approach[1]);
  const Arms<S> rp(k, p), rq(k, q);
  const auto turning =
      hn::Add(hn::Mul(hn::Mul(k.a.ii, rp.normal_a), rq.normal_a), hn::Mul(hn::Mul(k.b.ii, rp.normal_b), rq.normal_b));
  store(hn::IfThenElseZero(two, hn::Add(hn::Add(k.a.im, k.b.im), turning)), block.coupling + i);
}

template <class S>
void take(const Motion<S>* motions, const ManifoldLanes<S>& manifolds, ContactBlock<S>& block,
          ContactBlockRest<S>& rest) {
  for (std::size_t lane = 0; lane < block.count; lane += hn::Lanes(Tag<S>()))
    take_lanes(motions, manifolds, block, rest, lane);
}

// The passes of a sub-step ----------------------------------------------------------------------------------------

template <class S>
HWY_INLINE void warm_start_lanes(Lanes<S>& k) {
  const PointLanes<S>&p = k.block.points[0], &q = k.block.points[1];
  const Points<S> at(k);
  push<S>(k, at.n1, at.n2, {load(p.normal_impulse + k.lane), load(q.normal_impulse + k.lane)}, k.push_along);
  push<S>(k, at.t1, at.t2, {load(p.tangent_impulse + k.lane), load(q.tangent_impulse + k.lane)}, k.push_across);
}

// m, of a point's surfaces now, negative if they overlap.
template <class S>
HWY_INLINE Vector<S> gap_of(const Lanes<S>& k, const PointLanes<S>& p, const Arms<S>& r) {
  const auto separation = load(p.separation + k.lane), one = set(S(1));
  if (!k.moved) return separation;
  // Where the anchors are now: of sharp shapes material points, turned with their bodies; of round ones the place on
  // the outline that looks along the normal, so that it is the centre of the rounding which has turned.
  const auto a_along = hn::Sub(r.along, load(k.block.round_a + k.lane));
  const auto b_along = hn::Add(hn::Sub(r.along, k.between_along), load(k.block.round_b + k.lane));
  const auto b_lever = hn::Sub(r.lever, k.between_lever);
  const auto turned_b = hn::Add(hn::Mul(hn::Sub(k.b.c, one), b_along), hn::Mul(k.b.s, b_lever));
  const auto turned_a = hn::Add(hn::Mul(hn::Sub(k.a.c, one), a_along), hn::Mul(k.a.s, r.lever));
  return hn::Add(separation, hn::Add(k.drift_along, hn::Sub(turned_b, turned_a)));
}

// What a point asks of its relative normal velocity: v + bias = −γ λ, where γ is its compliance. While it is closed the
// spring's deflection and the preload P make the bias: rate · s − γ P. It opens where that is all that its preload can
// bridge, s = γ P / rate: the force falls to nothing on the way there and does not jump. Beyond, the gap may close in
// this sub-step, but no more.
template <class S>
struct Demand {
  Vector<S> bias, compliance;
};

template <class S, bool kUseBias>
HWY_INLINE Demand<S> demand_of(const Lanes<S>& k, const PointLanes<S>& p, const Arms<S>& r, Vector<S> inverse_mass,
                               const PassSettings<S>& settings) {
  const auto s = gap_of(k, p, r);
  const auto soft = hn::Mul(set(settings.compliance), inverse_mass);
  const auto held = hn::Mul(soft, load(p.preload + k.lane)), wanted = hn::Mul(set(settings.bias_rate), s);
  const auto open = hn::Gt(wanted, held);
  const auto closing = hn::Mul(s, set(settings.inv_h));
  if (!kUseBias) return {hn::IfThenElseZero(open, closing), soft};
  const auto pushing = hn::Sub(larger(wanted, set(S(-kPushSpeedMax))), held);
  return {hn::IfThenElse(open, closing, pushing), hn::IfThenZeroElse(open, soft)};
}

// Both points of a manifold at once, so that neither side is favoured: the linear complementarity problem
//   w = K λ − q ≥ 0,  λ ≥ 0,  w·λ = 0
// by trying which points push (Catto, "Block solver", Box2D 2).
template <class S, class V = Vector<S>>
HWY_INLINE TwoImpulses<V> solve_two(V k11, V k12, V k22, V q1, V q2) {
  const auto zero = hn::Zero(Tag<S>());
  const auto k11_k22 = hn::Mul(k11, k22);
  const auto determinant = hn::Sub(k11_k22, hn::Mul(k12, k12));
  const auto one_by = [](V v) HWY_ATTR { return hn::Div(set(S(1)), v); };
  const auto one_by_determinant = one_by(determinant);
  const auto d1 = hn::Sub(hn::Mul(k22, q1), hn::Mul(k12, q2)), d2 = hn::Sub(hn::Mul(k11, q2), hn::Mul(k12, q1));
  const auto regular = hn::Gt(determinant, hn::Mul(set(S(kDeterminantMin)), k11_k22));
  const auto both = hn::And(regular, hn::And(hn::Ge(d1, zero), hn::Ge(d2, zero)));
  const auto first = hn::And(hn::Ge(q1, zero), hn::Ge(hn::Mul(k12, q1), hn::Mul(k11, q2)));
  const auto second = hn::And(hn::Ge(q2, zero), hn::Ge(hn::Mul(k12, q2), hn::Mul(k22, q1)));
  const auto only_second = hn::AndNot(hn::Or(both, first), second);
  const auto alone_1 = hn::IfThenElseZero(first, hn::Mul(one_by(k11), q1));
  const auto alone_2 = hn::IfThenElseZero(only_second, hn::Mul(one_by(k22), q2));
  return {hn::IfThenElse(both, hn::Mul(one_by_determinant, d1), alone_1),
          hn::IfThenElse(both, hn::Mul(one_by_determinant, d2), alone_2)};
}

template <class S>
struct NormalPoints {
  const PointLanes<S>&p1, &p2;
  TwoImpulses<Vector<S>> before;
  Vector<S> m1, m2, coupling;

  HWY_INLINE explicit NormalPoints(const Lanes<S>& k)
      : p1(k.block.points[0]),
        p2(k.block.points[1]),
        before{load(p1.normal_impulse + k.lane), load(p2.normal_impulse + k.lane)},
        m1(load(p1.inverse_mass + k.lane)),
        m2(load(p2.inverse_mass + k.lane)),
        coupling(load(k.block.coupling + k.lane)) {}
  // K λ₀ − v.
  HWY_INLINE Vector<S> wanted_1(Vector<S> v) const {
    return hn::Sub(hn::Add(hn::Mul(m1, before.first), hn::Mul(coupling, before.second)), v);
  }
  HWY_INLINE Vector<S> wanted_2(Vector<S> v) const {
    return hn::Sub(hn::Add(hn::Mul(coupling, before.first), hn::Mul(m2, before.second)), v);
  }
};

// λ of both points: (K + γ) λ = K λ₀ − v − bias where they push.
template <class S, bool kUseBias>
HWY_INLINE TwoImpulses<Vector<S>> solve_normals(const Lanes<S>& k, const Arms<S>& r1, const Arms<S>& r2,
                                                const NormalPoints<S>& n, const PassSettings<S>& settings) {
  const Demand<S> d1 = demand_of<S, kUseBias>(k, n.p1, r1, n.m1, settings);
  const Demand<S> d2 = demand_of<S, kUseBias>(k, n.p2, r2, n.m2, settings);
  const auto q1 = hn::Sub(n.wanted_1(normal_speed(k, r1)), d1.bias);
  const auto q2 = hn::Sub(n.wanted_2(normal_speed(k, r2)), d2.bias);
  auto k11 = n.m1, k22 = n.m2;
  if (kUseBias) {
    k11 = hn::Add(k11, d1.compliance);
    k22 = hn::Add(k22, d2.compliance);
  }
  return solve_two<S>(k11, n.coupling, k22, q1, q2);
}

// N·s of impulses, 1/kg of inverse masses: what is below this is none.
constexpr double kNearZero = 1e-30;

// λ where surfaces slide at `speed` over each other, within ±bound.
template <class S>
HWY_INLINE Vector<S> solve_friction(Vector<S> before, Vector<S> mass, Vector<S> speed, Vector<S> bound) {
  return larger(smaller(hn::Sub(before, hn::Mul(mass, speed)), bound), hn::Neg(bound));
}

// Normal impulses, then friction. Both points slide along one line, so it is one equation, at the middle of the
// two bounds, and they share what it gives as they share the bound: neither comes first, and a mirror image
// gets the same bits. Friction sees what the normal impulses have done through how the directions are coupled and not
// through the bodies: that much shorter is the chain of operations that have to wait for each other, and that chain,
// not their number, is what a pass costs.
template <class S, bool kUseBias, class Bound>
HWY_INLINE PointImpulses<S> solve_points(Lanes<S>& k, const Points<S>& at, const PassSettings<S>& settings,
                                         const Bound& bound) {
  PointLanes<S>&p1 = k.block.points[0], &p2 = k.block.points[1];
  const NormalPoints<S> n(k);
  const auto next = solve_normals<S, kUseBias>(k, at.r1, at.r2, n, settings);
  TwoImpulses<Vector<S>> tangent{load(p1.tangent_impulse + k.lane), load(p2.tangent_impulse + k.lane)};
  const TwoImpulses<Vector<S>> d{hn::Sub(next.first, n.before.first), hn::Sub(next.second, n.before.second)};
  store(next.first, p1.normal_impulse + k.lane);
  store(next.second, p2.normal_impulse + k.lane);
  if (settings.friction) {
    const auto friction = load(k.block.friction + k.lane);
    const auto bound_1 = hn::Mul(friction, bound(p1, n.before.first, next.first));
    const auto bound_2 = hn::Mul(friction, bound(p2, n.before.second, next.second));
    const auto bounds = hn::Add(bound_1, bound_2);
    const auto inverse = hn::Div(set(S(1)), larger(bounds, set(S(kNearZero))));
    const auto share_1 = hn::Mul(bound_1, inverse), share_2 = hn::Mul(bound_2, inverse);
    const auto mean = [&](auto first, auto second)
                          HWY_ATTR { return hn::Add(hn::Mul(share_1, first), hn::Mul(share_2, second)); };
    const Direction<S> t(k, mean(at.t1.arm_a, at.t2.arm_a), mean(at.t1.arm_b, at.t2.arm_b));
    const auto by_normals = hn::Add(hn::Mul(coupling(at.n1, t), d.first), hn::Mul(coupling(at.n2, t), d.second));
    const auto speed = hn::Add(sliding_speed(k, t), by_normals);
    const auto mass = mean(load(p1.tangent_mass + k.lane), load(p2.tangent_mass + k.lane));
    const auto before = tangent;
    const auto both = solve_friction<S>(hn::Add(before.first, before.second), mass, speed, bounds);
    tangent = {hn::Mul(share_1, both), hn::Mul(share_2, both)};
    store(tangent.first, p1.tangent_impulse + k.lane);
    store(tangent.second, p2.tangent_impulse + k.lane);
    push<S>(k, at.t1, at.t2, {hn::Sub(tangent.first, before.first), hn::Sub(tangent.second, before.second)},
            k.push_across);
  }
  push<S>(k, at.n1, at.n2, d, k.push_along);
  return {next, tangent};
}

// The normal impulse of the step so far.
template <class S>
HWY_INLINE Vector<S> add_to_totals(const Lanes<S>& k, PointLanes<S>& p, Vector<S> normal, Vector<S> tangent) {
  const auto total = hn::Add(load(p.total_normal_impulse + k.lane), normal);
  store(total, p.total_normal_impulse + k.lane);
  store(hn::Add(load(p.total_tangent_impulse + k.lane), tangent), p.total_tangent_impulse + k.lane);
  return total;
}

// What share of its faster rate a preload takes, by where its contact is. A light body that carries a heavy one sinks
// far before the slow rate has taken that back, and so it does into the ground. Between bodies of a kind the slow rate
// stays: in a pyramid loads have many ways down, and preloads that chase them drive its rows apart.
template <class S>
HWY_INLINE Vector<S> eagerness(const Lanes<S>& k, const PointLanes<S>& p, const Arms<S>& r) {
  const auto zero = hn::Zero(Tag<S>());
  const auto share_of = [&](auto x) HWY_ATTR { return larger(zero, smaller(set(S(1)), x)); };
  const auto of_lighter = larger(k.a.im, k.b.im), of_heavier = smaller(k.a.im, k.b.im);
  const auto even = hn::Mul(set(S(kUnevenMasses)), of_heavier), depth = set(S(kSunkDepth));
  const auto uneven = share_of(hn::Div(hn::Sub(of_lighter, even), larger(even, set(S(kNearZero)))));
  const auto sunk = share_of(hn::Div(hn::Sub(hn::Neg(gap_of(k, p, r)), depth), depth));
  return hn::IfThenElse(hn::Gt(of_heavier, zero), uneven, sunk);
}

// Whether any of the lanes can be eager at all: between bodies of a kind, which is what most are, there is no more to
// do.
template <class S>
HWY_INLINE bool any_eager(const Lanes<S>& k) {
  const auto even = hn::Mul(set(S(kUnevenMasses)), smaller(k.a.im, k.b.im));
  return !hn::AllFalse(Tag<S>(), hn::Gt(larger(k.a.im, k.b.im), even));
}

// 1 where the impulse stays as it is, 0 where it changes. A preload must not race the solver: while a load is still on
// its way down by iterations, or swings, what a point carries now is not what rests on it.
template <class S>
HWY_INLINE Vector<S> steadiness(Vector<S> mean, Vector<S> last) {
  const auto still = larger(hn::Mul(set(S(kSteadyChange)), mean), set(S(kNearZero)));
  const auto change = hn::Div(hn::Sub(last, mean), still);
  return hn::Div(set(S(1)), hn::Add(set(S(1)), hn::Mul(change, change)));
}

// At the end of a step preloads follow its mean impulse, and that of both points where there are two: where a body
// rests on more points than it needs, nothing tells how they share its weight, and preloads that follow each share
// wander off.
template <class S>
HWY_INLINE void follow_loads(const Lanes<S>& k, const Points<S>& at, const TwoImpulses<Vector<S>>& totals,
                             const TwoImpulses<Vector<S>>& last, const PassSettings<S>& settings) {
  PointLanes<S>&p = k.block.points[0], &q = k.block.points[1];
  const auto two = hn::Lt(load(q.separation + k.lane), set(S(kFarSeparation)));
  const auto half = hn::Mul(set(S(0.5)), hn::Add(totals.first, totals.second));
  const auto half_of_last = hn::Mul(set(S(0.5)), hn::Add(last.first, last.second));
  const bool eager = any_eager(k);
  const auto follow = [&](PointLanes<S>& point, const Arms<S>& r, auto total, auto now) HWY_ATTR {
    const auto mean = hn::Mul(set(settings.sub_step_share), hn::IfThenElse(two, half, total));
    auto rate = set(settings.preload_rate);
    if (eager) {
      const auto steady = steadiness<S>(mean, hn::IfThenElse(two, half_of_last, now));
      rate = hn::Add(rate, hn::Mul(set(settings.preload_rate_more), hn::Mul(eagerness(k, point, r), steady)));
    }
    const auto preload = load(point.preload + k.lane);
    store(hn::Add(preload, hn::Mul(rate, hn::Sub(mean, preload))), point.preload + k.lane);
  };
  follow(p, at.r1, totals.first, last.first);
  follow(q, at.r2, totals.second, last.second);
}

// The speed at which restitution lets a point leave that closes in at `now` (m/s < 0) after forces have acted, and did
// so at `before` before: e times that at which it will strike, if that is fast enough; 0 if not. Semi-implicit Euler
// moves bodies on parabolas whose speed at the start of a sub-step is v + a h / 2, so this is what has to bounce, after
// the rest of the gap has been fallen through: u² = (v + a h / 2)² − 2 a s. Then a ball of e = 1 keeps its height.
template <class S>
HWY_INLINE Vector<S> leaving_speed(Vector<S> before, Vector<S> now, Vector<S> gap, Vector<S> restitution,
                                   const PassSettings<S>& settings) {
  const auto zero = hn::Zero(Tag<S>());
  const auto gain = hn::Sub(now, before), half = hn::Mul(set(S(0.5)), gain), flying = hn::Sub(now, half);
  const auto fallen = smaller(hn::Mul(larger(gap, zero), set(settings.inv_h)), hn::Neg(now));
  const auto square = hn::Sub(hn::Mul(flying, flying), hn::Mul(hn::Add(gain, gain), fallen));
  const auto leaves = hn::Sub(hn::Mul(restitution, hn::Sqrt(larger(square, zero))), half);
  const auto bounces = hn::And(hn::Le(now, set(-settings.threshold)), hn::Gt(restitution, zero));
  return hn::IfThenElseZero(bounces, larger(leaves, zero));
}

// Before forces act and after: how fast the points close in, then how fast they shall leave if they meet.
template <class S, bool kForcesActed>
void note_approach(const Motion<S>* motions, ContactBlock<S>* blocks, ContactBlockRest<S>* rest, std::size_t count,
                   const PassSettings<S>& settings) {
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t lane = 0; lane < blocks[i].count; lane += width) {
      const auto restitution = load(rest[i].restitution + lane);
      if (hn::AllFalse(Tag<S>(), hn::Gt(restitution, hn::Zero(Tag<S>())))) continue;
      const Lanes<S> k(motions, blocks[i], lane, true);
      for (int point = 0; point < 2; ++point) {
        const PointLanes<S>& p = blocks[i].points[point];
        const Arms<S> r(k, p);
        const auto now = normal_speed(k, r);
        S* bounce = rest[i].bounce[point] + lane;
        store(kForcesActed ? leaving_speed<S>(load(bounce), now, gap_of(k, p, r), restitution, settings) : now, bounce);
      }
    }
  }
}

// Newton's restitution for a contact that was hit in this sub-step: each point that was to bounce and pushed leaves at
// its speed; the others must only not close in. The blow is over: nothing of it is a start for the next sub-step.
template <class S>
HWY_INLINE void restitute_lanes(Lanes<S>& k, const ContactBlockRest<S>& rest, Kick<S>* kicks) {
  const auto zero = hn::Zero(Tag<S>());
  PointLanes<S>&p1 = k.block.points[0], &p2 = k.block.points[1];
  const Points<S> at(k);
  const NormalPoints<S> n(k);
  const auto u1 = hn::IfThenElseZero(hn::Gt(n.before.first, zero), load(rest.bounce[0] + k.lane));
  const auto u2 = hn::IfThenElseZero(hn::Gt(n.before.second, zero), load(rest.bounce[1] + k.lane));
  const auto bounces = hn::Or(hn::Gt(u1, zero), hn::Gt(u2, zero));
  // A point that is not there keeps far below what would make it push.
  const auto there = hn::Lt(load(p2.separation + k.lane), set(S(kFarSeparation)));
  const auto q1 = hn::Add(n.wanted_1(normal_speed(k, at.r1)), u1);
  const auto q2 = hn::IfThenElse(there, hn::Add(n.wanted_2(normal_speed(k, at.r2)), u2), set(S(-kFarSeparation)));
  const auto next = solve_two<S>(n.m1, n.coupling, n.m2, q1, q2);
  const auto bounce = [&](PointLanes<S>& p, auto after, auto before) HWY_ATTR {
    const auto impulse = hn::IfThenElseZero(bounces, hn::Sub(after, before));
    store(hn::Add(load(p.total_normal_impulse + k.lane), impulse), p.total_normal_impulse + k.lane);
    store(hn::IfThenElse(bounces, zero, before), p.normal_impulse + k.lane);
    store(hn::IfThenZeroElse(bounces, load(p.tangent_impulse + k.lane)), p.tangent_impulse + k.lane);
    return impulse;
  };
  const auto taken_back = [&](auto impulse) HWY_ATTR { return hn::IfThenElseZero(bounces, hn::Neg(impulse)); };
  const PointImpulses<S> less{
      {taken_back(n.before.first), taken_back(n.before.second)},
      {taken_back(load(p1.tangent_impulse + k.lane)), taken_back(load(p2.tangent_impulse + k.lane))}};
  const auto first = bounce(p1, next.first, n.before.first), second = bounce(p2, next.second, n.before.second);
  push<S>(k, at.n1, at.n2, {first, second}, k.push_along);
  if (kicks != nullptr) kick(k, at, less, kicks);
}

// Calls work(lanes) for each vector of each block, in order, and writes velocities back.
template <class S, bool kMoved, class Work>
HWY_INLINE void for_each_vector(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const Work& work) {
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t lane = 0; lane < blocks[i].count; lane += width) {
      Lanes<S> k(motions, blocks[i], lane, kMoved);
      work(k);
      k.store_to(motions);
    }
  }
}

template <class S>
void warm_start(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const PassSettings<S>&) {
  for_each_vector<S, false>(motions, blocks, count, [](Lanes<S>& k) HWY_ATTR { warm_start_lanes(k); });
}

// What a point's friction may be bounded by before bodies move: its normal impulse, but for a shock. Friction turns a
// body, and after a blow it would turn its corner into a thin wall faster than the wall is thick; it rubs when the
// bodies have moved.
template <class S>
HWY_INLINE Vector<S> without_shock(const Lanes<S>& k, const PointLanes<S>& p, Vector<S> before, Vector<S> now) {
  return smaller(now, hn::Add(before, hn::Mul(set(S(kShockSpeed)), load(p.tangent_mass + k.lane))));
}

// Friction comes last in both passes: the bodies move by the velocities that the first one leaves, and what slides
// between the bound of the sub-step before and this one's is never taken back.
template <class S, bool kMoved>
void solve(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const PassSettings<S>& settings) {
  for_each_vector<S, kMoved>(motions, blocks, count, [&settings](Lanes<S>& k) HWY_ATTR {
    solve_points<S, true>(k, Points<S>(k), settings,
                          [&k](const PointLanes<S>& p, Vector<S> before, Vector<S> now)
                              HWY_ATTR { return without_shock(k, p, before, now); });
  });
}

// In the relaxation friction is bounded by the impulse without the spring's share: a bound from the spring would make a
// slope a little too slippery.
template <class S, bool kLast>
void relax(Motion<S>* motions, ContactBlock<S>* blocks, std::size_t count, const PassSettings<S>& settings) {
  for_each_vector<S, true>(motions, blocks, count, [&settings](Lanes<S>& k) HWY_ATTR {
    const Points<S> at(k);
    const auto now = solve_points<S, false>(
        k, at, settings, [](const PointLanes<S>&, Vector<S>, Vector<S> normal) HWY_ATTR { return normal; });
    PointLanes<S>&p1 = k.block.points[0], &p2 = k.block.points[1];
    const TwoImpulses<Vector<S>> totals{add_to_totals(k, p1, now.normal.first, now.tangent.first),
                                        add_to_totals(k, p2, now.normal.second, now.tangent.second)};
    if (kLast) {
      follow_loads(k, at, totals, now.normal, settings);
    } else {
      kick(k, at, now, settings.kicks);
    }
  });
}

template <class S>
void restitute(Motion<S>* motions, ContactBlock<S>* blocks, const ContactBlockRest<S>* rest, std::size_t count,
               Kick<S>* kicks) {
  const std::size_t width = hn::Lanes(Tag<S>());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t lane = 0; lane < blocks[i].count; lane += width) {
      const auto fastest = larger(load(rest[i].bounce[0] + lane), load(rest[i].bounce[1] + lane));
      if (hn::AllFalse(Tag<S>(), hn::Gt(fastest, hn::Zero(Tag<S>())))) continue;
      Lanes<S> k(motions, blocks[i], lane, true);
      restitute_lanes(k, rest[i], kicks);
      k.store_to(motions);
    }
  }
}

template <class S>
std::uint32_t meeting(const ContactBlock<S>& block, const ContactBlockRest<S>& rest) {
  const auto zero = hn::Zero(Tag<S>());
  std::uint32_t meeting = 0;
  for (std::size_t lane = 0; lane < block.count; lane += hn::Lanes(Tag<S>())) {
    auto meets = hn::Eq(load(rest.id[0] + lane), set(S(kIdlePoint)));
    for (const PointLanes<S>& p : block.points)
      meets = hn::Or(
          meets, hn::Or(hn::Le(load(p.separation + lane), zero), hn::Gt(load(p.total_normal_impulse + lane), zero)));
    meeting |= bits_of<S>(meets) << lane;
  }
  return meeting & ((1u << block.count) - 1);
}

template <class S>
constexpr ContactPasses<S> kPasses{take<S>,         warm_start<S>,  solve<S, false>,         solve<S, true>,
                                   relax<S, false>, relax<S, true>, note_approach<S, false>, note_approach<S, true>,
                                   restitute<S>,    meeting<S>};

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

// AVX2 is the widest of the targets whose vectors take half a block.
#if !defined(HWY_COMPILE_ONLY_STATIC) && (HWY_TARGETS & HWY_AVX2) != 0
namespace {
// Kept, for to ask is to ask the processor, which a virtual machine answers slowly.
std::atomic<bool>& has_half() {
  static std::atomic<bool> known{(hwy::SupportedTargets() & HWY_AVX2) != 0};
  return known;
}
// Better targets have lower numbers.
void learn_half(std::int64_t id) {
  hwy::SetSupportedTargetsForTest(0);
  has_half() = (hwy::SupportedTargets() & HWY_AVX2) != 0 && id <= HWY_AVX2;
}
}  // namespace
template <>
const ContactPasses<float>& half_passes<float>() {
  return has_half() ? *N_AVX2::float_passes() : contact_passes<float>();
}
template <>
const ContactPasses<double>& half_passes<double>() {
  return has_half() ? *N_AVX2::double_passes() : contact_passes<double>();
}
#else
namespace {
void learn_half(std::int64_t) {}
}  // namespace
template <>
const ContactPasses<float>& half_passes<float>() {
  return contact_passes<float>();
}
template <>
const ContactPasses<double>& half_passes<double>() {
  return contact_passes<double>();
}
#endif

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
  learn_half(id);
  hwy::SetSupportedTargetsForTest(id);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
#endif

}  // namespace urto
#endif

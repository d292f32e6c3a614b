// Highway compiles this file once for each instruction set. Our own headers come first: what is first seen from within
// a system header is left out of the dependencies that the compiler writes.
#include "physics/solver/joint_kernels.h"

#include "physics/constants.h"
#include "physics/simd/targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/solver/joint_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "physics/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {
namespace {

// vx, vy, ω; dx is carried along, because four fields are loaded and stored at once.
template <class S>
struct Velocity {
  Vector<S> x, y, w, dx;

  HWY_INLINE Velocity(const Motion<S>* motions, const std::uint32_t* slots) {
    const auto row = load_rows<S>([&](std::size_t i) { return &motions[slots[i]].vx; });
    x = row.c0;
    y = row.c1;
    w = row.c2;
    dx = row.c3;
  }
  // Bodies that cannot move are left alone: other lanes may hold them too.
  HWY_INLINE void store_to(Motion<S>* motions, const std::uint32_t* slots, const std::uint8_t* movable) const {
    Motion<S> nowhere;
    store_rows<S>({x, y, w, dx}, [&](std::size_t i) { return movable[i] ? &motions[slots[i]].vx : &nowhere.vx; });
  }
};

// A few lanes of a block, with the velocities of their bodies.
template <class S>
struct Lanes {
  PointBlock<S>& block;
  std::size_t lane;
  Velocity<S> a, b;

  HWY_INLINE Lanes(const Motion<S>* motions, PointBlock<S>& from, std::size_t first)
      : block(from), lane(first), a(motions, from.a + first), b(motions, from.b + first) {}
  HWY_INLINE void store_to(Motion<S>* motions) const {
    a.store_to(motions, block.a + lane, block.movable_a + lane);
    b.store_to(motions, block.b + lane, block.movable_b + lane);
  }
  HWY_INLINE Vector<S> field(const S (&lanes)[kLanes<S>]) const { return load(lanes + lane); }
};

// The arms of both bodies, to one point in the gap.
template <class S>
struct Arms {
  Vector<S> ax, ay, bx, by;
  HWY_INLINE explicit Arms(const Lanes<S>& k)
      : ax(k.field(k.block.arm_ax)),
        ay(k.field(k.block.arm_ay)),
        bx(k.field(k.block.arm_bx)),
        by(k.field(k.block.arm_by)) {}
};

template <class S>
HWY_INLINE void apply(Lanes<S>& k, const Arms<S>& r, Vector<S> px, Vector<S> py) {
  const auto im_a = k.field(k.block.inv_mass_a), ii_a = k.field(k.block.inv_inertia_a);
  const auto im_b = k.field(k.block.inv_mass_b), ii_b = k.field(k.block.inv_inertia_b);
  k.a.x = hn::Sub(k.a.x, hn::Mul(im_a, px));
  k.a.y = hn::Sub(k.a.y, hn::Mul(im_a, py));
  k.a.w = hn::Sub(k.a.w, hn::Mul(ii_a, hn::Sub(hn::Mul(r.ax, py), hn::Mul(r.ay, px))));
  k.b.x = hn::Add(k.b.x, hn::Mul(im_b, px));
  k.b.y = hn::Add(k.b.y, hn::Mul(im_b, py));
  k.b.w = hn::Add(k.b.w, hn::Mul(ii_b, hn::Sub(hn::Mul(r.bx, py), hn::Mul(r.by, px))));
}

template <class S>
struct Masses {
  Vector<S> m11, m12, m22;
};

// The inverse of K = Σ (1/m + [r]ᵀ[r]/I), the effective mass at the point.
template <class S>
HWY_INLINE Masses<S> masses_of(const Lanes<S>& k, const Arms<S>& r) {
  const auto im_a = k.field(k.block.inv_mass_a), ii_a = k.field(k.block.inv_inertia_a);
  const auto im_b = k.field(k.block.inv_mass_b), ii_b = k.field(k.block.inv_inertia_b);
  const auto masses = hn::Add(im_a, im_b);
  const auto ay = hn::Mul(ii_a, r.ay), by = hn::Mul(ii_b, r.by);
  const auto k11 = hn::Add(masses, hn::Add(hn::Mul(ay, r.ay), hn::Mul(by, r.by)));
  const auto k12 = hn::Add(hn::Mul(ay, r.ax), hn::Mul(by, r.bx));  // with the sign turned round
  const auto k22 = hn::Add(masses, hn::Add(hn::Mul(hn::Mul(ii_a, r.ax), r.ax), hn::Mul(hn::Mul(ii_b, r.bx), r.bx)));
  const auto inverse = hn::Div(hn::Set(Tag<S>(), S(1)), hn::Sub(hn::Mul(k11, k22), hn::Mul(k12, k12)));
  return {hn::Mul(k22, inverse), hn::Mul(k12, inverse), hn::Mul(k11, inverse)};
}

// Arms, gap and masses where the bodies are now.
template <class S>
HWY_INLINE void refresh(const Motion<S>* motions, Lanes<S>& k) {
  PointBlock<S>& block = k.block;
  // dy, da, c, s
  const auto a = load_rows<S>([&](std::size_t i) { return &motions[block.a[k.lane + i]].dy; });
  const auto b = load_rows<S>([&](std::size_t i) { return &motions[block.b[k.lane + i]].dy; });
  const auto ax0 = k.field(block.ax), ay0 = k.field(block.ay), bx0 = k.field(block.bx), by0 = k.field(block.by);
  const auto ax = hn::Sub(hn::Mul(a.c2, ax0), hn::Mul(a.c3, ay0)), ay = hn::Add(hn::Mul(a.c3, ax0), hn::Mul(a.c2, ay0));
  const auto bx = hn::Sub(hn::Mul(b.c2, bx0), hn::Mul(b.c3, by0)), by = hn::Add(hn::Mul(b.c3, bx0), hn::Mul(b.c2, by0));
  const auto gap_x =
      hn::Add(hn::Add(k.field(block.start_x), hn::Sub(k.b.dx, k.a.dx)), hn::Sub(hn::Sub(bx, bx0), hn::Sub(ax, ax0)));
  const auto gap_y =
      hn::Add(hn::Add(k.field(block.start_y), hn::Sub(b.c0, a.c0)), hn::Sub(hn::Sub(by, by0), hn::Sub(ay, ay0)));
  // Both halves of an impulse act at one point in the gap, so that angular momentum is kept: nearest to the anchor of
  // the lighter body, whose arm matters most.
  const auto im_a = k.field(block.inv_mass_a), im_b = k.field(block.inv_mass_b);
  const auto share_a = hn::Div(im_b, hn::Add(im_a, im_b));
  const auto to_a_x = hn::Mul(share_a, gap_x), to_a_y = hn::Mul(share_a, gap_y);
  store(gap_x, block.gap_x + k.lane);
  store(gap_y, block.gap_y + k.lane);
  store(hn::Add(ax, to_a_x), block.arm_ax + k.lane);
  store(hn::Add(ay, to_a_y), block.arm_ay + k.lane);
  store(hn::Sub(bx, hn::Sub(gap_x, to_a_x)), block.arm_bx + k.lane);
  store(hn::Sub(by, hn::Sub(gap_y, to_a_y)), block.arm_by + k.lane);
  const Masses<S> m = masses_of(k, Arms<S>(k));
  store(m.m11, block.m11 + k.lane);
  store(m.m12, block.m12 + k.lane);
  store(m.m22, block.m22 + k.lane);
}

// How much of the speed that a gap asks for it gets.
template <class S>
HWY_INLINE Vector<S> pulled_share(Vector<S> x, Vector<S> y) {
  const auto most = hn::Set(Tag<S>(), S(kJointPullSpeedMax)), one = hn::Set(Tag<S>(), S(1));
  const auto speed2 = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
  return hn::IfThenElse(hn::Gt(speed2, hn::Mul(most, most)), hn::Div(most, hn::Sqrt(speed2)), one);
}

template <class S, bool kUseBias>
HWY_INLINE void hold(Lanes<S>& k, const JointSettings<S>& settings) {
  PointBlock<S>& block = k.block;
  const Arms<S> r(k);
  auto vx = hn::Sub(hn::Sub(k.b.x, hn::Mul(k.b.w, r.by)), hn::Sub(k.a.x, hn::Mul(k.a.w, r.ay)));
  auto vy = hn::Sub(hn::Add(k.b.y, hn::Mul(k.b.w, r.bx)), hn::Add(k.a.y, hn::Mul(k.a.w, r.ax)));
  if (kUseBias) {
    const auto lose = hn::Set(Tag<S>(), S(1) - settings.stiff.keep), pull = hn::Set(Tag<S>(), settings.stiff.pull);
    const auto pull_x = hn::Mul(pull, k.field(block.gap_x)), pull_y = hn::Mul(pull, k.field(block.gap_y));
    const auto share = pulled_share<S>(pull_x, pull_y);
    vx = hn::Add(hn::Mul(lose, vx), hn::Mul(share, pull_x));
    vy = hn::Add(hn::Mul(lose, vy), hn::Mul(share, pull_y));
  }
  const auto zero = hn::Zero(Tag<S>()), m12 = k.field(block.m12);
  auto px = hn::Sub(zero, hn::Add(hn::Mul(k.field(block.m11), vx), hn::Mul(m12, vy)));
  auto py = hn::Sub(zero, hn::Add(hn::Mul(m12, vx), hn::Mul(k.field(block.m22), vy)));
  if (kUseBias) {
    const auto keep = hn::Set(Tag<S>(), settings.stiff.keep);
    px = hn::Sub(px, hn::Mul(keep, k.field(block.impulse_x)));
    py = hn::Sub(py, hn::Mul(keep, k.field(block.impulse_y)));
  }
  const auto ix = hn::Add(k.field(block.impulse_x), px), iy = hn::Add(k.field(block.impulse_y), py);
  store(ix, block.impulse_x + k.lane);
  store(iy, block.impulse_y + k.lane);
  if (!kUseBias) {
    store(hn::Add(k.field(block.total_x), ix), block.total_x + k.lane);
    store(hn::Add(k.field(block.total_y), iy), block.total_y + k.lane);
  }
  apply(k, r, px, py);
}

// Calls work(lanes) for each vector of each block, in order; writes velocities back if kMoves.
template <class S, bool kMoves, class Work>
HWY_INLINE void for_each_vector(Motion<S>* motions, PointBlock<S>* blocks, std::size_t count, const Work& work) {
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
void prepare(Motion<S>* motions, PointBlock<S>* blocks, std::size_t count, const JointSettings<S>&) {
  for_each_vector<S, false>(motions, blocks, count, [motions](Lanes<S>& k) HWY_ATTR { refresh(motions, k); });
}

template <class S>
void warm_start(Motion<S>* motions, PointBlock<S>* blocks, std::size_t count, const JointSettings<S>&) {
  for_each_vector<S, true>(motions, blocks, count, [](Lanes<S>& k) HWY_ATTR {
    apply(k, Arms<S>(k), k.field(k.block.impulse_x), k.field(k.block.impulse_y));
  });
}

template <class S>
void solve(Motion<S>* motions, PointBlock<S>* blocks, std::size_t count, const JointSettings<S>& settings) {
  for_each_vector<S, true>(motions, blocks, count, [&settings](Lanes<S>& k) HWY_ATTR { hold<S, true>(k, settings); });
}

template <class S>
void relax(Motion<S>* motions, PointBlock<S>* blocks, std::size_t count, const JointSettings<S>& settings) {
  for_each_vector<S, true>(motions, blocks, count, [motions, &settings](Lanes<S>& k) HWY_ATTR {
    refresh(motions, k);
    hold<S, false>(k, settings);
  });
}

template <class S>
constexpr PointPasses<S> kPasses{prepare<S>, warm_start<S>, solve<S>, relax<S>};

}  // namespace

const PointPasses<float>* float_point_passes() { return &kPasses<float>; }
const PointPasses<double>* double_point_passes() { return &kPasses<double>; }

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace urto {

HWY_EXPORT(float_point_passes);
HWY_EXPORT(double_point_passes);

template <>
const PointPasses<float>& point_passes<float>() {
  return *HWY_DYNAMIC_DISPATCH(float_point_passes)();
}
template <>
const PointPasses<double>& point_passes<double>() {
  return *HWY_DYNAMIC_DISPATCH(double_point_passes)();
}

}  // namespace urto
#endif

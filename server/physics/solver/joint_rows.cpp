#include "physics/solver/joint_rows.h"

#include "physics/constants.h"

namespace urto {
namespace {

// A row of the constraint matrix: it measures u·(v_b − v_a) + rb ω_b − ra ω_a.
template <class S>
struct Row {
  S ux, uy, ra, rb;
};

// The two bodies of a joint while it is being solved. What does not move has no mass.
template <class S>
struct Pair {
  JointRows<S>& j;
  Motion<S> a, b;
  Vec<S> arm_a, arm_b;  // m, to the anchors, as they are now
  Vec<S> gap;           // m, from a's anchor to b's

  Pair(const WorldData<S>& world, JointRows<S>& rows) : j(rows) {
    if (j.a != kNone) a = world.motions[j.a];
    b = world.motions[j.b];
    arm_a = Rotation<S>{a.c, a.s}.apply(Vec<S>(j.ax, j.ay));
    arm_b = Rotation<S>{b.c, b.s}.apply(Vec<S>(j.bx, j.by));
    gap = Vec<S>(j.center_x + (b.dx - a.dx) + (arm_b.x() - arm_a.x()),
                 j.center_y + (b.dy - a.dy) + (arm_b.y() - arm_a.y()));
  }
  void store_to(WorldData<S>& world) const {
    if (j.inv_mass_a > S(0) || j.inv_inertia_a > S(0)) store(a, world.motions[j.a]);
    if (j.inv_mass_b > S(0) || j.inv_inertia_b > S(0)) store(b, world.motions[j.b]);
  }
  static void store(const Motion<S>& from, Motion<S>& to) {
    to.vx = from.vx;
    to.vy = from.vy;
    to.w = from.w;
  }

  S angle() const { return j.angle + (b.da - a.da); }

  S rate(const Row<S>& r) const { return r.ux * (b.vx - a.vx) + r.uy * (b.vy - a.vy) + (r.rb * b.w - r.ra * a.w); }
  // Of two rows: how an impulse along one changes the rate of the other.
  S coupling(const Row<S>& r, const Row<S>& q) const {
    return (j.inv_mass_a + j.inv_mass_b) * (r.ux * q.ux + r.uy * q.uy) + j.inv_inertia_a * r.ra * q.ra +
           j.inv_inertia_b * r.rb * q.rb;
  }
  S inverse_mass(const Row<S>& r) const { return coupling(r, r); }
  void push(const Row<S>& r, S impulse) {
    const S px = impulse * r.ux, py = impulse * r.uy;
    a.vx -= j.inv_mass_a * px;
    a.vy -= j.inv_mass_a * py;
    a.w -= j.inv_inertia_a * (impulse * r.ra);
    b.vx += j.inv_mass_b * px;
    b.vy += j.inv_mass_b * py;
    b.w += j.inv_inertia_b * (impulse * r.rb);
  }
};

// The share of a gap that is pulled shut: all of it, unless that would be too fast.
template <class S>
S pulled_share(S gap, const SpringStep<S>& s) {
  const S speed = s.pull * absolute(gap), most = S(kJointPullSpeedMax);
  return speed > most ? most / speed : S(1);
}
template <class S>
Vec<S> pulled_gap(const Vec<S>& gap, const SpringStep<S>& s) {
  return gap * pulled_share(length<S>(gap), s);
}

template <class S>
constexpr Row<S> kTurning{S(0), S(0), S(1), S(1)};

// Both halves of an impulse act at one point in the gap, so that angular momentum is kept: nearest to the anchor of
// the lighter body, whose arm matters most.
template <class S>
Row<S> row_in_gap(const Pair<S>& p, S ux, S uy) {
  const S share = p.j.inv_mass_b / (p.j.inv_mass_a + p.j.inv_mass_b);
  const Vec<S> u(ux, uy), to_a = p.gap * share, to_b = p.gap * (S(1) - share);
  return {ux, uy, cross<S>(Vec<S>(p.arm_a + to_a), u), cross<S>(Vec<S>(p.arm_b - to_b), u)};
}

// The row along which the joint's position is measured, and that position.
template <class S>
struct Along {
  Row<S> row;
  S position;
};

template <class S>
Vec<S> prismatic_axis(const Pair<S>& p) {
  return Rotation<S>{p.a.c, p.a.s}.apply(Vec<S>(p.j.ux, p.j.uy));
}

// A force across or along the axis acts at b's anchor on both bodies; that point turns with a.
template <class S>
Row<S> row_at_b(const Pair<S>& p, const Vec<S>& u) {
  return {u.x(), u.y(), cross<S>(Vec<S>(p.arm_a + p.gap), u), cross<S>(p.arm_b, u)};
}

template <class S>
Along<S> along_of(const Pair<S>& p) {
  switch (static_cast<JointKind>(p.j.kind)) {
    case JointKind::kPrismatic: {
      const Vec<S> u = prismatic_axis(p);
      return {row_at_b(p, u), dot<S>(p.gap, u)};
    }
    case JointKind::kDistance: {
      const S distance = length<S>(p.gap);
      // Anchors in one point have no direction; any will do to part them.
      const Vec<S> u = distance > S(kAnchorDistanceMin) ? Vec<S>(p.gap / distance) : Vec<S>(S(1), S(0));
      return {{u.x(), u.y(), cross<S>(p.arm_a, u), cross<S>(p.arm_b, u)}, distance};
    }
    default:
      return {kTurning<S>, p.angle()};
  }
}

template <class S>
S along_impulse(const JointRows<S>& j) {
  return j.along + j.motor + j.low - j.high;
}

template <class S>
void pull_spring(Pair<S>& p, const Along<S>& at, S mass) {
  JointRows<S>& j = p.j;
  const S rest = static_cast<JointKind>(j.kind) == JointKind::kDistance ? j.reference : S(0);
  const SpringStep<S>& s = j.spring;
  const S impulse = -mass * ((S(1) - s.keep) * p.rate(at.row) + s.pull * (at.position - rest)) - s.keep * j.along;
  j.along += impulse;
  p.push(at.row, impulse);
}

template <class S>
void run_motor(Pair<S>& p, const Along<S>& at, S mass) {
  JointRows<S>& j = p.j;
  const S before = j.motor;
  j.motor = clamp_to(before - mass * (p.rate(at.row) - j.motor_speed), -j.motor_bound, j.motor_bound);
  p.push(at.row, j.motor - before);
}

// Keeps the position at or above the lower (sign 1), or at or below the upper limit (sign −1).
template <class S>
void keep_limit(Pair<S>& p, const Along<S>& at, S mass, S room, S sign, S& impulse, const SpringStep<S>& s, S inv_h) {
  const S before = impulse, rate = sign * p.rate(at.row);
  // What room there is may be used up in this sub-step, not more.
  const S change =
      room > S(0) ? -mass * (rate + room * inv_h) : -mass * ((S(1) - s.keep) * rate + s.pull * room) - s.keep * before;
  impulse = max_of(S(0), before + change);
  p.push(at.row, sign * (impulse - before));
}

template <class S, bool kUseBias>
void solve_along(Pair<S>& p, const JointSettings<S>& settings) {
  JointRows<S>& j = p.j;
  if ((j.flags & (kJointSpring | kJointMotorEnabled | kJointLimited)) == 0) return;
  const Along<S> at = along_of(p);
  const S k = p.inverse_mass(at.row);
  if (!(k > S(0))) return;
  const S mass = S(1) / k;
  const SpringStep<S> s = kUseBias ? settings.stiff : SpringStep<S>();
  if (kUseBias && (j.flags & kJointSpring)) pull_spring(p, at, mass);
  if (j.flags & kJointMotorEnabled) run_motor(p, at, mass);
  if (!(j.flags & kJointLimited)) return;
  if (j.lower == j.upper) {  // held there from both sides
    const S impulse = -mass * ((S(1) - s.keep) * p.rate(at.row) + s.pull * (at.position - j.lower)) - s.keep * j.low;
    j.low += impulse;
    p.push(at.row, impulse);
    return;
  }
  keep_limit(p, at, mass, at.position - j.lower, S(1), j.low, s, settings.inv_h);
  keep_limit(p, at, mass, j.upper - at.position, S(-1), j.high, s, settings.inv_h);
}

// Two rows at once: λ += −K⁻¹ ((1 − keep) rates + pull x) − keep λ.
template <class S>
void solve_two_rows(Pair<S>& p, const Row<S>& r, const Row<S>& q, S xr, S xq, const SpringStep<S>& s, S& impulse_r,
                    S& impulse_q) {
  const S k11 = p.inverse_mass(r), k12 = p.coupling(r, q);
  S k22 = p.inverse_mass(q);
  if (!(k22 > S(0))) k22 = S(1);  // neither body can turn
  const S e1 = (S(1) - s.keep) * p.rate(r) + s.pull * xr, e2 = (S(1) - s.keep) * p.rate(q) + s.pull * xq;
  const S inverse = S(1) / (k11 * k22 - k12 * k12);
  const S i1 = -(k22 * e1 - k12 * e2) * inverse - s.keep * impulse_r;
  const S i2 = -(k11 * e2 - k12 * e1) * inverse - s.keep * impulse_q;
  impulse_r += i1;
  impulse_q += i2;
  p.push(r, i1);
  p.push(q, i2);
}

template <class S>
void solve_prismatic(Pair<S>& p, const SpringStep<S>& s) {
  const Vec<S> u = prismatic_axis(p), across(-u.y(), u.x());
  const S gap = dot<S>(p.gap, across), pulled = gap * pulled_share(gap, s);
  solve_two_rows(p, row_at_b(p, across), kTurning<S>, pulled, p.angle(), s, p.j.impulse_x, p.j.turn);
}

// Three rows at once: K = L D Lᵀ.
template <class S>
void solve_stiff_weld(Pair<S>& p, const SpringStep<S>& s) {
  JointRows<S>& j = p.j;
  const Row<S> x = row_in_gap(p, S(1), S(0)), y = row_in_gap(p, S(0), S(1)), t = kTurning<S>;
  const S d1 = p.inverse_mass(x), l21 = p.coupling(x, y) / d1, l31 = p.coupling(x, t) / d1;
  const S d2 = p.inverse_mass(y) - l21 * l21 * d1;
  const S l32 = (p.coupling(y, t) - l31 * l21 * d1) / d2;
  S d3 = p.inverse_mass(t) - l31 * l31 * d1 - l32 * l32 * d2;
  if (!(d3 > S(0))) d3 = S(1);  // neither body can turn
  const S lose = S(1) - s.keep;
  const Vec<S> gap = pulled_gap<S>(p.gap, s);
  const S e1 = -(lose * p.rate(x) + s.pull * gap.x());
  const S e2 = -(lose * p.rate(y) + s.pull * gap.y()) - l21 * e1;
  const S e3 = -(lose * p.rate(t) + s.pull * p.angle()) - l31 * e1 - l32 * e2;
  const S s3 = e3 / d3, s2 = e2 / d2 - l32 * s3, s1 = e1 / d1 - l21 * s2 - l31 * s3;
  const S i1 = s1 - s.keep * j.impulse_x, i2 = s2 - s.keep * j.impulse_y, i3 = s3 - s.keep * j.turn;
  j.impulse_x += i1;
  j.impulse_y += i2;
  j.turn += i3;
  p.push(x, i1);
  p.push(y, i2);
  p.push(t, i3);
}

// A point held by a spring, which pulls at this gap.
template <class S>
void solve_point(Pair<S>& p, const Vec<S>& gap, const SpringStep<S>& s) {
  JointRows<S>& j = p.j;
  const Row<S> x = row_in_gap(p, S(1), S(0)), y = row_in_gap(p, S(0), S(1));
  const S k11 = p.inverse_mass(x), k12 = p.coupling(x, y), k22 = p.inverse_mass(y);
  const S inverse = S(1) / (k11 * k22 - k12 * k12), lose = S(1) - s.keep;
  const S e1 = lose * p.rate(x) + s.pull * gap.x(), e2 = lose * p.rate(y) + s.pull * gap.y();
  const S i1 = -(k22 * e1 - k12 * e2) * inverse - s.keep * j.impulse_x;
  const S i2 = -(k11 * e2 - k12 * e1) * inverse - s.keep * j.impulse_y;
  j.impulse_x += i1;
  j.impulse_y += i2;
  p.push(x, i1);
  p.push(y, i2);
}

template <class S>
void solve_turn(Pair<S>& p, const SpringStep<S>& s) {
  const S k = p.inverse_mass(kTurning<S>);
  if (!(k > S(0))) return;
  const S impulse = -((S(1) - s.keep) * p.rate(kTurning<S>) + s.pull * p.angle()) / k - s.keep * p.j.turn;
  p.j.turn += impulse;
  p.push(kTurning<S>, impulse);
}

template <class S, bool kUseBias>
void solve_weld(Pair<S>& p, const SpringStep<S>& stiff) {
  const bool soft = (p.j.flags & kJointSpring) != 0, soft_turn = (p.j.flags & kJointAngularSpring) != 0;
  if (!soft && !soft_turn) return solve_stiff_weld(p, stiff);
  // Springs first, so that what is stiff has the last word.
  if (soft_turn && kUseBias) solve_turn(p, p.j.angular_spring);
  if (soft && kUseBias) solve_point<S>(p, p.gap, p.j.spring);
  if (!soft_turn) solve_turn(p, stiff);
  if (!soft) solve_point<S>(p, pulled_gap<S>(p.gap, stiff), stiff);
}

// The spring of a mouse joint, with no more than its force.
template <class S>
void drag(Pair<S>& p) {
  JointRows<S>& j = p.j;
  const S before_x = j.impulse_x, before_y = j.impulse_y;
  const Motion<S> b = p.b;
  solve_point<S>(p, p.gap, j.spring);
  const S size = std::sqrt(j.impulse_x * j.impulse_x + j.impulse_y * j.impulse_y);
  if (size <= j.motor_bound) return;
  p.b = b;
  const S scale = j.motor_bound / size;
  j.impulse_x *= scale;
  j.impulse_y *= scale;
  p.push(row_in_gap(p, S(1), S(0)), j.impulse_x - before_x);
  p.push(row_in_gap(p, S(0), S(1)), j.impulse_y - before_y);
}

template <class S, bool kUseBias>
void solve_one(Pair<S>& p, const JointSettings<S>& settings) {
  const SpringStep<S> stiff = kUseBias ? settings.stiff : SpringStep<S>();
  switch (static_cast<JointKind>(p.j.kind)) {
    case JointKind::kRevolute:
    case JointKind::kDistance:
      return solve_along<S, kUseBias>(p, settings);
    case JointKind::kPrismatic:
      solve_along<S, kUseBias>(p, settings);
      return solve_prismatic(p, stiff);
    case JointKind::kWeld:
      return solve_weld<S, kUseBias>(p, stiff);
    case JointKind::kMouse:
      if (kUseBias) drag(p);
  }
}

// Calls visit(row, impulse) for all that the joint exerts.
template <class S, class Visit>
void for_each_impulse(const Pair<S>& p, const Visit& visit) {
  const JointRows<S>& j = p.j;
  switch (static_cast<JointKind>(j.kind)) {
    case JointKind::kRevolute:
    case JointKind::kDistance:
      visit(along_of(p).row, along_impulse(j));
      return;
    case JointKind::kPrismatic: {
      const Vec<S> u = prismatic_axis(p);
      visit(row_at_b(p, u), along_impulse(j));
      visit(row_at_b(p, Vec<S>(-u.y(), u.x())), j.impulse_x);
      visit(kTurning<S>, j.turn);
      return;
    }
    case JointKind::kWeld:
      visit(kTurning<S>, j.turn);
      [[fallthrough]];
    case JointKind::kMouse:
      visit(row_in_gap(p, S(1), S(0)), j.impulse_x);
      visit(row_in_gap(p, S(0), S(1)), j.impulse_y);
  }
}

template <class S>
void add_to_totals(const Pair<S>& p) {
  JointRows<S>& j = p.j;
  const bool revolute = static_cast<JointKind>(j.kind) == JointKind::kRevolute;
  j.total_turn += revolute ? along_impulse(j) : j.turn;
  if (revolute) return;  // its force is that of its point
  for_each_impulse(p, [&](const Row<S>& row, S impulse) {
    j.total_x += row.ux * impulse;
    j.total_y += row.uy * impulse;
  });
}

}  // namespace

template <class S>
void warm_start_rows(WorldData<S>& world, JointSet<S>& set) {
  for (JointRows<S>& rows : set.rows) {
    Pair<S> p(world, rows);
    for_each_impulse(p, [&](const Row<S>& row, S impulse) { p.push(row, impulse); });
    p.store_to(world);
  }
}

template <class S>
void solve_rows(WorldData<S>& world, JointSet<S>& set, const JointSettings<S>& settings) {
  for (JointRows<S>& rows : set.rows) {
    Pair<S> p(world, rows);
    solve_one<S, true>(p, settings);
    p.store_to(world);
  }
}

template <class S>
void relax_rows(WorldData<S>& world, JointSet<S>& set, const JointSettings<S>& settings) {
  for (JointRows<S>& rows : set.rows) {
    Pair<S> p(world, rows);
    solve_one<S, false>(p, settings);
    add_to_totals(p);
    p.store_to(world);
  }
}

#define URTO_INSTANTIATE(S)                                                       \
  template void warm_start_rows(WorldData<S>&, JointSet<S>&);                     \
  template void solve_rows(WorldData<S>&, JointSet<S>&, const JointSettings<S>&); \
  template void relax_rows(WorldData<S>&, JointSet<S>&, const JointSettings<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

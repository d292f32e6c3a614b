#include "physics/solver/joint_set.h"

#include "physics/constants.h"
#include "physics/geometry/exponential.h"
#include "physics/joint_graph.h"

namespace urto {
namespace {

constexpr std::uint32_t kColors = kPointColors;

template <class S>
bool movable(const Body<S>& body) {
  return body.inv_mass > S(0);
}

// Counting sort by colour: stable, so that within a colour the order of the active list stays.
template <class S>
void sort_by_color(const WorldData<S>& world, JointSet<S>& set, std::uint32_t (&begin)[kColors + 1]) {
  set.taken.assign(world.bodies.size(), 0);
  set.colors.clear();
  for (std::uint32_t& b : begin) b = 0;
  for (const std::uint32_t slot : set.revolute) {
    const Joint<S>& j = world.joints[slot];
    const bool movable_a = movable(world.bodies[j.body_a]), movable_b = movable(world.bodies[j.body_b]);
    const std::uint64_t taken = (movable_a ? set.taken[j.body_a] : 0) | (movable_b ? set.taken[j.body_b] : 0);
    const std::uint32_t color = ~taken == 0 ? kColors - 1 : static_cast<std::uint32_t>(__builtin_ctzll(~taken));
    if (movable_a) set.taken[j.body_a] |= 1ull << color;
    if (movable_b) set.taken[j.body_b] |= 1ull << color;
    set.colors.push_back(static_cast<std::uint8_t>(color));
    ++begin[color + 1];
  }
  for (std::uint32_t c = 0; c < kColors; ++c) begin[c + 1] += begin[c];
  set.sorted.resize(set.revolute.size());
  std::uint32_t next[kColors];
  for (std::uint32_t c = 0; c < kColors; ++c) next[c] = begin[c];
  for (std::size_t i = 0; i < set.revolute.size(); ++i) set.sorted[next[set.colors[i]]++] = set.revolute[i];
}

template <class S>
void put_point(const WorldData<S>& world, PointBlock<S>& block, std::uint32_t slot) {
  const Joint<S>& j = world.joints[slot];
  const Body<S>&a = world.bodies[j.body_a], &b = world.bodies[j.body_b];
  const Vec<S> arm_a = a.rotation().apply(Vec<S>(j.ax, j.ay)), arm_b = b.rotation().apply(Vec<S>(j.bx, j.by));
  const std::uint32_t lane = block.count++;
  block.ax[lane] = arm_a.x();
  block.ay[lane] = arm_a.y();
  block.bx[lane] = arm_b.x();
  block.by[lane] = arm_b.y();
  block.start_x[lane] = (b.x - a.x) + (arm_b.x() - arm_a.x());
  block.start_y[lane] = (b.y - a.y) + (arm_b.y() - arm_a.y());
  block.inv_mass_a[lane] = a.inv_mass;
  block.inv_inertia_a[lane] = a.inv_inertia;
  block.inv_mass_b[lane] = b.inv_mass;
  block.inv_inertia_b[lane] = b.inv_inertia;
  block.impulse_x[lane] = j.impulse_x;
  block.impulse_y[lane] = j.impulse_y;
  block.a[lane] = j.body_a;
  block.b[lane] = j.body_b;
  block.joint[lane] = slot;
  block.movable_a[lane] = movable(a);
  block.movable_b[lane] = movable(b);
}

// Unused lanes compute on zeros and a mass of one, and are not written back.
template <class S>
void start_block(PointBlock<S>& block) {
  block = PointBlock<S>{};
  for (int lane = 0; lane < kLanes<S>; ++lane) block.inv_mass_a[lane] = S(1);
}

template <class S>
void gather_points(WorldData<S>& world, JointSet<S>& set) {
  std::uint32_t begin[kColors + 1];
  sort_by_color(world, set, begin);
  auto& ranges = set.ranges;
  ranges.clear();
  for (std::uint32_t color = 0; color < kColors; ++color) {
    const std::uint32_t lanes = color + 1 == kColors ? 1u : static_cast<std::uint32_t>(kLanes<S>),
                        end = begin[color + 1];
    for (std::uint32_t i = begin[color]; i < end; i += lanes) ranges.push_back({i, end - i < lanes ? end : i + lanes});
    set.ends[color] = static_cast<std::uint32_t>(ranges.size());
  }
  set.points.resize(ranges.size());
  world.team->share(ranges.size(), kBlocksPerShare, [&](unsigned, std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block) {
      start_block(set.points[block]);
      for (std::uint32_t i = ranges[block].begin; i < ranges[block].end; ++i)
        put_point(world, set.points[block], set.sorted[i]);
    }
  });
}

template <class S>
bool has_rows(const Joint<S>& j) {
  return j.joint_kind() != JointKind::kRevolute || j.has(kJointSpring | kJointMotorEnabled | kJointLimited);
}

template <class S>
void put_body_a(const WorldData<S>& world, JointRows<S>& rows, const Joint<S>& j) {
  if (j.body_a == kNone) {  // the target stands where a's anchor would be
    rows.center_x -= j.ux;
    rows.center_y -= j.uy;
    return;
  }
  const Body<S>& a = world.bodies[j.body_a];
  rows.inv_mass_a = a.inv_mass;
  rows.inv_inertia_a = a.inv_inertia;
  const Vec<S> arm = a.rotation().apply(Vec<S>(j.ax, j.ay)), axis = a.rotation().apply(Vec<S>(j.ux, j.uy));
  rows.ax = arm.x();
  rows.ay = arm.y();
  rows.ux = axis.x();
  rows.uy = axis.y();
  rows.center_x -= a.x;
  rows.center_y -= a.y;
}

template <class S>
void put_impulses(JointRows<S>& rows, const Joint<S>& j) {
  rows.impulse_x = j.impulse_x;
  rows.impulse_y = j.impulse_y;
  rows.turn = j.turn;
  rows.along = j.spring;
  rows.motor = j.motor;
  rows.low = j.low;
  rows.high = j.high;
}

template <class S>
void put_rows(WorldData<S>& world, JointSet<S>& set, std::uint32_t slot, S h) {
  Joint<S>& j = world.joints[slot];
  const Body<S>& b = world.bodies[j.body_b];
  JointRows<S> rows{};
  rows.joint = slot;
  rows.kind = j.kind;
  rows.flags = j.flags;
  rows.a = j.body_a;
  rows.b = j.body_b;
  rows.inv_mass_b = b.inv_mass;
  rows.inv_inertia_b = b.inv_inertia;
  const Vec<S> arm = b.rotation().apply(Vec<S>(j.bx, j.by));
  rows.bx = arm.x();
  rows.by = arm.y();
  rows.center_x = b.x;
  rows.center_y = b.y;
  put_body_a(world, rows, j);
  if (j.body_a != kNone && j.joint_kind() != JointKind::kDistance) rows.angle = j.angle = joint_angle(world, j);
  rows.reference = j.reference;
  rows.lower = j.lower;
  rows.upper = j.upper;
  rows.motor_speed = j.motor_speed;
  rows.motor_bound = j.motor_bound * h;
  if (j.has(kJointSpring)) rows.spring = SpringStep<S>(j.hertz, j.damping_ratio, h);
  if (j.has(kJointAngularSpring)) rows.angular_spring = SpringStep<S>(j.angular_hertz, j.angular_damping_ratio, h);
  put_impulses(rows, j);
  set.rows.push_back(rows);
}

}  // namespace

template <class S>
SpringStep<S>::SpringStep(S hertz, S damping_ratio, S h) {
  const S turn = S(2 * 3.14159265358979323846) * hertz * h;  // rad of the free oscillation in a sub-step
  keep = S(exponential_of_minus(2 * double(damping_ratio) * double(turn)));
  if (keep * turn * turn > S(1)) keep = S(1) / (turn * turn);
  pull = keep * turn * turn / h;
}

template <class S>
SpringStep<S> implicit_spring(S hertz, S damping_ratio, S h) {
  const S turn = S(2 * 3.14159265358979323846) * hertz * h;
  SpringStep<S> out;
  out.keep = S(1) / (S(1) + turn * (S(2) * damping_ratio + turn));
  out.pull = out.keep * turn * turn / h;
  return out;
}

template <class S>
void gather_joints(WorldData<S>& world, JointSet<S>& set, S h) {
  set.revolute.clear();
  set.rows.clear();
  for (const std::uint32_t slot : world.active_joints) {
    const Joint<S>& j = world.joints[slot];
    if (j.joint_kind() == JointKind::kRevolute) set.revolute.push_back(slot);
    if (has_rows(j)) put_rows(world, set, slot, h);
  }
  gather_points(world, set);
}

template <class S>
void store_joints(WorldData<S>& world, const JointSet<S>& set) {
  const S rate = S(1) / S(world.settings.time_step);
  world.team->share(set.points.size(), kBlocksPerShare, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PointBlock<S>& block = set.points[i];
      for (std::uint32_t lane = 0; lane < block.count; ++lane) {
        Joint<S>& j = world.joints[block.joint[lane]];
        j.impulse_x = block.impulse_x[lane];
        j.impulse_y = block.impulse_y[lane];
        j.force_x = block.total_x[lane] * rate;
        j.force_y = block.total_y[lane] * rate;
      }
    }
  });
  for (const JointRows<S>& rows : set.rows) {
    Joint<S>& j = world.joints[rows.joint];
    j.torque = rows.total_turn * rate;
    j.spring = rows.along;
    j.motor = rows.motor;
    j.low = rows.low;
    j.high = rows.high;
    if (j.joint_kind() == JointKind::kRevolute) continue;  // its point is stored above
    j.impulse_x = rows.impulse_x;
    j.impulse_y = rows.impulse_y;
    j.turn = rows.turn;
    j.force_x = rows.total_x * rate;
    j.force_y = rows.total_y * rate;
  }
}

#define URTO_INSTANTIATE(S)                                    \
  template struct SpringStep<S>;                               \
  template SpringStep<S> implicit_spring(S, S, S);             \
  template void gather_joints(WorldData<S>&, JointSet<S>&, S); \
  template void store_joints(WorldData<S>&, const JointSet<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

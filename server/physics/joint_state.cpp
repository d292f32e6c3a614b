#include "physics/joint_state.h"

#include <cmath>

#include "physics/constants.h"
#include "physics/joint_graph.h"

namespace urto {
namespace {

// A body's point and how fast it moves, in double precision.
struct MovingPoint {
  Vec2 at{0, 0}, velocity{0, 0}, center{0, 0};
  double turning = 0;  // rad/s
};

template <class S>
MovingPoint moving_point(const WorldData<S>& world, std::uint32_t slot, S x, S y) {
  const Body<S>& body = world.bodies[slot];
  const Motion<S>& m = world.motions[slot];
  const Vec2 arm = body.rotation().apply(Vec<S>(x, y)).template cast<double>();
  MovingPoint out;
  out.center = body.center().template cast<double>();
  out.at = out.center + arm;
  out.turning = double(m.w);
  out.velocity = Vec2(double(m.vx), double(m.vy)) + cross<double>(out.turning, arm);
  return out;
}

// The position of the joint along u and how fast it changes: u turns with a.
void set_translation(JointState& state, const MovingPoint& a, const MovingPoint& b, const Vec2& u) {
  const Vec2 way = b.at - a.at;
  state.position = dot<double>(way, u);
  state.speed = dot<double>(b.velocity - a.velocity, u) + dot<double>(way, cross<double>(a.turning, u));
}

void set_distance(JointState& state, const Vec2& way, const Vec2& velocity) {
  state.position = length<double>(way);
  state.speed = state.position > 0 ? dot<double>(velocity, way) / state.position : 0;
}

template <class S>
bool breaks(const Joint<S>& j) {
  if (!j.has(kJointBreaks)) return false;
  return std::sqrt(j.force_x * j.force_x + j.force_y * j.force_y) > j.break_force ||
         absolute(j.torque) > j.break_torque;
}

template <class S>
JointEvent break_event(const WorldData<S>& world, std::uint32_t slot) {
  const Joint<S>& j = world.joints[slot];
  JointEvent event;
  event.joint = id_of(slot, j.generation);
  event.body_a = j.body_a == kNone ? 0 : id_of(world, j.body_a);
  event.body_b = id_of(world, j.body_b);
  event.point = moving_point(world, j.body_b, j.bx, j.by).at;
  event.force = double(std::sqrt(j.force_x * j.force_x + j.force_y * j.force_y));
  event.torque = double(absolute(j.torque));
  return event;
}

}  // namespace

template <class S>
JointState joint_state_of(const WorldData<S>& world, std::uint32_t slot) {
  const Joint<S>& j = world.joints[slot];
  JointState out;
  out.kind = j.joint_kind();
  out.body_b = id_of(world, j.body_b);
  out.force = Vec2(double(j.force_x), double(j.force_y));
  out.torque = double(j.torque);
  const MovingPoint b = moving_point(world, j.body_b, j.bx, j.by);
  out.point_b = b.at;
  if (out.kind == JointKind::kMouse) {
    out.point_a = Vec2(double(j.ux), double(j.uy));
    set_distance(out, b.at - out.point_a, b.velocity);
    return out;
  }
  const MovingPoint a = moving_point(world, j.body_a, j.ax, j.ay);
  out.body_a = id_of(world, j.body_a);
  out.point_a = a.at;
  out.motor = {j.has(kJointMotorEnabled), double(j.motor_speed), double(j.motor_bound)};
  if (out.kind == JointKind::kPrismatic) {
    const Vec<S> u = world.bodies[j.body_a].rotation().apply(Vec<S>(j.ux, j.uy));
    set_translation(out, a, b, u.template cast<double>());
  } else if (out.kind == JointKind::kDistance) {
    set_distance(out, b.at - a.at, b.velocity - a.velocity);
  } else {
    out.position = double(joint_angle(world, j));
    out.speed = b.turning - a.turning;
  }
  return out;
}

template <class S>
void break_joints(WorldData<S>& world) {
  std::vector<std::vector<std::uint32_t>>& broken = lists_by_part(world);
  world.team->share(world.active_joints.size(), kPairsPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (breaks(world.joints[world.active_joints[i]])) broken[part].push_back(world.active_joints[i]);
  });
  // Backwards: destroying swaps the last active joint into the hole, and that one has been seen.
  for (auto list = broken.rbegin(); list != broken.rend(); ++list) {
    for (auto slot = list->rbegin(); slot != list->rend(); ++slot) {
      world.joint_events.push_back(break_event(world, *slot));
      destroy_joint(world, *slot);
    }
  }
}

#define URTO_INSTANTIATE(S)                                               \
  template JointState joint_state_of(const WorldData<S>&, std::uint32_t); \
  template void break_joints(WorldData<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

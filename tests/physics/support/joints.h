#pragma once

// Joints between bodies of small worlds.

#include <algorithm>

#include "physics/support/scenes.h"

namespace urto::testing {

inline JointId join(World& world, const JointDef& def) {
  const Expected<JointId> id = world.add_joint(def);
  EXPECT_TRUE(id.has_value()) << (id ? "" : id.error().field + ": " + id.error().message);
  return id.value_or(0);
}

inline JointDef joint_between(BodyId a, BodyId b, const Vec2& at_a, const Vec2& at_b, JointGeometry geometry) {
  JointDef def;
  def.body_a = a;
  def.body_b = b;
  def.anchor_a = at_a;
  def.anchor_b = at_b;
  def.geometry = std::move(geometry);
  return def;
}

// A post that joints hang from and nothing touches.
inline BodyId add_post(World& world, double x = 0, double y = 0) {
  BodyDef post = box_body(x, y, 0.2, 0.2, BodyType::kStatic);
  post.shapes[0].filter = {0, 0};
  return add(world, post);
}

// Links of 1 m × 0.2 m hang from `from`, the first at (0.5, 0) of a row that leads away at an angle; the layout is
// stretched by a factor. The last link has `load` times the mass of the others.
struct Links {
  std::vector<BodyId> links;
  std::vector<JointId> joints;
};

inline Links add_links(World& world, BodyId from, int count, double angle, double stretch = 1, double load = 1) {
  Links chain;
  const double c = std::cos(angle), s = std::sin(angle);
  BodyId before = from;
  Vec2 at(0, 0);
  for (int i = 0; i < count; ++i) {
    const double way = (i + 0.5) * stretch;
    BodyDef def = box_body(way * c, way * s, 1, 0.2);
    def.angle = angle;
    def.shapes[0].filter = {2, ~2u};
    if (i + 1 == count) def.mass = 0.2 * load;
    chain.links.push_back(add(world, def));
    chain.joints.push_back(join(world, joint_between(before, chain.links.back(), at, {-0.5, 0}, RevoluteJoint{})));
    before = chain.links.back();
    at = Vec2(0.5, 0);
  }
  return chain;
}

// m, the widest gap between anchors that belong together.
inline double gap_of(const World& world, const std::vector<JointId>& joints) {
  double most = 0;
  for (const JointId id : joints) {
    const JointState state = *world.joint(id);
    most = std::max(most, (state.point_b - state.point_a).norm());
  }
  return most;
}

}  // namespace urto::testing

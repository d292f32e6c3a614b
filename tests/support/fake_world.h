#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "physics/world.h"

namespace urto::testing {

// A world without collisions, for tests of what surrounds the engine: bodies fly, forces act, what a test puts into
// `next_contacts` is reported by the next step, and `refuse` makes one kind of call fail as the engine never should.
class FakeWorld : public World {
 public:
  explicit FakeWorld(const WorldSettings& settings) : settings_(settings) {}

  const WorldSettings& settings() const override { return settings_; }
  Expected<BodyId> add_body(const BodyDef& def) override;
  Status check_body(const BodyDef& def) const override;
  Status remove_body(BodyId id) override;
  bool contains(BodyId id) const override { return bodies_.count(id) > 0; }
  Expected<BodyState> body(BodyId id) const override;
  Expected<MassProperties> mass_properties(BodyId id) const override;

  Status apply_impulse(BodyId id, const Vec2& impulse, const Vec2& point) override;
  Status apply_impulse_to_center(BodyId id, const Vec2& impulse) override;
  Status apply_angular_impulse(BodyId id, double impulse) override;
  Status set_force(BodyId id, const Vec2& force, double torque, bool in_body_frame) override;
  Status set_velocity(BodyId id, const Vec2& velocity, double angular_velocity) override;
  Status set_transform(BodyId id, const Vec2& position, double angle) override;
  Status set_awake(BodyId id, bool awake) override;

  // Joints hold nothing together: they are only kept.
  Expected<JointId> add_joint(const JointDef& def) override;
  Status check_joint(const JointDef& def) const override;
  Status remove_joint(JointId id) override;
  bool contains_joint(JointId id) const override { return joints_.count(id) > 0; }
  Status set_motor(JointId id, const JointMotor& motor) override;
  Status set_target(JointId id, const Vec2& target) override;
  Expected<JointState> joint(JointId id) const override;
  std::vector<JointId> joints() const override;
  std::span<const JointEvent> joint_events() const override { return joint_events_; }

  void step() override;
  std::uint64_t step_count() const override { return step_count_; }

  void capture(BodyColumns& out, bool include_static) const override;
  std::vector<ContactPoint> contacts() const override { return {}; }
  std::span<const ContactEvent> contact_events() const override { return contact_events_; }
  Energy energy() const override { return {}; }
  Counters counters() const override;
  Profile profile() const override { return {}; }
  std::vector<Feature> model() const override { return {{"gravity", "none", false, "a fake world"}}; }

  Expected<std::vector<BodyId>> query_point(const Vec2& point) const override;
  Expected<std::vector<BodyId>> query_aabb(const Vec2& lower, const Vec2& upper) const override;
  Expected<std::vector<RayHit>> query_ray(const Vec2&, const Vec2&) const override { return std::vector<RayHit>(); }
  Expected<std::vector<NearHit>> query_nearest(const Vec2&, double, std::uint32_t) const override {
    return std::vector<NearHit>();
  }

  Expected<QueryHits<CastHit>> query_cast(const QueryShape&, const Vec2&, const QueryOptions&) const override {
    return QueryHits<CastHit>();
  }
  Expected<QueryHits<BodyId>> query_overlap(const QueryShape&, const QueryOptions&) const override {
    return QueryHits<BodyId>();
  }
  Expected<QueryHits<ClosestHit>> query_closest(const QueryShape&, double, const QueryOptions&) const override {
    return QueryHits<ClosestHit>();
  }

  std::vector<std::byte> save() const override { return {}; }
  Status restore(std::span<const std::byte>) override { return {}; }
  std::uint64_t state_hash() const override { return 42 + step_count_; }

  std::vector<ContactEvent> next_contacts;
  std::vector<JointId> next_breaks;  // joints that the next step breaks
  std::string refuse;                // the name of a function above

 private:
  struct Body {
    BodyDef def;
    BodyState state;
    Vec2 force{0, 0};
  };

  Status find(BodyId id, const std::string& caller);

  WorldSettings settings_;
  std::map<BodyId, Body> bodies_;
  BodyId last_id_ = 0;
  std::uint64_t step_count_ = 0;
  std::vector<ContactEvent> contact_events_;
  struct FakeJoint {
    JointDef def;
    JointState state;
  };
  std::map<JointId, FakeJoint> joints_;
  JointId last_joint_ = 0;
  std::vector<JointEvent> joint_events_;
};

}  // namespace urto::testing

#pragma once

#include "physics/data.h"
#include "physics/solver/joint_set.h"
#include "physics/solver/precise/precise.h"
#include "physics/world.h"

namespace urto {

// The World of one scalar: checks arguments, then leaves the work to the phases and factories.
template <class S>
class WorldOf final : public World {
 public:
  WorldOf(const WorldSettings& settings, Clock clock, unsigned threads);

  const WorldSettings& settings() const override { return data_.settings; }

  Expected<BodyId> add_body(const BodyDef& def) override;
  Status check_body(const BodyDef& def) const override;
  Status remove_body(BodyId id) override;
  bool contains(BodyId id) const override { return slot_of(id) != kNone; }
  Expected<BodyState> body(BodyId id) const override;
  Expected<MassProperties> mass_properties(BodyId id) const override;

  Status apply_impulse(BodyId id, const Vec2& impulse, const Vec2& point) override;
  Status apply_impulse_to_center(BodyId id, const Vec2& impulse) override;
  Status apply_angular_impulse(BodyId id, double impulse) override;
  Status set_force(BodyId id, const Vec2& force, double torque, bool in_body_frame) override;
  Status set_velocity(BodyId id, const Vec2& velocity, double angular_velocity) override;
  Status set_transform(BodyId id, const Vec2& position, double angle) override;
  Status set_awake(BodyId id, bool awake) override;

  Expected<JointId> add_joint(const JointDef& def) override;
  Status check_joint(const JointDef& def) const override;
  Status remove_joint(JointId id) override;
  bool contains_joint(JointId id) const override { return joint_slot_of(id) != kNone; }
  Status set_motor(JointId id, const JointMotor& motor) override;
  Status set_target(JointId id, const Vec2& target) override;
  Expected<JointState> joint(JointId id) const override;
  std::vector<JointId> joints() const override;
  std::span<const JointEvent> joint_events() const override { return data_.joint_events; }

  void step() override;
  std::uint64_t step_count() const override { return data_.step_count; }

  void capture(BodyColumns& out, bool include_static) const override;
  std::vector<ContactPoint> contacts() const override;
  std::span<const ContactEvent> contact_events() const override {
    return std::span(data_.events).first(data_.events_reported);
  }
  Energy energy() const override;
  Counters counters() const override;
  Profile profile() const override { return profile_; }
  std::vector<Feature> model() const override;

  Expected<std::vector<BodyId>> query_point(const Vec2& point) const override;
  Expected<std::vector<BodyId>> query_aabb(const Vec2& lower, const Vec2& upper) const override;
  Expected<std::vector<RayHit>> query_ray(const Vec2& origin, const Vec2& translation) const override;
  Expected<std::vector<NearHit>> query_nearest(const Vec2& point, double distance_max,
                                               std::uint32_t count_max) const override;
  Expected<QueryHits<CastHit>> query_cast(const QueryShape& shape, const Vec2& translation,
                                          const QueryOptions& options) const override;
  Expected<QueryHits<BodyId>> query_overlap(const QueryShape& shape, const QueryOptions& options) const override;
  Expected<QueryHits<ClosestHit>> query_closest(const QueryShape& shape, double distance_max,
                                                const QueryOptions& options) const override;

  std::vector<std::byte> save() const override;
  Status restore(std::span<const std::byte> state) override;
  std::uint64_t state_hash() const override;

  // For the test that every part of the state reaches the hash.
  WorldData<S>& data() { return data_; }

 private:
  std::uint32_t slot_of(BodyId id) const;
  std::uint32_t joint_slot_of(JointId id) const;
  Status check_joint_bodies(const JointDef& def) const;
  Status check_joint_target(JointId id, bool right_kind, const char* message) const;
  // kUnknownBody, or kWrongBodyType if `dynamic` is asked for and the body is not.
  Status check_target(BodyId id, bool dynamic) const;
  void solve();
  template <class PhaseFunction>
  void run(Phase phase, PhaseFunction&& function);

  WorldData<S> data_;
  JointSet<S> joint_set_;  // kept for its capacity
  PreciseSolver precise_;  // kept for its capacity
  Clock clock_;
  std::uint64_t phase_start_ = 0;  // ns
  Profile profile_;
};

}  // namespace urto

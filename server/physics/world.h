#pragma once

// The engine's public face. A World is a deterministic function of its settings and of the calls made on it: equal
// calls give equal bits on every compiler, optimisation level, processor and SIMD width.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/definitions.h"
#include "physics/error.h"
#include "physics/joint_definitions.h"
#include "physics/query_shape.h"

namespace urto {

// Where a body is and how it moves.
struct BodyState {
  BodyType type = BodyType::kDynamic;
  Vec2 position{0, 0};          // m, of the body's origin
  double angle = 0;             // rad, (−π, π]
  Vec2 velocity{0, 0};          // m/s, of the centre of mass
  double angular_velocity = 0;  // rad/s
  bool awake = true;
};

struct MassProperties {
  double mass = 0;            // kg; 0 unless dynamic
  double inertia = 0;         // kg·m² about the centre of mass; 0 unless dynamic
  Vec2 center_of_mass{0, 0};  // m, body frame
};

// The state of many bodies as columns of one length, ascending id.
struct BodyColumns {
  std::vector<BodyId> id;
  std::vector<double> x, y;                    // m, of the body's origin
  std::vector<double> angle;                   // rad, (−π, π]
  std::vector<double> velocity_x, velocity_y;  // m/s
  std::vector<double> angular_velocity;        // rad/s
  std::vector<std::uint8_t> awake;             // 0 or 1
};

struct ContactPoint {
  BodyId body_a = 0, body_b = 0;
  Vec2 point{0, 0};            // m, world frame
  Vec2 normal{0, 0};           // unit, from a to b
  double separation = 0;       // m, negative if penetrating
  double normal_impulse = 0;   // N·s over the last step, ≥ 0
  double tangent_impulse = 0;  // N·s over the last step, along the normal turned by −90°
};

struct ContactEvent {
  enum class Kind : std::uint8_t { kBegin, kEnd, kHit };
  Kind kind = Kind::kBegin;
  BodyId body_a = 0, body_b = 0;
  Vec2 point{0, 0};           // m, world frame (begin and hit)
  Vec2 normal{0, 0};          // unit, from a to b (begin and hit)
  double approach_speed = 0;  // m/s ≥ 0 (begin and hit)
  bool sensor = false;
};

struct RayHit {
  BodyId body = 0;
  Vec2 point{0, 0};     // m, world frame
  Vec2 normal{0, 0};    // unit, out of the body; zero if the ray starts inside
  double fraction = 0;  // of the translation, [0, 1]
};

struct NearHit {
  BodyId body = 0;
  Vec2 point{0, 0};     // m, the body's point nearest to the query's; that point itself if inside
  Vec2 normal{0, 0};    // unit, out of the body; zero if inside
  double distance = 0;  // m ≥ 0
};

struct Energy {
  double kinetic = 0;           // J
  double potential = 0;         // J: gravity relative to y = 0, springs, attractors
  Vec2 momentum{0, 0};          // kg·m/s
  double angular_momentum = 0;  // kg·m²/s about the world's origin
};

// The phases of World::step in their order. The names are those of docs/architecture.md.
enum class Phase : std::uint8_t {
  kUpdateBroadPhase,
  kUpdateContacts,
  kSolve,
  kContinuousCollision,
  kUpdateSleep,
  kCount,
};
const char* phase_name(Phase phase);

struct Profile {
  double ms[static_cast<std::size_t>(Phase::kCount)] = {};  // of the last step; zeros without a clock
  double step_ms = 0;
};

struct Counters {
  std::uint32_t bodies = 0, awake_bodies = 0, shapes = 0, joints = 0;
  std::uint32_t pairs = 0;     // of shapes whose fat bounds overlap
  std::uint32_t contacts = 0;  // touching pairs
  double penetration_max = 0;  // m ≥ 0, of the last step
};

// One choice of the model: what runs in a step, and why.
struct Feature {
  std::string name;
  std::string choice;
  bool on = false;
  std::string reason;
};

// Monotonic nanoseconds, passed in because physics has no clock of its own. Only the profile reads it.
using Clock = std::uint64_t (*)();

class World {
 public:
  // Steps with so many threads, the caller's among them (1 to kThreadsMax); results do not depend on it.
  // Errors: kInvalidValue for a setting outside its range.
  static Expected<std::unique_ptr<World>> create(const WorldSettings& settings, Clock clock = nullptr,
                                                 unsigned threads = 1);
  virtual ~World() = default;

  virtual const WorldSettings& settings() const = 0;

  // Bodies. Every refusal leaves the world as it was.
  virtual Expected<BodyId> add_body(const BodyDef& def) = 0;
  // The checks of add_body alone. What passes is accepted by add_body while fewer than kBodiesMax bodies exist.
  virtual Status check_body(const BodyDef& def) const = 0;
  virtual Status remove_body(BodyId id) = 0;
  virtual bool contains(BodyId id) const = 0;
  virtual Expected<BodyState> body(BodyId id) const = 0;
  virtual Expected<MassProperties> mass_properties(BodyId id) const = 0;

  // Motion. All wake the body. Impulses and forces: dynamic bodies only. Velocities: not static ones.
  virtual Status apply_impulse(BodyId id, const Vec2& impulse, const Vec2& point) = 0;  // N·s at a world point
  virtual Status apply_impulse_to_center(BodyId id, const Vec2& impulse) = 0;
  virtual Status apply_angular_impulse(BodyId id, double impulse) = 0;  // N·m·s
  // Acts in every following step until set anew. In the body's frame it turns with the body.
  virtual Status set_force(BodyId id, const Vec2& force, double torque, bool in_body_frame) = 0;
  virtual Status set_velocity(BodyId id, const Vec2& velocity, double angular_velocity) = 0;
  virtual Status set_transform(BodyId id, const Vec2& position, double angle) = 0;
  virtual Status set_awake(BodyId id, bool awake) = 0;

  // Joints. A joint goes with either of its bodies. Adding, removing and changing one wakes its bodies.
  // Errors of all: kInvalidValue, kUnknownBody, kUnknownJoint, kWrongBodyType (no dynamic body), kWrongJointKind,
  // kLimitReached, kNotSupported (by a solver other than the soft step).
  virtual Expected<JointId> add_joint(const JointDef& def) = 0;
  // The checks of add_joint but for those of the bodies and of kJointsMax.
  virtual Status check_joint(const JointDef& def) const = 0;
  virtual Status remove_joint(JointId id) = 0;
  virtual bool contains_joint(JointId id) const = 0;
  virtual Status set_motor(JointId id, const JointMotor& motor) = 0;  // revolute and prismatic joints
  virtual Status set_target(JointId id, const Vec2& target) = 0;      // m, mouse joints
  virtual Expected<JointState> joint(JointId id) const = 0;
  virtual std::vector<JointId> joints() const = 0;  // ascending
  // Joints that broke in the last step, in a fixed order.
  virtual std::span<const JointEvent> joint_events() const = 0;

  // Advances by settings().time_step.
  virtual void step() = 0;
  virtual std::uint64_t step_count() const = 0;

  // Views of the world as it is.
  virtual void capture(BodyColumns& out, bool include_static) const = 0;
  virtual std::vector<ContactPoint> contacts() const = 0;
  // Of the last step, in a fixed order; first those of bodies that were removed since the step before.
  virtual std::span<const ContactEvent> contact_events() const = 0;
  virtual Energy energy() const = 0;
  virtual Counters counters() const = 0;
  virtual Profile profile() const = 0;
  virtual std::vector<Feature> model() const = 0;

  // Queries. Ids ascend, but for rays (by fraction) and near hits (by distance); a body is named once.
  // Sensors are not seen. Errors: kInvalidValue.
  virtual Expected<std::vector<BodyId>> query_point(const Vec2& point) const = 0;
  virtual Expected<std::vector<BodyId>> query_aabb(const Vec2& lower, const Vec2& upper) const = 0;
  virtual Expected<std::vector<RayHit>> query_ray(const Vec2& origin, const Vec2& translation) const = 0;
  virtual Expected<std::vector<NearHit>> query_nearest(const Vec2& point, double distance_max,
                                                       std::uint32_t count_max) const = 0;
  // With a shape (shape_query.h). Errors: those of the checks of query_shape.h.
  virtual Expected<QueryHits<CastHit>> query_cast(const QueryShape& shape, const Vec2& translation,
                                                  const QueryOptions& options) const = 0;
  virtual Expected<QueryHits<BodyId>> query_overlap(const QueryShape& shape, const QueryOptions& options) const = 0;
  virtual Expected<QueryHits<ClosestHit>> query_closest(const QueryShape& shape, double distance_max,
                                                        const QueryOptions& options) const = 0;

  // The whole dynamic state as one block. restore() needs a world of the same precision; it takes over the settings
  // of the saved one. Stepping on after a restore gives the bits that stepping on without would have given.
  virtual std::vector<std::byte> save() const = 0;
  virtual Status restore(std::span<const std::byte> state) = 0;  // errors: kCorruptState
  // A hash of every byte of save().
  virtual std::uint64_t state_hash() const = 0;
};

}  // namespace urto

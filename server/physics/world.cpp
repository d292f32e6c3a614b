#include "physics/world.h"

#include <algorithm>
#include <numeric>

#include "physics/body_factory.h"
#include "physics/bounds.h"
#include "physics/contact_counts.h"
#include "physics/contact_graph.h"
#include "physics/contacts.h"
#include "physics/continuous.h"
#include "physics/end_of_step.h"
#include "physics/hits.h"
#include "physics/joint_graph.h"
#include "physics/joint_state.h"
#include "physics/motion.h"
#include "physics/query.h"
#include "physics/shape_query.h"
#include "physics/sleep.h"
#include "physics/solver/soft_step.h"
#include "physics/solver/thesis.h"
#include "physics/state.h"
#include "physics/validation.h"
#include "physics/world_of.h"

namespace urto {
namespace {

constexpr double kImpulseMax = 1e15;  // N·s
constexpr double kForceMax = 1e15;    // N, N·m
constexpr double kNanosecondsPerMillisecond = 1e6;

// Ids ascend with the slots until a slot is used again.
void sort_by_id(BodyColumns& columns) {
  if (std::is_sorted(columns.id.begin(), columns.id.end())) return;
  std::vector<std::uint32_t> order(columns.id.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return columns.id[a] < columns.id[b]; });
  const auto reorder = [&](auto& column) {
    auto sorted = column;
    for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = column[order[i]];
    column.swap(sorted);
  };
  reorder(columns.id);
  reorder(columns.awake);
  for (std::vector<double>* column :
       {&columns.x, &columns.y, &columns.angle, &columns.velocity_x, &columns.velocity_y, &columns.angular_velocity})
    reorder(*column);
}

}  // namespace

const char* phase_name(Phase phase) {
  switch (phase) {
    case Phase::kUpdateBroadPhase:
      return "update_broad_phase";
    case Phase::kUpdateContacts:
      return "update_contacts";
    case Phase::kSolve:
      return "solve";
    case Phase::kContinuousCollision:
      return "continuous_collision";
    case Phase::kUpdateSleep:
      return "update_sleep";
    case Phase::kCount:
      break;
  }
  return "";
}

Expected<std::unique_ptr<World>> World::create(const WorldSettings& settings, Clock clock, unsigned threads) {
  if (Status status = check_settings(settings); !status) return tl::unexpected<Error>(status.error());
  if (threads < 1 || threads > kThreadsMax)
    return failure(ErrorCode::kInvalidValue, "threads", std::to_string(threads), "threads must be between 1 and 64");
  if (settings.precision == Precision::kDouble) return std::make_unique<WorldOf<double>>(settings, clock, threads);
  return std::make_unique<WorldOf<float>>(settings, clock, threads);
}

template <class S>
WorldOf<S>::WorldOf(const WorldSettings& settings, Clock clock, unsigned threads) : clock_(clock) {
  data_.settings = settings;
  data_.team = std::make_shared<Team>(threads);
  update_model(data_);
}

// The step ------------------------------------------------------------------------------------------------------

template <class S>
template <class PhaseFunction>
void WorldOf<S>::run(Phase phase, PhaseFunction&& function) {
  function();
  if (!clock_) return;
  const std::uint64_t now = clock_();
  const double ms = static_cast<double>(now - phase_start_) / kNanosecondsPerMillisecond;
  profile_.ms[static_cast<std::size_t>(phase)] = ms;
  profile_.step_ms += ms;
  phase_start_ = now;
}

template <class S>
void WorldOf<S>::step() {
  profile_ = Profile{};
  if (clock_) phase_start_ = clock_();
  data_.events.erase(data_.events.begin(), data_.events.begin() + static_cast<std::ptrdiff_t>(data_.events_reported));
  data_.joint_events.clear();
  run(Phase::kUpdateBroadPhase, [&] { update_broad_phase(data_); });
  run(Phase::kUpdateContacts, [&] { update_contacts(data_); });
  run(Phase::kSolve, [&] { solve(); });
  run(Phase::kContinuousCollision, [&] {
    if (data_.model.continuous) collide_continuously(data_);
  });
  run(Phase::kUpdateSleep, [&] {
    end_motions(data_);
    report_contact_events(data_);
    if (data_.settings.hit_events) report_hits(data_);
    if (data_.model.joints) break_joints(data_);
    if (data_.model.sleeping) update_sleep(data_);
  });
  data_.team->rest();
  data_.events_reported = data_.events.size();
  ++data_.step_count;
}

template <class S>
void WorldOf<S>::solve() {
  switch (data_.settings.solver) {
    case SolverKind::kSoftStep:
      return solve_soft_step(data_, joint_set_);
    case SolverKind::kThesis:
      return solve_thesis(data_);
    case SolverKind::kPrecise:
      if constexpr (std::is_same_v<S, double>) precise_.solve(data_);
      return;
  }
}

// Bodies --------------------------------------------------------------------------------------------------------

template <class S>
std::uint32_t WorldOf<S>::slot_of(BodyId id) const {
  const std::uint64_t low = id & 0xffffffffu;
  if (low == 0 || low > data_.bodies.size()) return kNone;
  const auto slot = static_cast<std::uint32_t>(low - 1);
  const Body<S>& body = data_.bodies[slot];
  return body.alive() && body.generation == id >> 32 ? slot : kNone;
}

template <class S>
Status WorldOf<S>::check_target(BodyId id, bool dynamic) const {
  const std::uint32_t slot = slot_of(id);
  if (slot == kNone) return failure(ErrorCode::kUnknownBody, "body", std::to_string(id), "there is no such body");
  const BodyType type = data_.bodies[slot].body_type();
  if (dynamic && type != BodyType::kDynamic)
    return failure(ErrorCode::kWrongBodyType, "body", std::to_string(id), "only a dynamic body can be pushed");
  return {};
}

template <class S>
Status WorldOf<S>::check_body(const BodyDef& def) const {
  return check_body_def(def);
}

template <class S>
Expected<BodyId> WorldOf<S>::add_body(const BodyDef& def) {
  if (Status status = check_body_def(def); !status) return tl::unexpected<Error>(status.error());
  if (data_.needs.bodies >= kBodiesMax)
    return failure(ErrorCode::kLimitReached, "body", std::to_string(kBodiesMax), "the world is full");
  return id_of(data_, create_body(data_, def));
}

template <class S>
Status WorldOf<S>::remove_body(BodyId id) {
  if (Status status = check_target(id, false); !status) return status;
  destroy_body(data_, slot_of(id));
  return {};
}

template <class S>
Expected<BodyState> WorldOf<S>::body(BodyId id) const {
  if (Status status = check_target(id, false); !status) return tl::unexpected<Error>(status.error());
  const std::uint32_t slot = slot_of(id);
  const Body<S>& b = data_.bodies[slot];
  const Motion<S>& m = data_.motions[slot];
  const Vec<S> origin = b.origin();
  return BodyState{b.body_type(),   Vec2(double(origin.x()), double(origin.y())),
                   double(b.angle), Vec2(double(m.vx), double(m.vy)),
                   double(m.w),     b.awake()};
}

template <class S>
Expected<MassProperties> WorldOf<S>::mass_properties(BodyId id) const {
  if (Status status = check_target(id, false); !status) return tl::unexpected<Error>(status.error());
  const Body<S>& b = data_.bodies[slot_of(id)];
  return MassProperties{double(b.mass), double(b.inertia), Vec2(double(b.local_x), double(b.local_y))};
}

// Motion --------------------------------------------------------------------------------------------------------

template <class S>
Status WorldOf<S>::apply_impulse(BodyId id, const Vec2& impulse, const Vec2& point) {
  if (Status status = check_target(id, true); !status) return status;
  if (Status status = check_vector("impulse", impulse, kImpulseMax); !status) return status;
  if (Status status = check_vector("point", point, kCoordinateMax); !status) return status;
  const std::uint32_t slot = slot_of(id);
  wake_body(data_, slot);
  const Body<S>& b = data_.bodies[slot];
  Motion<S>& m = data_.motions[slot];
  const Vec<S> p = impulse.cast<S>(), r = point.cast<S>() - b.center();
  m.vx += b.inv_mass * p.x();
  m.vy += b.inv_mass * p.y();
  m.w += b.inv_inertia * cross<S>(r, p);
  saturate(m);
  refresh_places(data_, slot);
  return {};
}

template <class S>
Status WorldOf<S>::apply_impulse_to_center(BodyId id, const Vec2& impulse) {
  if (Status status = check_target(id, true); !status) return status;
  if (Status status = check_vector("impulse", impulse, kImpulseMax); !status) return status;
  const std::uint32_t slot = slot_of(id);
  wake_body(data_, slot);
  data_.motions[slot].vx += data_.bodies[slot].inv_mass * S(impulse.x());
  data_.motions[slot].vy += data_.bodies[slot].inv_mass * S(impulse.y());
  saturate(data_.motions[slot]);
  refresh_places(data_, slot);
  return {};
}

template <class S>
Status WorldOf<S>::apply_angular_impulse(BodyId id, double impulse) {
  if (Status status = check_target(id, true); !status) return status;
  if (Status status = check_bounded("impulse", impulse, kImpulseMax); !status) return status;
  const std::uint32_t slot = slot_of(id);
  wake_body(data_, slot);
  data_.motions[slot].w += data_.bodies[slot].inv_inertia * S(impulse);
  saturate(data_.motions[slot]);
  refresh_places(data_, slot);
  return {};
}

template <class S>
Status WorldOf<S>::set_force(BodyId id, const Vec2& force, double torque, bool in_body_frame) {
  if (Status status = check_target(id, true); !status) return status;
  if (Status status = check_vector("force", force, kForceMax); !status) return status;
  if (Status status = check_bounded("torque", torque, kForceMax); !status) return status;
  const std::uint32_t slot = slot_of(id);
  wake_body(data_, slot);
  Body<S>& b = data_.bodies[slot];
  b.force_x = S(force.x());
  b.force_y = S(force.y());
  b.torque = S(torque);
  const bool any = force != Vec2(0, 0) || torque != 0;
  b.flags &= ~(kBodyHasForce | kBodyForceInBodyFrame);
  b.flags |= (any ? kBodyHasForce : 0u) | (any && in_body_frame ? kBodyForceInBodyFrame : 0u);
  return {};
}

template <class S>
Status WorldOf<S>::set_velocity(BodyId id, const Vec2& velocity, double angular_velocity) {
  if (Status status = check_target(id, false); !status) return status;
  if (Status status = check_vector("velocity", velocity, kSpeedMax); !status) return status;
  if (Status status = check_bounded("angular_velocity", angular_velocity, kAngularSpeedMax); !status) return status;
  const std::uint32_t slot = slot_of(id);
  const Body<S>& b = data_.bodies[slot];
  if (b.body_type() == BodyType::kStatic)
    return failure(ErrorCode::kWrongBodyType, "body", std::to_string(id), "a static body does not move");
  const bool rests = b.body_type() == BodyType::kKinematic && velocity == Vec2(0, 0) && angular_velocity == 0;
  if (rests) {
    put_to_sleep(data_, slot);
    return {};
  }
  wake_body(data_, slot);
  Motion<S>& m = data_.motions[slot];
  m.vx = S(velocity.x());
  m.vy = S(velocity.y());
  m.w = b.flags & kBodyFixedRotation ? S(0) : S(angular_velocity);
  refresh_places(data_, slot);
  return {};
}

template <class S>
Status WorldOf<S>::set_transform(BodyId id, const Vec2& position, double angle) {
  if (Status status = check_target(id, false); !status) return status;
  if (Status status = check_vector("position", position, kCoordinateMax); !status) return status;
  if (Status status = check_bounded("angle", angle, kCoordinateMax); !status) return status;
  const std::uint32_t slot = slot_of(id);
  wake_neighbours(data_, slot);
  Body<S>& b = data_.bodies[slot];
  b.angle = wrap_angle(S(angle));
  sin_cos(b.angle, b.s, b.c);
  const Vec<S> center = position.cast<S>() + b.rotation().apply(b.local_center());
  b.x = center.x();
  b.y = center.y();
  if (b.dynamic()) wake_body(data_, slot);
  reset_bounds(data_, slot);
  return {};
}

template <class S>
Status WorldOf<S>::set_awake(BodyId id, bool awake) {
  if (Status status = check_target(id, true); !status) return status;
  const std::uint32_t slot = slot_of(id);
  if (awake) {
    wake_body(data_, slot);
  } else {
    put_joined_to_sleep(data_, slot);
  }
  return {};
}

// Views ---------------------------------------------------------------------------------------------------------

template <class S>
void WorldOf<S>::capture(BodyColumns& out, bool include_static) const {
  std::vector<double>* const columns[] = {&out.x,          &out.y,          &out.angle,
                                          &out.velocity_x, &out.velocity_y, &out.angular_velocity};
  const auto resize = [&](std::size_t count) {
    out.id.resize(count);
    out.awake.resize(count);
    for (std::vector<double>* column : columns) column->resize(count);
  };
  resize(data_.needs.bodies);
  std::size_t count = 0;
  for (std::uint32_t slot = 0; slot < data_.bodies.size(); ++slot) {
    const Body<S>& b = data_.bodies[slot];
    if (!b.alive() || (b.body_type() == BodyType::kStatic && !include_static)) continue;
    const Motion<S>& m = data_.motions[slot];
    const Vec<S> origin = b.origin();
    out.id[count] = id_of(data_, slot);
    out.x[count] = double(origin.x());
    out.y[count] = double(origin.y());
    out.angle[count] = double(b.angle);
    out.velocity_x[count] = double(m.vx);
    out.velocity_y[count] = double(m.vy);
    out.angular_velocity[count] = double(m.w);
    out.awake[count] = b.awake();
    ++count;
  }
  resize(count);
  sort_by_id(out);
}

template <class S>
std::vector<ContactPoint> WorldOf<S>::contacts() const {
  return contact_points_of(data_);
}

template <class S>
Energy WorldOf<S>::energy() const {
  return energy_of(data_);
}

template <class S>
Counters WorldOf<S>::counters() const {
  Counters out;
  out.bodies = data_.needs.bodies;
  out.awake_bodies = static_cast<std::uint32_t>(data_.awake.size());
  out.shapes = data_.needs.shapes;
  out.joints = data_.needs.joints;
  count_contacts(data_, out);
  return out;
}

template <class S>
std::vector<Feature> WorldOf<S>::model() const {
  return explain_model(data_.settings, data_.needs);
}

// Queries -------------------------------------------------------------------------------------------------------

template <class S>
Expected<std::vector<BodyId>> WorldOf<S>::query_point(const Vec2& point) const {
  if (Status status = check_vector("point", point, kCoordinateMax); !status)
    return tl::unexpected<Error>(status.error());
  return bodies_at(data_, point);
}

template <class S>
Expected<std::vector<BodyId>> WorldOf<S>::query_aabb(const Vec2& lower, const Vec2& upper) const {
  if (Status status = check_vector("lower", lower, kCoordinateMax); !status)
    return tl::unexpected<Error>(status.error());
  if (Status status = check_vector("upper", upper, kCoordinateMax); !status)
    return tl::unexpected<Error>(status.error());
  if (lower.x() > upper.x() || lower.y() > upper.y())
    return failure(ErrorCode::kInvalidValue, "upper", std::to_string(upper.x()) + ", " + std::to_string(upper.y()),
                   "the upper corner must not be below or left of the lower one");
  return bodies_in(data_, lower, upper);
}

template <class S>
Expected<std::vector<RayHit>> WorldOf<S>::query_ray(const Vec2& origin, const Vec2& translation) const {
  if (Status status = check_vector("origin", origin, kCoordinateMax); !status)
    return tl::unexpected<Error>(status.error());
  if (Status status = check_vector("translation", translation, kCoordinateMax); !status)
    return tl::unexpected<Error>(status.error());
  return bodies_along(data_, origin, translation);
}

template <class S>
Expected<std::vector<NearHit>> WorldOf<S>::query_nearest(const Vec2& point, double distance_max,
                                                         std::uint32_t count_max) const {
  if (Status status = check_vector("point", point, kCoordinateMax); !status)
    return tl::unexpected<Error>(status.error());
  if (!(distance_max >= 0 && distance_max <= kCoordinateMax))
    return failure(ErrorCode::kInvalidValue, "distance_max", std::to_string(distance_max),
                   "distance_max must be between 0 and 1e7");
  return bodies_near(data_, point, distance_max, count_max);
}

template <class S>
Expected<QueryHits<CastHit>> WorldOf<S>::query_cast(const QueryShape& shape, const Vec2& translation,
                                                    const QueryOptions& options) const {
  if (Status status = check_cast(shape, translation, options); !status) return tl::unexpected<Error>(status.error());
  return bodies_cast_at(data_, shape, translation, options);
}

template <class S>
Expected<QueryHits<BodyId>> WorldOf<S>::query_overlap(const QueryShape& shape, const QueryOptions& options) const {
  if (Status status = check_overlap(shape, options); !status) return tl::unexpected<Error>(status.error());
  return bodies_overlapping(data_, shape, options);
}

template <class S>
Expected<QueryHits<ClosestHit>> WorldOf<S>::query_closest(const QueryShape& shape, double distance_max,
                                                          const QueryOptions& options) const {
  if (Status status = check_closest(shape, distance_max, options); !status)
    return tl::unexpected<Error>(status.error());
  return bodies_closest_to(data_, shape, distance_max, options);
}

// State ---------------------------------------------------------------------------------------------------------

template <class S>
std::vector<std::byte> WorldOf<S>::save() const {
  return save_state(data_);
}

template <class S>
Status WorldOf<S>::restore(std::span<const std::byte> state) {
  return restore_state(data_, state);
}

template <class S>
std::uint64_t WorldOf<S>::state_hash() const {
  return hash_of_state(save_state(data_));
}

template class WorldOf<float>;
template class WorldOf<double>;

}  // namespace urto

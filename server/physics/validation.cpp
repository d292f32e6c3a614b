#include "physics/validation.h"

#include <cmath>
#include <cstdio>

#include "physics/geometry/polygon.h"
#include "physics/query_shape.h"

namespace urto {
namespace {

constexpr double kAccelerationMax = 1e6;  // m/s²
constexpr double kCoefficientMax = 1e12;  // of damping, stiffness and the like
constexpr double kFrictionMax = 1e3;
constexpr double kMassMax = 1e15;  // kg

std::string text_of(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

Status out_of_range(const std::string& field, double value, const std::string& range) {
  return failure(ErrorCode::kInvalidValue, field, text_of(value), field + " must be " + range);
}

// Collects the first failure of a list of checks.
class Checks {
 public:
  explicit Checks(std::string prefix = "") : prefix_(std::move(prefix)) {}

  // In [low, high].
  Checks& range(const std::string& field, double value, double low, double high) {
    if (status_ && !(value >= low && value <= high))
      status_ = out_of_range(prefix_ + field, value, "between " + text_of(low) + " and " + text_of(high));
    return *this;
  }
  // In (low, high].
  Checks& above(const std::string& field, double value, double low, double high) {
    if (status_ && !(value > low && value <= high))
      status_ = out_of_range(prefix_ + field, value, "above " + text_of(low) + " and at most " + text_of(high));
    return *this;
  }
  Checks& bounded(const std::string& field, double value, double bound) { return range(field, value, -bound, bound); }
  Checks& vector(const std::string& field, const Vec2& value, double bound) {
    return bounded(field + ".x", value.x(), bound).bounded(field + ".y", value.y(), bound);
  }
  Checks& add(const Status& status) {
    if (status_ && !status) {
      Error error = status.error();
      error.field = prefix_ + error.field;
      status_ = tl::unexpected<Error>(error);
    }
    return *this;
  }
  Checks& require(bool condition, ErrorCode code, const std::string& field, const std::string& value,
                  const std::string& message) {
    if (status_ && !condition) status_ = failure(code, prefix_ + field, value, message);
    return *this;
  }
  Status result() const { return status_; }

 private:
  std::string prefix_;
  Status status_;
};

Status check_geometry(const Geometry& geometry) {
  if (const auto* box = std::get_if<Box>(&geometry)) {
    return Checks("box.")
        .range("width", box->width, kSizeMin, kSizeMax)
        .range("height", box->height, kSizeMin, kSizeMax)
        .vector("center", box->center, kSizeMax)
        .bounded("angle", box->angle, kCoordinateMax)
        .range("radius", box->radius, 0, kSizeMax)
        .result();
  }
  if (const auto* circle = std::get_if<Circle>(&geometry)) {
    return Checks("circle.")
        .range("radius", circle->radius, kSizeMin, kSizeMax)
        .vector("center", circle->center, kSizeMax)
        .result();
  }
  if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
    return Checks("capsule.")
        .range("radius", capsule->radius, kSizeMin, kSizeMax)
        .vector("a", capsule->a, kSizeMax)
        .vector("b", capsule->b, kSizeMax)
        .require((capsule->b - capsule->a).norm() >= kSizeMin, ErrorCode::kDegenerateShape, "b",
                 text_of((capsule->b - capsule->a).norm()),
                 "a and b must be at least " + text_of(kSizeMin) + " m apart")
        .result();
  }
  if (const auto* chain = std::get_if<Chain>(&geometry))
    return Checks("chain.").add(check_chain(chain->vertices, chain->loop)).result();
  const auto& polygon = std::get<Polygon>(geometry);
  const auto parts = decompose_polygon(polygon.vertices);
  Checks checks("polygon.");
  if (!parts) return checks.add(tl::unexpected<Error>(parts.error())).result();
  return checks.range("radius", polygon.radius, 0, kSizeMax)
      .require(polygon.radius == 0 || parts->size() == 1, ErrorCode::kInvalidValue, "radius", text_of(polygon.radius),
               "a rounded polygon must be convex and have at most " + std::to_string(kPolygonVerticesMax) + " vertices")
      .result();
}

Status check_query_geometry(const QueryGeometry& geometry) {
  if (const auto* polygon = std::get_if<Polygon>(&geometry)) {
    if (Status status = check_geometry(*polygon); !status) return status;
    const std::size_t parts = decompose_polygon(polygon->vertices)->size();
    return Checks("polygon.")
        .require(parts == 1, ErrorCode::kInvalidValue, "vertices", std::to_string(polygon->vertices.size()),
                 "a polygon that queries must be convex and have at most " + std::to_string(kPolygonVerticesMax) +
                     " vertices")
        .result();
  }
  if (const auto* box = std::get_if<Box>(&geometry)) return check_geometry(*box);
  if (const auto* circle = std::get_if<Circle>(&geometry)) return check_geometry(*circle);
  if (const auto* capsule = std::get_if<Capsule>(&geometry)) return check_geometry(*capsule);
  return {};
}

Status check_options(const QueryOptions& options) {
  return Checks().range("count_max", options.count_max, 1, kQueryHitsMax).result();
}

Status check_limits(const std::optional<JointLimits>& limits, double low, double high) {
  if (!limits) return {};
  return Checks("limits.")
      .range("lower", limits->lower, low, high)
      .range("upper", limits->upper, limits->lower, high)
      .result();
}

Status check_spring(const char* field, const std::optional<JointSpring>& spring) {
  if (!spring) return {};
  return Checks(std::string(field) + ".")
      .above("hertz", spring->hertz, 0, kJointHertzMax)
      .range("damping_ratio", spring->damping_ratio, 0, kDampingRatioMax)
      .result();
}

Status check_optional_motor(const std::optional<JointMotor>& motor) { return motor ? check_motor(*motor) : Status(); }

Status check_reference(const std::optional<double>& angle) {
  return angle ? check_bounded("reference_angle", *angle, kJointAngleMax) : Status();
}

Status check_kind(const RevoluteJoint& joint) {
  return Checks("revolute.")
      .add(check_reference(joint.reference_angle))
      .add(check_limits(joint.limits, -kJointAngleMax, kJointAngleMax))
      .add(check_optional_motor(joint.motor))
      .add(check_spring("spring", joint.spring))
      .result();
}

Status check_kind(const DistanceJoint& joint) {
  Checks checks("distance.");
  if (joint.length) checks.range("length", *joint.length, 0, kCoordinateMax);
  return checks.add(check_limits(joint.limits, 0, kCoordinateMax)).add(check_spring("spring", joint.spring)).result();
}

Status check_kind(const PrismaticJoint& joint) {
  return Checks("prismatic.")
      .vector("axis", joint.axis, kCoordinateMax)
      .above("axis", joint.axis.squaredNorm(), 0, 2 * kCoordinateMax * kCoordinateMax)
      .add(check_reference(joint.reference_angle))
      .add(check_limits(joint.limits, -kCoordinateMax, kCoordinateMax))
      .add(check_optional_motor(joint.motor))
      .add(check_spring("spring", joint.spring))
      .result();
}

Status check_kind(const WeldJoint& joint) {
  return Checks("weld.")
      .add(check_reference(joint.reference_angle))
      .add(check_spring("linear", joint.linear))
      .add(check_spring("angular", joint.angular))
      .result();
}

Status check_kind(const MouseJoint& joint) {
  return Checks("mouse.")
      .vector("target", joint.target, kCoordinateMax)
      .add(check_spring("spring", joint.spring))
      .range("force_max", joint.force_max, 0, kJointForceMax)
      .result();
}

Status check_shape(const ShapeDef& shape) {
  return Checks()
      .add(check_geometry(shape.geometry))
      .above("density", shape.material.density, 0, kDensityMax)
      .range("friction", shape.material.friction, 0, kFrictionMax)
      .range("restitution", shape.material.restitution, 0, 1)
      .result();
}

Status check_field(const ForceField& field) {
  if (const auto* a = std::get_if<PointAttractor>(&field)) {
    return Checks("point_attractor.")
        .vector("center", a->center, kCoordinateMax)
        .bounded("strength", a->strength, kCoefficientMax)
        .range("softening", a->softening, 0, kCoordinateMax)
        .result();
  }
  if (const auto* d = std::get_if<Drag>(&field)) {
    return Checks("drag.")
        .range("linear", d->linear, 0, kCoefficientMax)
        .range("quadratic", d->quadratic, 0, kCoefficientMax)
        .result();
  }
  const auto& s = std::get<Spring>(field);
  return Checks("spring.")
      .vector("center", s.center, kCoordinateMax)
      .range("stiffness", s.stiffness, 0, kCoefficientMax)
      .range("damping", s.damping, 0, kCoefficientMax)
      .result();
}

std::string indexed(const char* name, std::size_t i) { return std::string(name) + "[" + std::to_string(i) + "]."; }

Status check_motion_of_static(const BodyDef& def) {
  if (def.type != BodyType::kStatic) return {};
  return Checks()
      .require(def.velocity == Vec2(0, 0), ErrorCode::kInvalidValue, "velocity", text_of(def.velocity.norm()),
               "a static body has no velocity")
      .require(def.angular_velocity == 0, ErrorCode::kInvalidValue, "angular_velocity", text_of(def.angular_velocity),
               "a static body has no angular velocity")
      .result();
}

Status check_mass(const BodyDef& def) {
  bool solid = false, chain = false;
  for (const ShapeDef& shape : def.shapes) {
    solid |= !shape.sensor;
    chain |= std::holds_alternative<Chain>(shape.geometry);
  }
  Checks checks;
  checks.require(def.type != BodyType::kDynamic || !chain, ErrorCode::kWrongBodyType, "shapes",
                 std::to_string(def.shapes.size()), "a chain has no mass: a dynamic body can have none");
  checks.require(def.type != BodyType::kDynamic || solid, ErrorCode::kInvalidValue, "shapes",
                 std::to_string(def.shapes.size()), "a dynamic body needs a shape that is not a sensor");
  if (def.mass) {
    checks.above("mass", *def.mass, 0, kMassMax);
    checks.require(def.type == BodyType::kDynamic, ErrorCode::kWrongBodyType, "mass", text_of(*def.mass),
                   "only a dynamic body has a mass");
  }
  return checks.result();
}

}  // namespace

Status check_bounded(const char* field, double value, double bound) {
  return Checks().bounded(field, value, bound).result();
}

Status check_vector(const char* field, const Vec2& value, double bound) {
  return Checks().vector(field, value, bound).result();
}

Status check_query_shape(const QueryShape& shape) {
  return Checks("shape.")
      .add(check_query_geometry(shape.geometry))
      .vector("position", shape.position, kCoordinateMax)
      .bounded("angle", shape.angle, kCoordinateMax)
      .result();
}

Status check_cast(const QueryShape& shape, const Vec2& translation, const QueryOptions& options) {
  return Checks()
      .add(check_query_shape(shape))
      .vector("translation", translation, kCoordinateMax)
      .add(check_options(options))
      .result();
}

Status check_overlap(const QueryShape& shape, const QueryOptions& options) {
  return Checks().add(check_query_shape(shape)).add(check_options(options)).result();
}

Status check_closest(const QueryShape& shape, double distance_max, const QueryOptions& options) {
  return Checks()
      .add(check_query_shape(shape))
      .range("distance_max", distance_max, 0, kCoordinateMax)
      .add(check_options(options))
      .result();
}

Status check_settings(const WorldSettings& s) {
  Checks checks;
  checks.vector("gravity", s.gravity, kAccelerationMax)
      .above("time_step", s.time_step, 0, kTimeStepMax)
      .range("sub_steps", s.sub_steps, 1, kSubStepsMax)
      .range("restitution_threshold", s.restitution_threshold, 0, kSpeedMax)
      .require(s.solver != SolverKind::kPrecise || s.precision == Precision::kDouble, ErrorCode::kInvalidValue,
               "solver", "precise", "the precise solver needs double precision")
      .require(s.solver != SolverKind::kThesis || !s.hit_events, ErrorCode::kNotSupported, "hit_events", "thesis",
               "the thesis's solver cannot tell hits")
      .range("hit_events.speed_min", s.hit_events ? s.hit_events->speed_min : 0, 0, kSpeedMax)
      .require(s.fields.size() <= kForceFieldsMax, ErrorCode::kLimitReached, "fields", std::to_string(s.fields.size()),
               "too many force fields");
  for (std::size_t i = 0; i < s.fields.size(); ++i)
    checks.add(Checks(indexed("fields", i)).add(check_field(s.fields[i])).result());
  return checks.result();
}

Status check_body_def(const BodyDef& def) {
  Checks checks;
  checks.vector("position", def.position, kCoordinateMax)
      .bounded("angle", def.angle, kCoordinateMax)
      .vector("velocity", def.velocity, kSpeedMax)
      .bounded("angular_velocity", def.angular_velocity, kAngularSpeedMax)
      .range("linear_damping", def.linear_damping, 0, kCoefficientMax)
      .range("angular_damping", def.angular_damping, 0, kCoefficientMax)
      .bounded("gravity_scale", def.gravity_scale, kAccelerationMax)
      .require(!def.shapes.empty(), ErrorCode::kInvalidValue, "shapes", "0", "a body needs at least one shape")
      .require(def.shapes.size() <= kShapesPerBodyMax, ErrorCode::kLimitReached, "shapes",
               std::to_string(def.shapes.size()), "a body has at most " + std::to_string(kShapesPerBodyMax) + " shapes")
      .add(check_motion_of_static(def))
      .add(check_mass(def));
  for (std::size_t i = 0; i < def.shapes.size(); ++i)
    checks.add(Checks(indexed("shapes", i)).add(check_shape(def.shapes[i])).result());
  return checks.result();
}

Status check_motor(const JointMotor& motor) {
  return Checks("motor.")
      .bounded("speed", motor.speed, kSpeedMax)
      .range("bound", motor.bound, 0, kJointForceMax)
      .result();
}

Status check_joint_def(const JointDef& def) {
  return Checks()
      .vector("anchor_a", def.anchor_a, kCoordinateMax)
      .vector("anchor_b", def.anchor_b, kCoordinateMax)
      .above("break_force", def.break_force, 0, kUnbreakable)
      .above("break_torque", def.break_torque, 0, kUnbreakable)
      .add(std::visit([](const auto& joint) { return check_kind(joint); }, def.geometry))
      .result();
}

}  // namespace urto

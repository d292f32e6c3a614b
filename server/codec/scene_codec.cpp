#include "codec/scene_codec.h"

#include <type_traits>
#include <utility>
#include <variant>

#include "codec/joint_codec.h"

namespace urto::codec {
namespace {

// The schema's enums are the engine's with UNSPECIFIED put before them.
template <class E, class P>
E enum_from_proto(P value, E unspecified) {
  return value == P(0) ? unspecified : static_cast<E>(static_cast<int>(value) - 1);
}

template <class P, class E>
P enum_to_proto(E value) {
  return static_cast<P>(static_cast<int>(value) + 1);
}

static_assert(v1::PRECISION_DOUBLE == static_cast<int>(Precision::kDouble) + 1);
static_assert(v1::NARROW_PHASE_GJK == static_cast<int>(NarrowPhaseKind::kGjk) + 1);
static_assert(v1::SOLVER_THESIS == static_cast<int>(SolverKind::kThesis) + 1);
static_assert(v1::SOLVER_PRECISE == static_cast<int>(SolverKind::kPrecise) + 1);
static_assert(v1::INTEGRATOR_SEMI_IMPLICIT_EULER == static_cast<int>(Integrator::kSemiImplicitEuler) + 1);
static_assert(v1::INTEGRATOR_EXPLICIT_EULER == static_cast<int>(Integrator::kExplicitEuler) + 1);
static_assert(v1::INTEGRATOR_VERLET == static_cast<int>(Integrator::kVerlet) + 1);
static_assert(v1::INTEGRATOR_RUNGE_KUTTA_4 == static_cast<int>(Integrator::kRungeKutta4) + 1);
static_assert(v1::MIXING_GEOMETRIC_MEAN == static_cast<int>(Mixing::kGeometricMean) + 1);
static_assert(v1::MIXING_MAXIMUM == static_cast<int>(Mixing::kMaximum) + 1);
static_assert(v1::MIXING_MINIMUM == static_cast<int>(Mixing::kMinimum) + 1);
static_assert(v1::MIXING_AVERAGE == static_cast<int>(Mixing::kAverage) + 1);
static_assert(v1::BODY_TYPE_STATIC == static_cast<int>(BodyType::kStatic) + 1);
static_assert(v1::BODY_TYPE_KINEMATIC == static_cast<int>(BodyType::kKinematic) + 1);
static_assert(v1::BODY_TYPE_DYNAMIC == static_cast<int>(BodyType::kDynamic) + 1);
// But for the broad phase, where unspecified is the engine's own kAuto.
static_assert(v1::BROAD_PHASE_UNSPECIFIED == static_cast<int>(BroadPhaseKind::kAuto));
static_assert(v1::BROAD_PHASE_BRUTE_FORCE == static_cast<int>(BroadPhaseKind::kBruteForce));
static_assert(v1::BROAD_PHASE_QUADTREE == static_cast<int>(BroadPhaseKind::kQuadtree));
static_assert(v1::BROAD_PHASE_BVH == static_cast<int>(BroadPhaseKind::kBvh));

std::vector<Vec2> vertices_from_proto(const google::protobuf::RepeatedPtrField<v1::Vector>& messages) {
  std::vector<Vec2> vertices;
  vertices.reserve(static_cast<std::size_t>(messages.size()));
  for (const v1::Vector& vertex : messages) vertices.push_back(vector_from_proto(vertex));
  return vertices;
}

Box box_from_proto(const v1::Box& message) {
  return {message.width(), message.height(), vector_from_proto(message.center()), message.angle(), message.radius()};
}
Circle circle_from_proto(const v1::Circle& message) { return {message.radius(), vector_from_proto(message.center())}; }
Polygon polygon_from_proto(const v1::Polygon& message) {
  return {vertices_from_proto(message.vertices()), message.radius()};
}
Capsule capsule_from_proto(const v1::Capsule& message) {
  return {vector_from_proto(message.a()), vector_from_proto(message.b()), message.radius()};
}

Geometry geometry_from_proto(const v1::Shape& message) {
  switch (message.geometry_case()) {
    case v1::Shape::kBox:
      return box_from_proto(message.box());
    case v1::Shape::kCircle:
      return circle_from_proto(message.circle());
    case v1::Shape::kPolygon:
      return polygon_from_proto(message.polygon());
    case v1::Shape::kCapsule:
      return capsule_from_proto(message.capsule());
    case v1::Shape::kChain:
      return Chain{vertices_from_proto(message.chain().vertices()), message.chain().loop()};
    case v1::Shape::GEOMETRY_NOT_SET:
      break;  // check_message() lets none pass
  }
  return Polygon{};
}

QueryGeometry query_geometry_from_proto(const v1::QueryShape& message) {
  switch (message.geometry_case()) {
    case v1::QueryShape::kBox:
      return box_from_proto(message.box());
    case v1::QueryShape::kCircle:
      return circle_from_proto(message.circle());
    case v1::QueryShape::kPolygon:
      return polygon_from_proto(message.polygon());
    case v1::QueryShape::kCapsule:
      return capsule_from_proto(message.capsule());
    case v1::QueryShape::kPoint:
    case v1::QueryShape::GEOMETRY_NOT_SET:  // check_message() lets none pass
      break;
  }
  return PointGeometry{};
}

ShapeDef shape_from_proto(const v1::Shape& message) {
  ShapeDef shape;
  shape.geometry = geometry_from_proto(message);
  if (message.has_density()) shape.material.density = message.density();
  if (message.has_friction()) shape.material.friction = message.friction();
  shape.material.restitution = message.restitution();
  if (message.has_category()) shape.filter.category = message.category();
  if (message.has_mask()) shape.filter.mask = message.mask();
  shape.sensor = message.sensor();
  return shape;
}

ForceField field_from_proto(const v1::ForceField& message) {
  switch (message.field_case()) {
    case v1::ForceField::kPointAttractor:
      return PointAttractor{vector_from_proto(message.point_attractor().center()), message.point_attractor().strength(),
                            message.point_attractor().softening()};
    case v1::ForceField::kDrag:
      return Drag{message.drag().linear(), message.drag().quadratic()};
    case v1::ForceField::kSpring:
      return Spring{vector_from_proto(message.spring().center()), message.spring().stiffness(),
                    message.spring().damping()};
    case v1::ForceField::FIELD_NOT_SET:
      break;  // check_message() lets none pass
  }
  return Drag{};
}

WorldSettings settings_from_proto(const v1::WorldSettings& message) {
  WorldSettings settings;
  settings.precision = enum_from_proto(message.precision(), settings.precision);
  if (message.has_gravity()) settings.gravity = vector_from_proto(message.gravity());
  if (message.has_time_step()) settings.time_step = message.time_step();
  if (message.has_sub_steps()) settings.sub_steps = message.sub_steps();
  settings.solver = enum_from_proto(message.solver(), settings.solver);
  settings.integrator = enum_from_proto(message.integrator(), settings.integrator);
  settings.broad_phase = static_cast<BroadPhaseKind>(message.broad_phase());
  settings.narrow_phase = enum_from_proto(message.narrow_phase(), settings.narrow_phase);
  if (message.has_sleeping()) settings.sleeping = message.sleeping();
  if (message.has_continuous()) settings.continuous = message.continuous();
  settings.friction_mixing = enum_from_proto(message.friction_mixing(), settings.friction_mixing);
  settings.restitution_mixing = enum_from_proto(message.restitution_mixing(), settings.restitution_mixing);
  if (message.has_restitution_threshold()) settings.restitution_threshold = message.restitution_threshold();
  if (message.has_hit_events()) {
    settings.hit_events.emplace();
    if (message.hit_events().has_speed_min()) settings.hit_events->speed_min = message.hit_events().speed_min();
  }
  return settings;
}

void write_settings(const WorldSettings& settings, v1::WorldSettings* out) {
  out->set_precision(enum_to_proto<v1::Precision>(settings.precision));
  write_vector(settings.gravity, out->mutable_gravity());
  out->set_time_step(settings.time_step);
  out->set_sub_steps(settings.sub_steps);
  out->set_solver(enum_to_proto<v1::Solver>(settings.solver));
  out->set_integrator(enum_to_proto<v1::Integrator>(settings.integrator));
  out->set_broad_phase(static_cast<v1::BroadPhase>(settings.broad_phase));
  out->set_narrow_phase(enum_to_proto<v1::NarrowPhase>(settings.narrow_phase));
  out->set_sleeping(settings.sleeping);
  out->set_continuous(settings.continuous);
  out->set_friction_mixing(enum_to_proto<v1::Mixing>(settings.friction_mixing));
  out->set_restitution_mixing(enum_to_proto<v1::Mixing>(settings.restitution_mixing));
  out->set_restitution_threshold(settings.restitution_threshold);
  if (settings.hit_events) out->mutable_hit_events()->set_speed_min(settings.hit_events->speed_min);
}

struct GeometryWriter {
  v1::Shape* out;

  void operator()(const Box& box) const {
    out->mutable_box()->set_width(box.width);
    out->mutable_box()->set_height(box.height);
    write_vector(box.center, out->mutable_box()->mutable_center());
    out->mutable_box()->set_angle(box.angle);
    out->mutable_box()->set_radius(box.radius);
  }
  void operator()(const Circle& circle) const {
    out->mutable_circle()->set_radius(circle.radius);
    write_vector(circle.center, out->mutable_circle()->mutable_center());
  }
  void operator()(const Polygon& polygon) const {
    auto* message = out->mutable_polygon();
    for (const Vec2& vertex : polygon.vertices) write_vector(vertex, message->add_vertices());
    message->set_radius(polygon.radius);
  }
  void operator()(const Capsule& capsule) const {
    write_vector(capsule.a, out->mutable_capsule()->mutable_a());
    write_vector(capsule.b, out->mutable_capsule()->mutable_b());
    out->mutable_capsule()->set_radius(capsule.radius);
  }
  void operator()(const Chain& chain) const {
    auto* message = out->mutable_chain();
    for (const Vec2& vertex : chain.vertices) write_vector(vertex, message->add_vertices());
    message->set_loop(chain.loop);
  }
};

void write_shape(const ShapeDef& shape, v1::Shape* out) {
  std::visit(GeometryWriter{out}, shape.geometry);
  out->set_density(shape.material.density);
  out->set_friction(shape.material.friction);
  out->set_restitution(shape.material.restitution);
  out->set_category(shape.filter.category);
  out->set_mask(shape.filter.mask);
  out->set_sensor(shape.sensor);
}

struct FieldWriter {
  v1::ForceField* out;

  void operator()(const PointAttractor& field) const {
    write_vector(field.center, out->mutable_point_attractor()->mutable_center());
    out->mutable_point_attractor()->set_strength(field.strength);
    out->mutable_point_attractor()->set_softening(field.softening);
  }
  void operator()(const Drag& field) const {
    out->mutable_drag()->set_linear(field.linear);
    out->mutable_drag()->set_quadratic(field.quadratic);
  }
  void operator()(const Spring& field) const {
    write_vector(field.center, out->mutable_spring()->mutable_center());
    out->mutable_spring()->set_stiffness(field.stiffness);
    out->mutable_spring()->set_damping(field.damping);
  }
};

}  // namespace

Vec2 vector_from_proto(const v1::Vector& message) { return {message.x(), message.y()}; }

QueryShape query_shape_from_proto(const v1::QueryShape& message) {
  return {query_geometry_from_proto(message), vector_from_proto(message.position()), message.angle()};
}

BodySpec body_from_proto(const v1::Body& message) {
  BodySpec body;
  body.name = message.name();
  body.tags.assign(message.tags().begin(), message.tags().end());
  body.def.type = enum_from_proto(message.type(), BodyType::kDynamic);
  body.def.position = vector_from_proto(message.position());
  body.def.angle = message.angle();
  body.def.velocity = vector_from_proto(message.velocity());
  body.def.angular_velocity = message.angular_velocity();
  for (const auto& shape : message.shapes()) body.def.shapes.push_back(shape_from_proto(shape));
  if (message.has_mass()) body.def.mass = message.mass();
  body.def.linear_damping = message.linear_damping();
  body.def.angular_damping = message.angular_damping();
  if (message.has_gravity_scale()) body.def.gravity_scale = message.gravity_scale();
  body.def.fixed_rotation = message.fixed_rotation();
  if (message.has_awake()) body.def.awake = message.awake();
  if (message.has_color()) body.color = message.color();
  return body;
}

SceneDef scene_from_proto(const v1::Scene& message) {
  SceneDef scene;
  scene.name = message.name();
  scene.description = message.description();
  scene.world = settings_from_proto(message.world());
  for (const auto& field : message.fields()) scene.world.fields.push_back(field_from_proto(field));
  for (const auto& body : message.bodies()) scene.bodies.push_back(body_from_proto(body));
  for (const auto& joint : message.joints()) scene.joints.push_back(joint_from_proto(joint));
  if (message.has_view()) {
    scene.view = View{vector_from_proto(message.view().lower()), vector_from_proto(message.view().upper())};
  }
  return scene;
}

void write_vector(const Vec2& vector, v1::Vector* out) {
  out->set_x(vector.x());
  out->set_y(vector.y());
}

void write_body(const BodySpec& body, v1::Body* out) {
  if (!body.name.empty()) out->set_name(body.name);
  for (const std::string& tag : body.tags) out->add_tags(tag);
  out->set_type(enum_to_proto<v1::BodyType>(body.def.type));
  write_vector(body.def.position, out->mutable_position());
  out->set_angle(body.def.angle);
  write_vector(body.def.velocity, out->mutable_velocity());
  out->set_angular_velocity(body.def.angular_velocity);
  for (const ShapeDef& shape : body.def.shapes) write_shape(shape, out->add_shapes());
  if (body.def.mass) out->set_mass(*body.def.mass);
  out->set_linear_damping(body.def.linear_damping);
  out->set_angular_damping(body.def.angular_damping);
  out->set_gravity_scale(body.def.gravity_scale);
  out->set_fixed_rotation(body.def.fixed_rotation);
  out->set_awake(body.def.awake);
  if (body.color) out->set_color(*body.color);
}

void write_scene_without_bodies(const SceneDef& scene, v1::Scene* out) {
  out->set_name(scene.name);
  out->set_description(scene.description);
  write_settings(scene.world, out->mutable_world());
  for (const ForceField& field : scene.world.fields) std::visit(FieldWriter{out->add_fields()}, field);
  if (scene.view) {
    write_vector(scene.view->lower, out->mutable_view()->mutable_lower());
    write_vector(scene.view->upper, out->mutable_view()->mutable_upper());
  }
}

void write_scene(const SceneDef& scene, v1::Scene* out) {
  write_scene_without_bodies(scene, out);
  for (const BodySpec& body : scene.bodies) write_body(body, out->add_bodies());
  for (const JointSpec& joint : scene.joints) write_joint(joint, out->add_joints());
}

v1::Precision precision_to_proto(Precision precision) { return enum_to_proto<v1::Precision>(precision); }

}  // namespace urto::codec

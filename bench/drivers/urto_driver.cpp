// Runs a scene in Urto through its public API.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "physics/world.h"
#include "report.h"
#include "scene_file.h"

namespace bench {
namespace {

urto::Vec2 vec(const Point& point) { return {point[0], point[1]}; }

template <class T>
T expect(urto::Expected<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "%s (%s = %s)\n", result.error().message.c_str(), result.error().field.c_str(),
               result.error().value.c_str());
  std::exit(1);
}

urto::ShapeDef shape_def(const Shape& shape, bool apart) {
  urto::ShapeDef def;
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    urto::Box made;
    made.width = 2 * box->half[0];
    made.height = 2 * box->half[1];
    made.center = vec(box->center);
    def.geometry = made;
  } else if (const auto* circle = std::get_if<Circle>(&shape.geometry)) {
    def.geometry = urto::Circle{circle->radius, vec(circle->center)};
  } else if (const auto* polygon = std::get_if<Polygon>(&shape.geometry)) {
    urto::Polygon made;
    for (const Point& point : polygon->points) made.vertices.push_back(vec(point));
    def.geometry = made;
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.geometry)) {
    def.geometry = urto::Capsule{vec(capsule->a), vec(capsule->b), capsule->radius};
  } else if (const auto* rounded = std::get_if<RoundedBox>(&shape.geometry)) {
    urto::Box made;
    made.width = 2 * rounded->half[0];
    made.height = 2 * rounded->half[1];
    made.radius = rounded->rounding;
    def.geometry = made;
  } else {
    urto::Chain made;
    made.loop = true;
    for (const Point& point : std::get<Loop>(shape.geometry).points) made.vertices.push_back(vec(point));
    def.geometry = made;
  }
  def.material.density = shape.material.density;
  def.material.friction = shape.material.friction;
  def.material.restitution = shape.material.restitution;
  if (apart) def.filter = {2, ~2u};
  return def;
}

urto::BodyId add_body(urto::World& world, const Body& body) {
  urto::BodyDef def;
  def.type = body.kind == BodyKind::kDynamic     ? urto::BodyType::kDynamic
             : body.kind == BodyKind::kKinematic ? urto::BodyType::kKinematic
                                                 : urto::BodyType::kStatic;
  def.position = vec(body.position);
  def.angle = body.angle;
  def.velocity = vec(body.velocity);
  def.angular_velocity = body.spin;
  def.awake = body.awake;
  for (const Shape& shape : body.shapes) def.shapes.push_back(shape_def(shape, body.apart));
  if (def.shapes.empty()) {  // a mere anchor of joints: Urto's bodies have a shape, so it gets one that meets nothing
    urto::ShapeDef anchor;
    anchor.geometry = urto::Circle{0.1};
    anchor.filter = {0, 0};
    def.shapes.push_back(anchor);
  }
  return expect(world.add_body(def));
}

void add_revolute(urto::World& world, const Scene& scene, const std::vector<urto::BodyId>& bodies,
                  const Revolute& joint) {
  const auto moves = [&](int body) { return scene.bodies[static_cast<std::size_t>(body)].kind == BodyKind::kDynamic; };
  if (!moves(joint.a) && !moves(joint.b)) return;  // it would do nothing, and Urto refuses it
  urto::JointDef def;
  def.body_a = bodies[static_cast<std::size_t>(joint.a)];
  def.body_b = bodies[static_cast<std::size_t>(joint.b)];
  def.anchor_a = vec(joint.at_a);
  def.anchor_b = vec(joint.at_b);
  urto::RevoluteJoint revolute;
  if (joint.motor_torque > 0)
    revolute.motor = urto::JointMotor{true, joint.motor_speed, std::min(joint.motor_torque, urto::kJointForceMax)};
  def.geometry = revolute;
  expect(world.add_joint(def));
}

std::uint64_t nanoseconds() {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
          .count());
}

void run(const Arguments& arguments) {
  const Scene scene = read_scene(arguments.scene_path);
  const int steps = arguments.steps > 0 ? arguments.steps : scene.steps;
  urto::WorldSettings settings;
  settings.gravity = vec(scene.gravity);
  settings.time_step = kTimeStep;
  settings.sub_steps = kSubSteps;
  settings.sleeping = scene.sleep;
  const auto world = expect(urto::World::create(settings, nanoseconds, static_cast<unsigned>(arguments.threads)));
  std::vector<urto::BodyId> bodies;
  for (const Body& body : scene.bodies) bodies.push_back(add_body(*world, body));
  for (const Revolute& joint : scene.revolutes) add_revolute(*world, scene, bodies, joint);

  constexpr auto kPhases = static_cast<std::size_t>(urto::Phase::kCount);
  double phase_sums[kPhases] = {};
  Report report;
  for (int step = 0; step < steps; ++step) {
    for (const Sway& sway : scene.sways) {
      const auto set = world->set_velocity(bodies[static_cast<std::size_t>(sway.body)],
                                           {sway.velocity_before(step, kTimeStep), 0}, 0);
      if (!set) std::exit(1);
    }
    time_step(report, [&] { world->step(); });
    const urto::Profile profile = world->profile();
    for (std::size_t phase = 0; phase < kPhases; ++phase) phase_sums[phase] += profile.ms[phase];
  }
  report.engine = "urto";
  report.threads = arguments.threads;
  report.version = BENCH_URTO_VERSION;
  report.scene = scene.name;
  for (const Body& body : scene.bodies) report.bodies += body.kind == BodyKind::kDynamic ? 1 : 0;
  report.pairs = world->counters().pairs;
  report.touching = world->counters().contacts;
  report.hash = hexadecimal(world->state_hash());
  for (std::size_t phase = 0; phase < kPhases; ++phase) {
    report.phases_ms.emplace_back(urto::phase_name(static_cast<urto::Phase>(phase)), phase_sums[phase] / steps);
  }
  for (std::size_t i = 0; arguments.states && i < bodies.size(); ++i) {
    const urto::BodyState at = expect(world->body(bodies[i]));
    report.states.push_back(
        {at.position.x(), at.position.y(), at.angle, at.velocity.x(), at.velocity.y(), at.angular_velocity});
  }
  report.print();
}

}  // namespace
}  // namespace bench

int main(int count, char** values) { bench::run(bench::parse_arguments(count, values)); }

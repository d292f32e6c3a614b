// Runs a scene in Urto through its public API.
#include <algorithm>
#include <cstdlib>

#include "report.h"
#include "urto_scene.h"

namespace bench {
namespace {

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

// Before a step: the velocity of what moves by itself.
void sway(urto::World& world, const Scene& scene, const std::vector<urto::BodyId>& bodies, int step) {
  for (const Sway& each : scene.sways) {
    const urto::Vec2 velocity(each.velocity_before(step, kTimeStep), 0);
    if (!world.set_velocity(bodies[static_cast<std::size_t>(each.body)], velocity, 0)) std::exit(1);
  }
}

void run(const Arguments& arguments) {
  const Scene scene = read_scene(arguments.scene_path);
  const int steps = arguments.steps > 0 ? arguments.steps : scene.steps;
  Report report;
  report.simd = choose_simd(arguments.simd);
  report.step_ms.reserve(static_cast<std::size_t>(steps));
  std::vector<urto::BodyId> bodies;
  bodies.reserve(scene.bodies.size());
  const std::uint64_t heap_before = heap_bytes();
  const auto world =
      expect(urto::World::create(world_settings(scene), nanoseconds, static_cast<unsigned>(arguments.threads)));
  for (const Body& body : scene.bodies) bodies.push_back(expect(world->add_body(body_def(body))));
  for (const Revolute& joint : scene.revolutes) add_revolute(*world, scene, bodies, joint);
  report.heap_built = heap_bytes() - heap_before;

  constexpr auto kPhases = static_cast<std::size_t>(urto::Phase::kCount);
  double phase_sums[kPhases] = {};
  for (int step = 0; step < arguments.skip; ++step) {
    sway(*world, scene, bodies, step);
    world->step();
  }
  start_counting_instructions();
  for (int step = 0; step < steps; ++step) {
    sway(*world, scene, bodies, arguments.skip + step);
    time_step(report, [&] { world->step(); });
    const urto::Profile profile = world->profile();
    for (std::size_t phase = 0; phase < kPhases; ++phase) phase_sums[phase] += profile.ms[phase];
  }
  stop_counting_instructions();
  report.heap_stepped = heap_bytes() - heap_before;
  report.engine = "urto";
  report.threads = arguments.threads;
  report.version = BENCH_URTO_VERSION;
  report.scene = scene.name;
  for (const Body& body : scene.bodies) report.bodies += body.kind == BodyKind::kDynamic ? 1 : 0;
  report.awake = world->counters().awake_bodies;
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

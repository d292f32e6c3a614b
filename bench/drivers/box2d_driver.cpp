// Runs a scene in Box2D v3 with its defaults.
#include <box2d/box2d.h>

#include <cstdio>
#include <vector>

#include "report.h"
#include "scene_file.h"

namespace bench {
namespace {

b2Vec2 vec(const Point& point) { return {static_cast<float>(point[0]), static_cast<float>(point[1])}; }

void add_loop(b2BodyId body, const Loop& loop, const Material& material) {
  std::vector<b2Vec2> points;
  for (const Point& point : loop.points) points.push_back(vec(point));
  b2SurfaceMaterial surface = b2DefaultSurfaceMaterial();
  surface.friction = static_cast<float>(material.friction);
  b2ChainDef def = b2DefaultChainDef();
  def.points = points.data();
  def.count = static_cast<int>(points.size());
  def.isLoop = true;
  def.materials = &surface;
  def.materialCount = 1;
  b2CreateChain(body, &def);
}

void add_polygon(b2BodyId body, const Polygon& polygon, const b2ShapeDef& def) {
  std::vector<b2Vec2> points;
  for (const Point& point : polygon.points) points.push_back(vec(point));
  const b2Hull hull = b2ComputeHull(points.data(), static_cast<int>(points.size()));
  const b2Polygon made = b2MakePolygon(&hull, 0);
  b2CreatePolygonShape(body, &def, &made);
}

void add_shape(b2BodyId body, const Shape& shape, bool apart) {
  b2ShapeDef def = b2DefaultShapeDef();
  def.density = static_cast<float>(shape.material.density);
  def.material.friction = static_cast<float>(shape.material.friction);
  def.material.restitution = static_cast<float>(shape.material.restitution);
  if (apart) {
    def.filter.categoryBits = 2;
    def.filter.maskBits = ~2ull;
  }
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    const b2Vec2 half = vec(box->half);
    const b2Polygon polygon = b2MakeOffsetBox(half.x, half.y, vec(box->center), b2Rot_identity);
    b2CreatePolygonShape(body, &def, &polygon);
  } else if (const auto* circle = std::get_if<Circle>(&shape.geometry)) {
    const b2Circle made = {vec(circle->center), static_cast<float>(circle->radius)};
    b2CreateCircleShape(body, &def, &made);
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.geometry)) {
    const b2Capsule made = {vec(capsule->a), vec(capsule->b), static_cast<float>(capsule->radius)};
    b2CreateCapsuleShape(body, &def, &made);
  } else if (const auto* rounded = std::get_if<RoundedBox>(&shape.geometry)) {
    const b2Vec2 half = vec(rounded->half);
    const b2Polygon polygon = b2MakeRoundedBox(half.x, half.y, static_cast<float>(rounded->rounding));
    b2CreatePolygonShape(body, &def, &polygon);
  } else if (const auto* polygon_shape = std::get_if<Polygon>(&shape.geometry)) {
    add_polygon(body, *polygon_shape, def);
  } else if (const auto* loop = std::get_if<Loop>(&shape.geometry)) {
    add_loop(body, *loop, shape.material);
  }
}

b2BodyId add_body(b2WorldId world, const Body& body) {
  b2BodyDef def = b2DefaultBodyDef();
  def.type = body.kind == BodyKind::kDynamic     ? b2_dynamicBody
             : body.kind == BodyKind::kKinematic ? b2_kinematicBody
                                                 : b2_staticBody;
  def.position = vec(body.position);
  def.rotation = b2MakeRot(static_cast<float>(body.angle));
  def.linearVelocity = vec(body.velocity);
  def.angularVelocity = static_cast<float>(body.spin);
  def.isAwake = body.awake;
  const b2BodyId id = b2CreateBody(world, &def);
  for (const Shape& shape : body.shapes) add_shape(id, shape, body.apart);
  return id;
}

void add_revolute(b2WorldId world, const std::vector<b2BodyId>& bodies, const Revolute& joint) {
  b2RevoluteJointDef def = b2DefaultRevoluteJointDef();
  def.base.bodyIdA = bodies[static_cast<std::size_t>(joint.a)];
  def.base.bodyIdB = bodies[static_cast<std::size_t>(joint.b)];
  def.base.localFrameA.p = vec(joint.at_a);
  def.base.localFrameB.p = vec(joint.at_b);
  def.enableMotor = joint.motor_torque > 0;
  def.motorSpeed = static_cast<float>(joint.motor_speed);
  def.maxMotorTorque = static_cast<float>(joint.motor_torque);
  b2CreateRevoluteJoint(world, &def);
}

// Every touching pair is listed by both of its bodies.
std::uint64_t count_touching(const std::vector<b2BodyId>& bodies) {
  std::uint64_t twice = 0;
  std::vector<b2ContactData> contacts;
  for (const b2BodyId body : bodies) {
    contacts.resize(static_cast<std::size_t>(b2Body_GetContactCapacity(body)));
    twice +=
        static_cast<std::uint64_t>(b2Body_GetContactData(body, contacts.data(), static_cast<int>(contacts.size())));
  }
  return twice / 2;
}

class PhaseSums {
 public:
  void add(const b2Profile& profile) {
    pairs_ += profile.pairs;
    collide_ += profile.collide;
    constraints_ += profile.constraints;
    rest_ += profile.step - profile.pairs - profile.collide - profile.constraints;
  }
  std::vector<std::pair<std::string, double>> means(int steps) const {
    return {{"pairs", pairs_ / steps},
            {"collide", collide_ / steps},
            {"constraints", constraints_ / steps},
            {"rest", rest_ / steps}};
  }

 private:
  double pairs_ = 0, collide_ = 0, constraints_ = 0, rest_ = 0;
};

// Before a step: the velocity of what moves by itself.
void sway(const Scene& scene, const std::vector<b2BodyId>& bodies, int step) {
  for (const Sway& each : scene.sways) {
    b2Body_SetLinearVelocity(bodies[static_cast<std::size_t>(each.body)],
                             {static_cast<float>(each.velocity_before(step, kTimeStep)), 0});
  }
}

void run(const Arguments& arguments) {
  const Scene scene = read_scene(arguments.scene_path);
  const int steps = arguments.steps > 0 ? arguments.steps : scene.steps;
  Report report;
  report.step_ms.reserve(static_cast<std::size_t>(steps));
  std::vector<b2BodyId> bodies;
  bodies.reserve(scene.bodies.size());
  const std::uint64_t heap_before = heap_bytes();
  b2WorldDef def = b2DefaultWorldDef();
  def.gravity = vec(scene.gravity);
  def.enableSleep = scene.sleep;
  def.workerCount = arguments.threads;
  const b2WorldId world = b2CreateWorld(&def);
  for (const Body& body : scene.bodies) bodies.push_back(add_body(world, body));
  for (const Revolute& joint : scene.revolutes) add_revolute(world, bodies, joint);
  report.heap_built = heap_bytes() - heap_before;

  PhaseSums phases;
  const auto advance = [&] { b2World_Step(world, static_cast<float>(kTimeStep), kSubSteps); };
  for (int step = 0; step < arguments.skip; ++step) {
    sway(scene, bodies, step);
    advance();
  }
  start_counting_instructions();
  for (int step = 0; step < steps; ++step) {
    sway(scene, bodies, arguments.skip + step);
    time_step(report, advance);
    phases.add(b2World_GetProfile(world));
  }
  stop_counting_instructions();
  report.heap_stepped = heap_bytes() - heap_before;
  const b2Version version = b2GetVersion();
  report.engine = BENCH_ENGINE;
  report.version =
      std::to_string(version.major) + "." + std::to_string(version.minor) + "." + std::to_string(version.revision);
  report.scene = scene.name;
  report.threads = arguments.threads;
  report.awake = static_cast<std::uint64_t>(b2World_GetAwakeBodyCount(world));
  report.pairs = static_cast<std::uint64_t>(b2World_GetCounters(world).contactCount);
  report.touching = count_touching(bodies);
  report.phases_ms = phases.means(steps);
  Hash hash;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const b2Transform at = b2Body_GetTransform(bodies[i]);
    for (const float value : {at.p.x, at.p.y, at.q.c, at.q.s}) hash.add(value);
    if (arguments.states) {
      const b2Vec2 v = b2Body_GetLinearVelocity(bodies[i]);
      report.states.push_back({at.p.x, at.p.y, b2Rot_GetAngle(at.q), v.x, v.y, b2Body_GetAngularVelocity(bodies[i])});
    }
    report.bodies += scene.bodies[i].kind == BodyKind::kDynamic ? 1 : 0;
  }
  report.hash = hash.text();
  report.print();
  b2DestroyWorld(world);
}

}  // namespace
}  // namespace bench

int main(int count, char** values) { bench::run(bench::parse_arguments(count, values)); }

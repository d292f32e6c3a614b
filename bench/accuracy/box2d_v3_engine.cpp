// Box2D v3 with its defaults but for the cap on speed, which is raised, and bullets.

#include <box2d/box2d.h>

#include <map>

#include "peer.h"

namespace urto::accuracy {
namespace {

constexpr float kSpeedCap = 1e6f;  // m/s; the default of 400 would fail every faster case

// Callbacks without context: the rules of the world that is being made or stepped. One world steps at a time.
Mixing friction_mixing, restitution_mixing;
float mix_friction(float a, std::uint64_t, float b, std::uint64_t) {
  return static_cast<float>(mixed(friction_mixing, double(a), double(b)));
}
float mix_restitution(float a, std::uint64_t, float b, std::uint64_t) {
  return static_cast<float>(mixed(restitution_mixing, double(a), double(b)));
}

b2Vec2 vec(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

class Box2dV3 : public Simulator {
 public:
  explicit Box2dV3(const WorldSettings& settings) : settings_(settings) {
    b2WorldDef def = b2DefaultWorldDef();
    def.gravity = vec(settings.gravity);
    def.enableSleep = settings.sleeping;
    def.enableContinuous = settings.continuous;
    def.restitutionThreshold = static_cast<float>(settings.restitution_threshold);
    def.maximumLinearSpeed = kSpeedCap;
    if (settings.friction_mixing != Mixing::kGeometricMean) def.frictionCallback = mix_friction;
    if (settings.restitution_mixing != Mixing::kMaximum) def.restitutionCallback = mix_restitution;
    world_ = b2CreateWorld(&def);
  }
  ~Box2dV3() override { b2DestroyWorld(world_); }

  void add(const BodyDef& def) override {
    b2BodyDef made = b2DefaultBodyDef();
    made.type = def.type == BodyType::kDynamic     ? b2_dynamicBody
                : def.type == BodyType::kKinematic ? b2_kinematicBody
                                                   : b2_staticBody;
    made.position = vec(def.position);
    made.rotation = b2MakeRot(static_cast<float>(def.angle));
    made.linearVelocity = vec(def.velocity);
    made.angularVelocity = static_cast<float>(def.angular_velocity);
    made.isBullet = is_bullet(def, settings_);
    const b2BodyId id = b2CreateBody(world_, &made);
    for (const ShapeDef& shape : def.shapes) add_shape(id, shape);
    if (def.mass && def.type == BodyType::kDynamic) {
      b2MassData mass = b2Body_GetMassData(id);
      const double scale = mass_scale(def, double(mass.mass));
      mass.mass = static_cast<float>(*def.mass);
      mass.rotationalInertia = static_cast<float>(scale * double(mass.rotationalInertia));
      b2Body_SetMassData(id, mass);
    }
    numbers_[b2StoreBodyId(id)] = ids_.size();
    ids_.push_back(id);
  }

  void join(std::size_t a, std::size_t b, const JointDef& def) override {
    if (is_plain_hinge(def)) {
      b2RevoluteJointDef made = b2DefaultRevoluteJointDef();
      place(made.base, a, b, def);
      b2CreateRevoluteJoint(world_, &made);
    } else {
      const DistanceJoint& rod = spring_of(def);
      b2DistanceJointDef made = b2DefaultDistanceJointDef();
      place(made.base, a, b, def);
      made.length = static_cast<float>(*rod.length);
      made.enableSpring = true;
      made.hertz = static_cast<float>(rod.spring->hertz);
      made.dampingRatio = static_cast<float>(rod.spring->damping_ratio);
      b2CreateDistanceJoint(world_, &made);
    }
  }

  void step() override {
    friction_mixing = settings_.friction_mixing;
    restitution_mixing = settings_.restitution_mixing;
    b2World_Step(world_, static_cast<float>(settings_.time_step), static_cast<int>(settings_.sub_steps));
  }

  BodyState body(std::size_t number) const override {
    const b2BodyId id = ids_[number];
    const b2Vec2 p = b2Body_GetPosition(id), v = b2Body_GetLinearVelocity(id);
    BodyState state;
    state.position = Vec2(double(p.x), double(p.y));
    state.angle = double(b2Rot_GetAngle(b2Body_GetRotation(id)));
    state.velocity = Vec2(double(v.x), double(v.y));
    state.angular_velocity = double(b2Body_GetAngularVelocity(id));
    return state;
  }

  void set_velocity(std::size_t number, const Vec2& velocity, double angular_velocity) override {
    b2Body_SetLinearVelocity(ids_[number], vec(velocity));
    b2Body_SetAngularVelocity(ids_[number], static_cast<float>(angular_velocity));
  }

  // Every contact is listed by both of its bodies, and taken from the first.
  std::vector<Touch> touches() const override {
    std::vector<Touch> out;
    std::vector<b2ContactData> contacts;
    for (std::size_t number = 0; number < ids_.size(); ++number) {
      contacts.resize(static_cast<std::size_t>(b2Body_GetContactCapacity(ids_[number])));
      const int count = b2Body_GetContactData(ids_[number], contacts.data(), static_cast<int>(contacts.size()));
      for (int i = 0; i < count; ++i) {
        const std::size_t a = number_of(contacts[i].shapeIdA), b = number_of(contacts[i].shapeIdB);
        if (a != number) continue;
        const b2Manifold& m = contacts[i].manifold;
        for (int k = 0; k < m.pointCount; ++k)
          out.push_back({a, b, Vec2(double(m.normal.x), double(m.normal.y)), double(m.points[k].totalNormalImpulse),
                         double(m.points[k].tangentImpulse)});
      }
    }
    return out;
  }

 private:
  std::size_t number_of(b2ShapeId shape) const { return numbers_.at(b2StoreBodyId(b2Shape_GetBody(shape))); }

  void place(b2JointDef& base, std::size_t a, std::size_t b, const JointDef& def) const {
    base.bodyIdA = ids_[a];
    base.bodyIdB = ids_[b];
    base.localFrameA.p = vec(def.anchor_a);
    base.localFrameB.p = vec(def.anchor_b);
    base.collideConnected = def.collide_connected;
  }

  void add_shape(b2BodyId body, const ShapeDef& shape) {
    b2ShapeDef def = b2DefaultShapeDef();
    def.density = static_cast<float>(shape.material.density);
    def.material.friction = static_cast<float>(shape.material.friction);
    def.material.restitution = static_cast<float>(shape.material.restitution);
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      const b2Polygon made = b2MakeBox(static_cast<float>(box->width / 2), static_cast<float>(box->height / 2));
      b2CreatePolygonShape(body, &def, &made);
    } else if (const auto* circle = std::get_if<Circle>(&shape.geometry)) {
      const b2Circle made = {vec(circle->center), static_cast<float>(circle->radius)};
      b2CreateCircleShape(body, &def, &made);
    } else if (const auto* polygon = std::get_if<Polygon>(&shape.geometry)) {
      std::vector<b2Vec2> points;
      for (const Vec2& vertex : polygon->vertices) points.push_back(vec(vertex));
      const b2Hull hull = b2ComputeHull(points.data(), static_cast<int>(points.size()));
      const b2Polygon made = b2MakePolygon(&hull, 0);
      b2CreatePolygonShape(body, &def, &made);
    }
  }

  WorldSettings settings_;
  b2WorldId world_;
  std::vector<b2BodyId> ids_;
  std::map<std::uint64_t, std::size_t> numbers_;
};

}  // namespace

std::string engine_name() { return "box2d_v3"; }
std::string engine_version() {
  const b2Version version = b2GetVersion();
  return std::to_string(version.major) + "." + std::to_string(version.minor) + "." + std::to_string(version.revision);
}
std::unique_ptr<Simulator> make_engine(const WorldSettings& settings, unsigned threads) {
  refuse_what_peers_lack(settings, threads);
  if (settings.precision == Precision::kDouble) throw Lacks("double precision");
  return std::make_unique<Box2dV3>(settings);
}

}  // namespace urto::accuracy

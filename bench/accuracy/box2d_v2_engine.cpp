// Box2D 2.4 with its defaults, the restitution threshold of the scene, and bullets. It has no sub-steps: what stands
// for n of them is 2n velocity iterations and 3n/4 position iterations, which for 4 is the 8 and 3 that its manual
// names.

#include <box2d/box2d.h>

#include <algorithm>

#include "peer.h"

namespace urto::accuracy {
namespace {

b2Vec2 vec(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

class MixingListener : public b2ContactListener {
 public:
  explicit MixingListener(const WorldSettings& settings) : settings_(settings) {}
  void PreSolve(b2Contact* contact, const b2Manifold*) override {
    const b2Fixture *a = contact->GetFixtureA(), *b = contact->GetFixtureB();
    contact->SetFriction(
        static_cast<float>(mixed(settings_.friction_mixing, double(a->GetFriction()), double(b->GetFriction()))));
    contact->SetRestitution(static_cast<float>(
        mixed(settings_.restitution_mixing, double(a->GetRestitution()), double(b->GetRestitution()))));
  }

 private:
  const WorldSettings& settings_;
};

class Box2dV2 : public Simulator {
 public:
  explicit Box2dV2(const WorldSettings& settings)
      : settings_(settings), listener_(settings_), world_(vec(settings.gravity)) {
    world_.SetAllowSleeping(settings.sleeping);
    world_.SetContinuousPhysics(settings.continuous);
    if (settings.friction_mixing != Mixing::kGeometricMean || settings.restitution_mixing != Mixing::kMaximum)
      world_.SetContactListener(&listener_);
  }

  void add(const BodyDef& def) override {
    b2BodyDef made;
    made.type = def.type == BodyType::kDynamic     ? b2_dynamicBody
                : def.type == BodyType::kKinematic ? b2_kinematicBody
                                                   : b2_staticBody;
    made.position = vec(def.position);
    made.angle = static_cast<float>(def.angle);
    made.linearVelocity = vec(def.velocity);
    made.angularVelocity = static_cast<float>(def.angular_velocity);
    made.bullet = is_bullet(def, settings_);
    made.userData.pointer = bodies_.size();
    b2Body* body = world_.CreateBody(&made);
    for (const ShapeDef& shape : def.shapes) add_shape(*body, shape);
    if (def.mass && def.type == BodyType::kDynamic) {
      b2MassData mass;
      body->GetMassData(&mass);
      mass.I *= static_cast<float>(mass_scale(def, double(mass.mass)));
      mass.mass = static_cast<float>(*def.mass);
      body->SetMassData(&mass);
    }
    bodies_.push_back(body);
  }

  void join(std::size_t a, std::size_t b, const JointDef& def) override {
    if (is_plain_hinge(def)) {
      b2RevoluteJointDef made;
      place(made, a, b, def);
      made.localAnchorA = vec(def.anchor_a);
      made.localAnchorB = vec(def.anchor_b);
      world_.CreateJoint(&made);
    } else {
      const DistanceJoint& rod = spring_of(def);
      b2DistanceJointDef made;
      place(made, a, b, def);
      made.localAnchorA = vec(def.anchor_a);
      made.localAnchorB = vec(def.anchor_b);
      made.length = static_cast<float>(*rod.length);
      made.minLength = 0;
      made.maxLength = b2_maxFloat;
      b2LinearStiffness(made.stiffness, made.damping, static_cast<float>(rod.spring->hertz),
                        static_cast<float>(rod.spring->damping_ratio), made.bodyA, made.bodyB);
      world_.CreateJoint(&made);
    }
  }

  void step() override {
    const int n = static_cast<int>(settings_.sub_steps);
    world_.Step(static_cast<float>(settings_.time_step), 2 * n, std::max(1, 3 * n / 4));
  }

  BodyState body(std::size_t number) const override {
    const b2Body& b = *bodies_[number];
    BodyState state;
    state.position = Vec2(double(b.GetPosition().x), double(b.GetPosition().y));
    state.angle = double(b.GetAngle());
    state.velocity = Vec2(double(b.GetLinearVelocity().x), double(b.GetLinearVelocity().y));
    state.angular_velocity = double(b.GetAngularVelocity());
    return state;
  }

  void set_velocity(std::size_t number, const Vec2& velocity, double angular_velocity) override {
    bodies_[number]->SetLinearVelocity(vec(velocity));
    bodies_[number]->SetAngularVelocity(static_cast<float>(angular_velocity));
  }

  std::vector<Touch> touches() const override {
    std::vector<Touch> out;
    for (const b2Contact* c = world_.GetContactList(); c; c = c->GetNext()) {
      if (!c->IsTouching()) continue;
      b2WorldManifold at;
      c->GetWorldManifold(&at);
      const b2Manifold& m = *c->GetManifold();
      for (int k = 0; k < m.pointCount; ++k)
        out.push_back({number_of(c->GetFixtureA()), number_of(c->GetFixtureB()),
                       Vec2(double(at.normal.x), double(at.normal.y)), double(m.points[k].normalImpulse),
                       double(m.points[k].tangentImpulse)});
    }
    return out;
  }

 private:
  static std::size_t number_of(const b2Fixture* fixture) {
    return const_cast<b2Fixture*>(fixture)->GetBody()->GetUserData().pointer;
  }

  void place(b2JointDef& made, std::size_t a, std::size_t b, const JointDef& def) const {
    made.bodyA = bodies_[a];
    made.bodyB = bodies_[b];
    made.collideConnected = def.collide_connected;
  }

  void add_shape(b2Body& body, const ShapeDef& shape) {
    b2FixtureDef def;
    def.density = static_cast<float>(shape.material.density);
    def.friction = static_cast<float>(shape.material.friction);
    def.restitution = static_cast<float>(shape.material.restitution);
    def.restitutionThreshold = static_cast<float>(settings_.restitution_threshold);
    b2PolygonShape polygon;
    b2CircleShape circle;
    def.shape = &polygon;
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      polygon.SetAsBox(static_cast<float>(box->width / 2), static_cast<float>(box->height / 2));
    } else if (const auto* disc = std::get_if<Circle>(&shape.geometry)) {
      circle.m_radius = static_cast<float>(disc->radius);
      circle.m_p = vec(disc->center);
      def.shape = &circle;
    } else if (const auto* outline = std::get_if<Polygon>(&shape.geometry)) {
      std::vector<b2Vec2> points;
      for (const Vec2& vertex : outline->vertices) points.push_back(vec(vertex));
      polygon.Set(points.data(), static_cast<int>(points.size()));
    }
    body.CreateFixture(&def);
  }

  WorldSettings settings_;
  MixingListener listener_;
  b2World world_;
  std::vector<b2Body*> bodies_;
};

}  // namespace

std::string engine_name() { return "box2d_v2"; }
std::string engine_version() {
  return std::to_string(b2_version.major) + "." + std::to_string(b2_version.minor) + "." +
         std::to_string(b2_version.revision);
}
std::unique_ptr<Simulator> make_engine(const WorldSettings& settings, unsigned threads) {
  refuse_what_peers_lack(settings, threads);
  if (settings.precision == Precision::kDouble) throw Lacks("double precision");
  return std::make_unique<Box2dV2>(settings);
}

}  // namespace urto::accuracy

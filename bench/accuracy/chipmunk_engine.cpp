// Chipmunk 7, whose scalar is double, with its defaults but for the slop, which is meant for pixels. A sub-step is a
// step of its own, as its manual advises for accuracy. It has no continuous collision and no threshold of restitution.

#include <chipmunk/chipmunk.h>

#include "peer.h"

namespace urto::accuracy {
namespace {

constexpr double kSlop = 0.005;  // m, Box2D's

cpVect vec(const Vec2& v) { return cpv(v.x(), v.y()); }

class Chipmunk : public Simulator {
 public:
  explicit Chipmunk(const WorldSettings& settings) : settings_(settings), space_(cpSpaceNew()) {
    cpSpaceSetGravity(space_, vec(settings.gravity));
    cpSpaceSetCollisionSlop(space_, kSlop);
    // Its own rules are products of the coefficients.
    cpCollisionHandler* handler = cpSpaceAddDefaultCollisionHandler(space_);
    handler->userData = this;
    handler->preSolveFunc = [](cpArbiter* arbiter, cpSpace*, cpDataPointer self) -> cpBool {
      static_cast<Chipmunk*>(self)->mix(arbiter);
      return cpTrue;
    };
  }

  ~Chipmunk() override {
    for (cpConstraint* joint : joints_) {
      cpSpaceRemoveConstraint(space_, joint);
      cpConstraintFree(joint);
    }
    for (cpShape* shape : shapes_) {
      cpSpaceRemoveShape(space_, shape);
      cpShapeFree(shape);
    }
    for (cpBody* body : bodies_) {
      cpSpaceRemoveBody(space_, body);
      cpBodyFree(body);
    }
    cpSpaceFree(space_);
  }

  void add(const BodyDef& def) override {
    cpBody* body = def.type == BodyType::kDynamic ? cpBodyNew(mass_and_inertia(def).first, mass_and_inertia(def).second)
                   : def.type == BodyType::kKinematic ? cpBodyNewKinematic()
                                                      : cpBodyNewStatic();
    cpBodySetUserData(body, reinterpret_cast<void*>(bodies_.size()));
    cpSpaceAddBody(space_, body);
    bodies_.push_back(body);
    for (const ShapeDef& shape : def.shapes) add_shape(body, shape);
    cpBodySetPosition(body, vec(def.position));
    cpBodySetAngle(body, def.angle);
    if (def.type != BodyType::kStatic) {
      cpBodySetVelocity(body, vec(def.velocity));
      cpBodySetAngularVelocity(body, def.angular_velocity);
    }
    cpSpaceReindexShapesForBody(space_, body);
  }

  void join(std::size_t a, std::size_t b, const JointDef& def) override {
    cpConstraint* made = nullptr;
    if (is_plain_hinge(def)) {
      made = cpPivotJointNew2(bodies_[a], bodies_[b], vec(def.anchor_a), vec(def.anchor_b));
    } else {
      const DistanceJoint& rod = spring_of(def);
      const double mass = 1 / (inverse_mass(bodies_[a]) + inverse_mass(bodies_[b]));
      const double rate = 2 * kPi * rod.spring->hertz;  // rad/s
      made = cpDampedSpringNew(bodies_[a], bodies_[b], vec(def.anchor_a), vec(def.anchor_b), *rod.length,
                               mass * rate * rate, 2 * mass * rod.spring->damping_ratio * rate);
    }
    cpConstraintSetCollideBodies(made, def.collide_connected ? cpTrue : cpFalse);
    cpSpaceAddConstraint(space_, made);
    joints_.push_back(made);
  }

  void step() override {
    for (std::uint32_t i = 0; i < settings_.sub_steps; ++i)
      cpSpaceStep(space_, settings_.time_step / settings_.sub_steps);
  }

  BodyState body(std::size_t number) const override {
    const cpBody* b = bodies_[number];
    const cpVect p = cpBodyGetPosition(b), v = cpBodyGetVelocity(b);
    BodyState state;
    state.position = Vec2(p.x, p.y);
    state.angle = cpBodyGetAngle(b);
    state.velocity = Vec2(v.x, v.y);
    state.angular_velocity = cpBodyGetAngularVelocity(b);
    return state;
  }

  void set_velocity(std::size_t number, const Vec2& velocity, double angular_velocity) override {
    cpBodySetVelocity(bodies_[number], vec(velocity));
    cpBodySetAngularVelocity(bodies_[number], angular_velocity);
  }

  // A pair's contacts come as one, with the impulse of the last sub-step, which stands for all of them.
  std::vector<Touch> touches() const override {
    std::vector<Touch> out;
    for (cpBody* body : bodies_) {
      struct Context {
        const Chipmunk* self;
        cpBody* body;
        std::vector<Touch>* out;
      } context{this, body, &out};
      cpBodyEachArbiter(
          body,
          [](cpBody* of, cpArbiter* arbiter, void* data) {
            const auto& c = *static_cast<Context*>(data);
            cpBody *a = nullptr, *b = nullptr;
            cpArbiterGetBodies(arbiter, &a, &b);
            if (number_of(a) > number_of(b)) std::swap(a, b);
            if (of != a) return;
            const cpVect n = cpArbiterGetNormal(arbiter), j = cpArbiterTotalImpulse(arbiter);
            const double scale = c.self->settings_.sub_steps;
            c.out->push_back({number_of(a), number_of(b), Vec2(n.x, n.y), std::abs(cpvdot(n, j)) * scale,
                              std::abs(cpvcross(n, j)) * scale});
          },
          &context);
    }
    return out;
  }

 private:
  static std::size_t number_of(const cpBody* body) { return reinterpret_cast<std::size_t>(cpBodyGetUserData(body)); }

  static double inverse_mass(cpBody* body) {
    return cpBodyGetType(body) == CP_BODY_TYPE_DYNAMIC ? 1 / cpBodyGetMass(body) : 0;
  }

  void mix(cpArbiter* arbiter) const {
    cpShape *a = nullptr, *b = nullptr;
    cpArbiterGetShapes(arbiter, &a, &b);
    cpArbiterSetFriction(arbiter, mixed(settings_.friction_mixing, cpShapeGetFriction(a), cpShapeGetFriction(b)));
    cpArbiterSetRestitution(arbiter,
                            mixed(settings_.restitution_mixing, cpShapeGetElasticity(a), cpShapeGetElasticity(b)));
  }

  static std::vector<cpVect> corners(const Polygon& polygon) {
    std::vector<cpVect> out;
    for (const Vec2& vertex : polygon.vertices) out.push_back(vec(vertex));
    return out;
  }

  static std::pair<double, double> mass_and_inertia(const BodyDef& def) {
    const auto* polygon = std::get_if<Polygon>(&def.shapes[0].geometry);
    if (!polygon) return {mass_of(def), inertia_of(def)};
    const std::vector<cpVect> points = corners(*polygon);
    const int count = static_cast<int>(points.size());
    const double mass = def.shapes[0].material.density * std::abs(cpAreaForPoly(count, points.data(), 0));
    const cpVect middle = cpCentroidForPoly(count, points.data());
    return {mass, cpMomentForPoly(mass, count, points.data(), cpvneg(middle), 0)};
  }

  void add_shape(cpBody* body, const ShapeDef& shape) {
    cpShape* made = nullptr;
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      made = cpBoxShapeNew(body, box->width, box->height, 0);
    } else if (const auto* circle = std::get_if<Circle>(&shape.geometry)) {
      made = cpCircleShapeNew(body, circle->radius, vec(circle->center));
    } else if (const auto* polygon = std::get_if<Polygon>(&shape.geometry)) {
      const std::vector<cpVect> points = corners(*polygon);
      const int count = static_cast<int>(points.size());
      made = cpPolyShapeNew(body, count, points.data(), cpTransformIdentity, 0);
      if (cpBodyGetType(body) == CP_BODY_TYPE_DYNAMIC)
        cpBodySetCenterOfGravity(body, cpCentroidForPoly(count, points.data()));
    }
    cpShapeSetFriction(made, shape.material.friction);
    cpShapeSetElasticity(made, shape.material.restitution);
    cpSpaceAddShape(space_, made);
    shapes_.push_back(made);
  }

  WorldSettings settings_;
  cpSpace* space_;
  std::vector<cpBody*> bodies_;
  std::vector<cpShape*> shapes_;
  std::vector<cpConstraint*> joints_;
};

}  // namespace

std::string engine_name() { return "chipmunk"; }
std::string engine_version() { return cpVersionString; }
std::unique_ptr<Simulator> make_engine(const WorldSettings& settings, unsigned threads) {
  refuse_what_peers_lack(settings, threads);
  return std::make_unique<Chipmunk>(settings);
}

}  // namespace urto::accuracy

// Rapier 2D with its defaults and continuous collision for bullets, through the C functions of bench/peers/src/lib.rs.
// Its solver iterations are its sub-steps.

#include "peer.h"

extern "C" {
struct RapierWorld;
struct RapierState {
  float x, y, angle, vx, vy, w;
};
struct RapierTouch {
  std::uint32_t a, b;
  float nx, ny, normal_impulse, tangent_impulse;
};
RapierWorld* rapier_create(float gx, float gy, float time_step, std::uint32_t iterations);
void rapier_destroy(RapierWorld* world);
void rapier_add_body(RapierWorld* world, std::uint32_t kind, RapierState state, bool continuous, bool sleep);
// Of the last body. Points are x, y in turn; one point and a radius: a circle. Rules: 0 geometric mean, 1 maximum,
// 2 minimum, 3 average.
void rapier_add_shape(RapierWorld* world, const float* points, std::uint32_t count, float radius, float density,
                      float friction, float restitution, std::uint32_t friction_rule, std::uint32_t restitution_rule);
void rapier_set_mass(RapierWorld* world, float mass, float inertia);
// A hinge at the bodies' points (ax, ay) and (bx, by).
void rapier_add_hinge(RapierWorld* world, std::uint32_t a, std::uint32_t b, float ax, float ay, float bx, float by,
                      bool collide);
void rapier_step(RapierWorld* world);
RapierState rapier_state(const RapierWorld* world, std::uint32_t number);
void rapier_set_velocity(RapierWorld* world, std::uint32_t number, float vx, float vy, float w);
// Writes at most `most` of them; how many there are.
std::uint32_t rapier_touches(const RapierWorld* world, RapierTouch* out, std::uint32_t most);
const char* rapier_version();
}

namespace urto::accuracy {
namespace {

float f(double value) { return static_cast<float>(value); }

class Rapier : public Simulator {
 public:
  explicit Rapier(const WorldSettings& settings)
      : settings_(settings),
        world_(rapier_create(f(settings.gravity.x()), f(settings.gravity.y()), f(settings.time_step),
                             settings.sub_steps)) {}
  ~Rapier() override { rapier_destroy(world_); }

  void add(const BodyDef& def) override {
    const RapierState state{f(def.position.x()), f(def.position.y()), f(def.angle),
                            f(def.velocity.x()), f(def.velocity.y()), f(def.angular_velocity)};
    rapier_add_body(world_, static_cast<std::uint32_t>(def.type), state, is_bullet(def, settings_), settings_.sleeping);
    for (const ShapeDef& shape : def.shapes) add_shape(shape);
    if (def.mass && def.type == BodyType::kDynamic) rapier_set_mass(world_, f(*def.mass), f(inertia_of(def)));
  }
  void join(std::size_t a, std::size_t b, const JointDef& def) override {
    if (!is_plain_hinge(def)) throw Lacks("springs by frequency");
    rapier_add_hinge(world_, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), f(def.anchor_a.x()),
                     f(def.anchor_a.y()), f(def.anchor_b.x()), f(def.anchor_b.y()), def.collide_connected);
  }
  void step() override { rapier_step(world_); }
  BodyState body(std::size_t number) const override {
    const RapierState s = rapier_state(world_, static_cast<std::uint32_t>(number));
    BodyState state;
    state.position = Vec2(double(s.x), double(s.y));
    state.angle = double(s.angle);
    state.velocity = Vec2(double(s.vx), double(s.vy));
    state.angular_velocity = double(s.w);
    return state;
  }
  void set_velocity(std::size_t number, const Vec2& velocity, double angular_velocity) override {
    rapier_set_velocity(world_, static_cast<std::uint32_t>(number), f(velocity.x()), f(velocity.y()),
                        f(angular_velocity));
  }
  std::vector<Touch> touches() const override {
    std::vector<RapierTouch> found(rapier_touches(world_, nullptr, 0));
    rapier_touches(world_, found.data(), static_cast<std::uint32_t>(found.size()));
    std::vector<Touch> out;
    for (const RapierTouch& t : found)
      out.push_back({t.a, t.b, Vec2(double(t.nx), double(t.ny)), double(t.normal_impulse), double(t.tangent_impulse)});
    return out;
  }

 private:
  void add_shape(const ShapeDef& shape) {
    std::vector<float> points;
    double radius = 0;
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      const float w = f(box->width / 2), h = f(box->height / 2);
      points = {w, h};  // two numbers without a radius: half extents
    } else if (const auto* circle = std::get_if<Circle>(&shape.geometry)) {
      points = {f(circle->center.x()), f(circle->center.y())};
      radius = circle->radius;
    } else if (const auto* polygon = std::get_if<Polygon>(&shape.geometry)) {
      for (const Vec2& vertex : polygon->vertices) points.insert(points.end(), {f(vertex.x()), f(vertex.y())});
    }
    rapier_add_shape(world_, points.data(), static_cast<std::uint32_t>(points.size() / 2), f(radius),
                     f(shape.material.density), f(shape.material.friction), f(shape.material.restitution),
                     static_cast<std::uint32_t>(settings_.friction_mixing),
                     static_cast<std::uint32_t>(settings_.restitution_mixing));
  }

  WorldSettings settings_;
  RapierWorld* world_;
};

}  // namespace

std::string engine_name() { return "rapier"; }
std::string engine_version() { return rapier_version(); }
std::unique_ptr<Simulator> make_engine(const WorldSettings& settings, unsigned threads) {
  refuse_what_peers_lack(settings, threads);
  if (settings.precision == Precision::kDouble) throw Lacks("double precision");
  return std::make_unique<Rapier>(settings);
}

}  // namespace urto::accuracy

#include "accuracy/replay.h"

#include <cstdio>
#include <sstream>

namespace urto::accuracy {
namespace {

// Ends a case's measurement when its first scene is complete.
struct Complete {};

// Takes down what a case builds.
class Recorder : public Simulator {
 public:
  Recorder(const WorldSettings& settings, Scene& scene) : scene_(scene) { scene_.settings = settings; }
  void add(const BodyDef& def) override { scene_.add(def); }
  void step() override { throw Complete{}; }
  BodyState body(std::size_t number) const override {
    const BodyDef& def = scene_.bodies[number];
    return {def.type, def.position, def.angle, def.velocity, def.angular_velocity, true};
  }
  void set_velocity(std::size_t, const Vec2&, double) override {}
  std::vector<Touch> touches() const override { return {}; }

 private:
  Scene& scene_;
};

Scene recorded(const Case& a_case, const Method& method) {
  Scene scene;
  Lab lab(
      [&](const WorldSettings& settings) {
        scene.bodies.clear();
        return std::make_unique<Recorder>(settings, scene);
      },
      method);
  try {
    a_case.measure(lab);
  } catch (const Complete&) {
  }
  return scene;
}

// ---- the scene file ----

std::string exact(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string vector(const char* name, const Vec2& v) {
  return std::string(name) + " { x: " + exact(v.x()) + " y: " + exact(v.y()) + " } ";
}

const char* name_of(Mixing mixing) {
  switch (mixing) {
    case Mixing::kGeometricMean:
      return "MIXING_GEOMETRIC_MEAN";
    case Mixing::kMaximum:
      return "MIXING_MAXIMUM";
    case Mixing::kMinimum:
      return "MIXING_MINIMUM";
    case Mixing::kAverage:
      break;
  }
  return "MIXING_AVERAGE";
}

std::string solver_of(SolverKind solver) {
  if (solver == SolverKind::kPrecise) return "SOLVER_PRECISE";
  return solver == SolverKind::kThesis ? "SOLVER_THESIS" : "SOLVER_SOFT_STEP";
}

std::string integrator_of(Integrator integrator) {
  const char* const names[] = {"SEMI_IMPLICIT_EULER", "EXPLICIT_EULER", "VERLET", "RUNGE_KUTTA_4"};
  return std::string("INTEGRATOR_") + names[static_cast<int>(integrator)];
}

// Fields of force are written by the cases that have them as attractors alone.
std::string field_text(const ForceField& field) {
  const auto* attractor = std::get_if<PointAttractor>(&field);
  if (!attractor) throw std::invalid_argument("replay knows no other field than the attractor");
  return "fields { point_attractor { " + vector("center", attractor->center) +
         "strength: " + exact(attractor->strength) + " softening: " + exact(attractor->softening) + " } }\n";
}

std::string geometry_text(const Geometry& geometry) {
  if (const auto* box = std::get_if<Box>(&geometry))
    return "box { width: " + exact(box->width) + " height: " + exact(box->height) + " } ";
  if (const auto* circle = std::get_if<Circle>(&geometry)) return "circle { radius: " + exact(circle->radius) + " } ";
  std::string text = "polygon { ";
  for (const Vec2& vertex : std::get<Polygon>(geometry).vertices) text += vector("vertices", vertex);
  return text + "} ";
}

std::string body_text(const BodyDef& def) {
  const char* const types[] = {"BODY_TYPE_STATIC", "BODY_TYPE_KINEMATIC", "BODY_TYPE_DYNAMIC"};
  std::string text = std::string("bodies { type: ") + types[static_cast<int>(def.type)] + " ";
  text += vector("position", def.position) + "angle: " + exact(def.angle) + " " + vector("velocity", def.velocity);
  text += "angular_velocity: " + exact(def.angular_velocity) + " ";
  if (def.mass) text += "mass: " + exact(*def.mass) + " ";
  for (const ShapeDef& shape : def.shapes)
    text += "shapes { " + geometry_text(shape.geometry) + "density: " + exact(shape.material.density) +
            " friction: " + exact(shape.material.friction) + " restitution: " + exact(shape.material.restitution) +
            " } ";
  return text + "}\n";
}

std::string scene_text(const Scene& scene) {
  const WorldSettings& s = scene.settings;
  const auto flag = [](bool value) { return value ? "true" : "false"; };
  std::string text = "name: \"replay\"\nworld { precision: ";
  text += s.precision == Precision::kDouble ? "PRECISION_DOUBLE " : "PRECISION_FLOAT ";
  text += vector("gravity", s.gravity) + "time_step: " + exact(s.time_step);
  text += " sub_steps: " + std::to_string(s.sub_steps) + " solver: " + solver_of(s.solver);
  text += " integrator: " + integrator_of(s.integrator);
  text += std::string(" sleeping: ") + flag(s.sleeping) + " continuous: " + flag(s.continuous);
  text += std::string(" friction_mixing: ") + name_of(s.friction_mixing);
  text += std::string(" restitution_mixing: ") + name_of(s.restitution_mixing);
  text += " restitution_threshold: " + exact(s.restitution_threshold) + " }\n";
  for (const ForceField& field : s.fields) text += field_text(field);
  for (const BodyDef& def : scene.bodies) text += body_text(def);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '"') out += '\\';
    out += c == '\n' ? std::string("\\n") : std::string(1, c);
  }
  return out;
}

}  // namespace

std::string replay(const Case& a_case, const Method& method, int steps) {
  const Scene scene = recorded(a_case, method);
  const auto world = World::create(scene.settings);
  if (!world) throw std::invalid_argument(world.error().message);
  std::vector<BodyId> ids;
  for (const BodyDef& def : scene.bodies) ids.push_back(*(*world)->add_body(def));
  for (int step = 0; step < steps; ++step) (*world)->step();
  char hash[20];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>((*world)->state_hash()));
  std::string states;
  for (const BodyId id : ids) {
    const BodyState at = *(*world)->body(id);
    states.append(states.empty() ? "[" : ",[");
    for (const double value : {at.position.x(), at.position.y(), at.angle, at.velocity.x(), at.velocity.y()})
      states.append(exact(value)).append(",");
    states.append(exact(at.angular_velocity)).append("]");
  }
  return "{\"scene\":\"" + escaped(scene_text(scene)) + "\",\"hash\":\"" + hash + "\",\"states\":[" + states + "]}";
}

}  // namespace urto::accuracy

#include "urto_scene.h"

#include <chrono>

#include "physics/solver/contact_kernels.h"

namespace bench {
namespace {

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

}  // namespace

urto::Vec2 vec(const Point& point) { return {point[0], point[1]}; }

urto::BodyDef body_def(const Body& body) {
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
  return def;
}

urto::WorldSettings world_settings(const Scene& scene) {
  urto::WorldSettings settings;
  settings.gravity = vec(scene.gravity);
  settings.time_step = kTimeStep;
  settings.sub_steps = kSubSteps;
  settings.sleeping = scene.sleep;
  return settings;
}

std::string choose_simd(const std::string& name) {
  for (const urto::SimdTarget& target : urto::simd_targets()) {
    if (!name.empty() && target.name != name) continue;
    if (!name.empty()) urto::use_simd_target(target.id);
    return target.name;
  }
  std::fprintf(stderr, "this machine has no %s\n", name.c_str());
  std::exit(2);
}

std::uint64_t nanoseconds() {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
          .count());
}

}  // namespace bench

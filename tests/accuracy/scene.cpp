#include "accuracy/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace urto::accuracy {
namespace {

// A shape as corners around a radius: a circle is one corner.
struct Outline {
  std::vector<Vec2> corners;
  double radius = 0;
};

Outline outline_of(const BodyDef& def, const BodyState& state) {
  if (const auto* circle = std::get_if<Circle>(&def.shapes[0].geometry)) return {{state.position}, circle->radius};
  return {corners_of(def, state), 0};
}

std::vector<Vec2> normals_of(const Outline& outline) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; outline.corners.size() > 1 && i < outline.corners.size(); ++i) {
    const Vec2 edge = outline.corners[(i + 1) % outline.corners.size()] - outline.corners[i];
    out.push_back(Vec2(edge.y(), -edge.x()).normalized());
  }
  return out;
}

// A circle's axis: from its centre to the nearest corner of the other.
void add_axis_of_circle(const Outline& circle, const Outline& other, std::vector<Vec2>& axes) {
  if (circle.corners.size() > 1) return;
  Vec2 nearest = other.corners[0] - circle.corners[0];
  for (const Vec2& corner : other.corners)
    if ((corner - circle.corners[0]).norm() < nearest.norm()) nearest = corner - circle.corners[0];
  if (nearest.norm() > 0) axes.push_back(nearest.normalized());
}

double overlap_along(const Vec2& axis, const Outline& a, const Outline& b) {
  const auto span = [&](const Outline& o) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec2& corner : o.corners) {
      low = std::min(low, axis.dot(corner) - o.radius);
      high = std::max(high, axis.dot(corner) + o.radius);
    }
    return std::pair(low, high);
  };
  const auto [low_a, high_a] = span(a);
  const auto [low_b, high_b] = span(b);
  return std::min(high_a - low_b, high_b - low_a);
}

}  // namespace

Scene weightless() {
  Scene scene;
  scene.settings.gravity = Vec2(0, 0);
  return scene;
}

BodyDef box_at(const Vec2& position, double width, double height, BodyType type) {
  BodyDef def;
  def.type = type;
  def.position = position;
  ShapeDef shape;
  Box box;
  box.width = width;
  box.height = height;
  shape.geometry = box;
  def.shapes.push_back(shape);
  return def;
}

BodyDef ball_at(const Vec2& position, double radius, BodyType type) {
  BodyDef def;
  def.type = type;
  def.position = position;
  ShapeDef shape;
  Circle circle;
  circle.radius = radius;
  shape.geometry = circle;
  def.shapes.push_back(shape);
  return def;
}

BodyDef polygon_at(const Vec2& position, const std::vector<Vec2>& vertices, BodyType type) {
  BodyDef def;
  def.type = type;
  def.position = position;
  ShapeDef shape;
  shape.geometry = Polygon{vertices};
  def.shapes.push_back(shape);
  return def;
}

BodyDef floor_of(double width) { return box_at({0, -1}, width, 2, BodyType::kStatic); }

BodyDef with_friction(BodyDef def, double friction) {
  for (ShapeDef& shape : def.shapes) shape.material.friction = friction;
  return def;
}

BodyDef with_restitution(BodyDef def, double restitution) {
  for (ShapeDef& shape : def.shapes) shape.material.restitution = restitution;
  return def;
}

double mass_of(const BodyDef& def) {
  if (def.mass) return *def.mass;
  const ShapeDef& shape = def.shapes.at(0);
  if (const auto* box = std::get_if<Box>(&shape.geometry)) return shape.material.density * box->width * box->height;
  if (const auto* circle = std::get_if<Circle>(&shape.geometry))
    return shape.material.density * kPi * circle->radius * circle->radius;
  throw std::invalid_argument("mass_of knows boxes and circles");
}

double inertia_of(const BodyDef& def) {
  const ShapeDef& shape = def.shapes.at(0);
  if (const auto* box = std::get_if<Box>(&shape.geometry))
    return mass_of(def) * (box->width * box->width + box->height * box->height) / 12;
  const double radius = std::get<Circle>(shape.geometry).radius;
  return mass_of(def) * radius * radius / 2;
}

double kinetic_energy(const BodyDef& def, const BodyState& state) {
  if (def.type != BodyType::kDynamic) return 0;
  return 0.5 * mass_of(def) * state.velocity.squaredNorm() +
         0.5 * inertia_of(def) * state.angular_velocity * state.angular_velocity;
}

double degrees(double angle_deg) { return angle_deg * kPi / 180; }

Vec2 turned(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

std::vector<Vec2> corners_of(const BodyDef& def, const BodyState& state) {
  std::vector<Vec2> local;
  if (const auto* box = std::get_if<Box>(&def.shapes[0].geometry)) {
    const double w = box->width / 2, h = box->height / 2;
    local = {{-w, -h}, {w, -h}, {w, h}, {-w, h}};
  } else {
    local = std::get<Polygon>(def.shapes[0].geometry).vertices;
  }
  for (Vec2& corner : local) corner = state.position + turned(corner, state.angle);
  return local;
}

double overlap_of(const BodyDef& a, const BodyState& at_a, const BodyDef& b, const BodyState& at_b) {
  const Outline outline_a = outline_of(a, at_a), outline_b = outline_of(b, at_b);
  std::vector<Vec2> axes = normals_of(outline_a);
  for (const Vec2& normal : normals_of(outline_b)) axes.push_back(normal);
  add_axis_of_circle(outline_a, outline_b, axes);
  add_axis_of_circle(outline_b, outline_a, axes);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& axis : axes) least = std::min(least, overlap_along(axis, outline_a, outline_b));
  return std::max(0.0, least);
}

double overlap_max(const std::vector<BodyDef>& bodies, const std::vector<BodyState>& states) {
  double deepest = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      if (bodies[i].type == BodyType::kDynamic || bodies[j].type == BodyType::kDynamic)
        deepest = std::max(deepest, overlap_of(bodies[i], states[i], bodies[j], states[j]));
  return deepest;
}

std::string numbered(long number) {
  std::string text(1, '_');
  text.append(std::to_string(number));
  return text;
}

double Random::between(double low, double high) {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return low + (high - low) * (static_cast<double>(z >> 11) * 0x1p-53);
}

}  // namespace urto::accuracy

#pragma once

// A scene of the benchmark as its file describes it (bench/scenes.py says how).

#include <array>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace bench {

using Point = std::array<double, 2>;

struct Material {
  double density = 1, friction = 0.6, restitution = 0;
};
struct Box {
  Point half{}, center{};
};
struct Circle {
  double radius = 0;
  Point center{};
};
struct Capsule {
  Point a{}, b{};
  double radius = 0;
};
struct RoundedBox {
  Point half{};
  double rounding = 0;
};
struct Polygon {
  std::vector<Point> points;
};
struct Loop {
  std::vector<Point> points;
};

struct Shape {
  std::variant<Box, Circle, Capsule, RoundedBox, Polygon, Loop> geometry;
  Material material;
};

enum class BodyKind { kStatic, kKinematic, kDynamic };

struct Body {
  BodyKind kind = BodyKind::kStatic;
  Point position{}, velocity{};
  double angle = 0, spin = 0;
  bool awake = true, apart = false;
  std::vector<Shape> shapes;
};

struct Revolute {
  int a = 0, b = 0;
  Point at_a{}, at_b{};
  double motor_speed = 0, motor_torque = 0;
};

// Before step k its velocity is what leads from amplitude · sin(rate · (k − 1) · dt) to amplitude · sin(rate · k · dt).
struct Sway {
  int body = 0;
  double amplitude = 0, rate = 0;
  double velocity_before(int step, double time_step) const;
};

struct Scene {
  std::string name;
  int steps = 0;
  Point gravity{};
  bool sleep = true;
  std::set<std::string> needs;
  std::vector<Body> bodies;
  std::vector<Revolute> revolutes;
  std::vector<Sway> sways;
};

constexpr double kTimeStep = 1.0 / 60.0;
constexpr int kSubSteps = 4;

// Ends the program with a message if the file is not a scene.
Scene read_scene(const std::string& path);

}  // namespace bench

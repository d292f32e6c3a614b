#include "scene_file.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

namespace bench {
namespace {

[[noreturn]] void refuse(const std::string& path, int line, const std::string& what) {
  std::cerr << path << ":" << line << ": " << what << "\n";
  std::exit(2);
}

std::istream& operator>>(std::istream& in, Point& point) { return in >> point[0] >> point[1]; }
std::istream& operator>>(std::istream& in, Material& material) {
  return in >> material.density >> material.friction >> material.restitution;
}

std::vector<Point> rest_as_points(std::istream& in) {
  std::vector<Point> points;
  for (Point point; in >> point;) points.push_back(point);
  if (in.eof()) in.clear();
  return points;
}

// False: not a shape. A shape that is cut short leaves the stream failed.
bool read_shape(const std::string& word, std::istream& in, Body& body) {
  Shape shape;
  if (word == "box") {
    Box box;
    in >> box.half >> box.center >> shape.material;
    shape.geometry = box;
  } else if (word == "circle") {
    Circle circle;
    in >> circle.radius >> circle.center >> shape.material;
    shape.geometry = circle;
  } else if (word == "capsule") {
    Capsule capsule;
    in >> capsule.a >> capsule.b >> capsule.radius >> shape.material;
    shape.geometry = capsule;
  } else if (word == "rounded_box") {
    RoundedBox box;
    in >> box.half >> box.rounding >> shape.material;
    shape.geometry = box;
  } else if (word == "polygon") {
    in >> shape.material;
    shape.geometry = Polygon{rest_as_points(in)};
  } else if (word == "loop") {
    in >> shape.material.friction;
    shape.geometry = Loop{rest_as_points(in)};
  } else {
    return false;
  }
  body.shapes.push_back(std::move(shape));
  return true;
}

Body read_body(std::istream& in) {
  Body body;
  std::string kind;
  in >> kind >> body.position >> body.angle >> body.velocity >> body.spin >> body.awake;
  body.kind = kind == "dynamic" ? BodyKind::kDynamic : kind == "kinematic" ? BodyKind::kKinematic : BodyKind::kStatic;
  return body;
}

}  // namespace

double Sway::velocity_before(int step, double time_step) const {
  const double from = amplitude * std::sin(rate * (step - 1) * time_step);
  const double to = amplitude * std::sin(rate * step * time_step);
  return (to - from) / time_step;
}

Scene read_scene(const std::string& path) {
  std::ifstream file(path);
  if (!file) refuse(path, 0, "cannot be read");
  Scene scene;
  std::string line, word;
  for (int number = 1; std::getline(file, line); ++number) {
    std::istringstream in(line);
    in >> word;
    if (word == "scene") {
      in >> scene.name >> scene.steps >> scene.gravity >> scene.sleep;
    } else if (word == "needs") {
      for (std::string feature; in >> feature;) scene.needs.insert(feature);
      in.clear();
    } else if (word == "body") {
      scene.bodies.push_back(read_body(in));
    } else if (word == "revolute") {
      Revolute& joint = scene.revolutes.emplace_back();
      in >> joint.a >> joint.b >> joint.at_a >> joint.at_b >> joint.motor_speed >> joint.motor_torque;
    } else if (word == "sway") {
      Sway& sway = scene.sways.emplace_back();
      in >> sway.body >> sway.amplitude >> sway.rate;
    } else if (scene.bodies.empty()) {
      refuse(path, number, "a shape before any body, or an unknown word: " + word);
    } else if (word == "apart") {
      scene.bodies.back().apart = true;
    } else if (!read_shape(word, in, scene.bodies.back())) {
      refuse(path, number, "unknown word: " + word);
    }
    if (in.fail()) refuse(path, number, "cut short: " + line);
  }
  return scene;
}

}  // namespace bench

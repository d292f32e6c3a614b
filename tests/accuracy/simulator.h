#pragma once

// A physics engine as a case sees it. Urto's own stands on the public World; bench/accuracy/ has the peers', so that
// every engine runs the same cases.

#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "physics/definitions.h"
#include "physics/world.h"

namespace urto::accuracy {

// What a case asks for and an engine has not.
class Lacks : public std::runtime_error {
 public:
  explicit Lacks(const std::string& feature) : std::runtime_error(feature) {}
};

// A point where two bodies touched in the last step.
struct Touch {
  std::size_t a = 0, b = 0;    // numbers of the bodies
  Vec2 normal{0, 0};           // unit, from a to b
  double normal_impulse = 0;   // N·s over the last step
  double tangent_impulse = 0;  // N·s over the last step
};

class Simulator {
 public:
  virtual ~Simulator() = default;
  // Bodies are numbered from 0 in the order in which they come.
  virtual void add(const BodyDef& def) = 0;
  // Between two bodies that are there, by their numbers. Throws Lacks.
  virtual void join(std::size_t, std::size_t, const JointDef&) { throw Lacks("joints"); }
  virtual void step() = 0;
  virtual BodyState body(std::size_t number) const = 0;
  virtual void set_velocity(std::size_t number, const Vec2& velocity, double angular_velocity) = 0;
  virtual std::vector<Touch> touches() const = 0;
};

// Throws Lacks.
using Engine = std::function<std::unique_ptr<Simulator>(const WorldSettings& settings)>;

}  // namespace urto::accuracy

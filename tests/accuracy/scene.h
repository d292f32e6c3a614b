#pragma once

// What cases build their scenes from.

#include <cstdint>
#include <string>
#include <vector>

#include "physics/definitions.h"
#include "physics/world.h"

namespace urto::accuracy {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kGravity = 9.81;  // m/s², down

// Gravity, 1/60 s and 4 sub-steps unless a case says otherwise. Nothing sleeps: a sleeping body has no error.
struct Scene {
  struct Link {
    std::size_t a = 0, b = 0;  // numbers of the bodies
    JointDef def;              // without them
  };
  WorldSettings settings;
  std::vector<BodyDef> bodies;
  std::vector<Link> links;

  Scene() { settings.sleeping = false; }
  std::size_t add(const BodyDef& def) {
    bodies.push_back(def);
    return bodies.size() - 1;
  }
};

Scene weightless();

BodyDef box_at(const Vec2& position, double width, double height, BodyType type = BodyType::kDynamic);
BodyDef ball_at(const Vec2& position, double radius, BodyType type = BodyType::kDynamic);
BodyDef polygon_at(const Vec2& position, const std::vector<Vec2>& vertices, BodyType type = BodyType::kDynamic);
// A static box of this width whose top is y = 0.
BodyDef floor_of(double width);
BodyDef with_friction(BodyDef def, double friction);
BodyDef with_restitution(BodyDef def, double restitution);

// By hand, from the shape alone: of one box or one circle, with its density or the body's mass.
double mass_of(const BodyDef& def);
double inertia_of(const BodyDef& def);
double kinetic_energy(const BodyDef& def, const BodyState& state);

double degrees(double angle_deg);  // in radians
Vec2 turned(const Vec2& v, double angle);

// The corners of a body's one box or polygon where it is.
std::vector<Vec2> corners_of(const BodyDef& def, const BodyState& state);
// How deep two bodies of one shape each overlap, m; zero if they do not. By the separating axes of both.
double overlap_of(const BodyDef& a, const BodyState& at_a, const BodyDef& b, const BodyState& at_b);
// The deepest of all pairs.
double overlap_max(const std::vector<BodyDef>& bodies, const std::vector<BodyState>& states);

// For the names of cases: "_5".
std::string numbered(long number);

// Numbers that are the same with every compiler and library: splitmix64 (Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double between(double low, double high);

 private:
  std::uint64_t state_;
};

}  // namespace urto::accuracy

#pragma once

// What a user of the engine hands to it: plain descriptions, in double precision whatever the world's scalar is.
// SI units, radians, y up, counter-clockwise positive.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace urto {

using Vec2 = Eigen::Vector2d;

// A body's handle: generation · 2³² + slot + 1. Zero is no body. A removed body's id is not given out again.
using BodyId = std::uint64_t;

enum class BodyType : std::uint8_t { kStatic, kKinematic, kDynamic };
enum class Precision : std::uint8_t { kFloat, kDouble };
enum class BroadPhaseKind : std::uint8_t { kAuto, kBruteForce, kQuadtree, kBvh };
enum class NarrowPhaseKind : std::uint8_t { kSat, kGjk };
enum class SolverKind : std::uint8_t { kSoftStep, kThesis, kPrecise };  // kPrecise: double only
enum class Integrator : std::uint8_t { kSemiImplicitEuler, kExplicitEuler, kVerlet, kRungeKutta4 };
enum class Mixing : std::uint8_t { kGeometricMean, kMaximum, kMinimum, kAverage };

// Bounds of the engine. A call that would pass one is refused with kLimitReached or kInvalidValue.
inline constexpr std::uint32_t kBodiesMax = 1u << 20;
inline constexpr std::uint32_t kShapesPerBodyMax = 64;
inline constexpr std::uint32_t kPolygonInputVerticesMax = 64;
inline constexpr std::uint32_t kPolygonVerticesMax = 8;  // of one convex shape inside
inline constexpr std::uint32_t kChainVerticesMax = 4096;
inline constexpr std::uint32_t kForceFieldsMax = 16;
inline constexpr std::uint32_t kSubStepsMax = 64;
inline constexpr unsigned kThreadsMax = 64;
inline constexpr double kTimeStepMax = 0.1;      // s
inline constexpr double kCoordinateMax = 1e7;    // m
inline constexpr double kSpeedMax = 1e6;         // m/s an axis: what is set is checked, motion saturates
inline constexpr double kAngularSpeedMax = 1e6;  // rad/s, likewise
inline constexpr double kSizeMin = 1e-4;         // m, of an edge or a radius
inline constexpr double kSizeMax = 1e5;          // m
inline constexpr double kDensityMax = 1e9;       // kg/m²

struct Material {
  double density = 1;      // kg/m², (0, kDensityMax]
  double friction = 0.6;   // ≥ 0
  double restitution = 0;  // [0, 1]
};

// Two shapes touch if each one's mask has a bit of the other's category.
struct Filter {
  std::uint32_t category = 1;
  std::uint32_t mask = 0xffffffffu;
};

// A rectangle, grown by `radius` on all sides, which rounds its corners.
struct Box {
  double width = 1;   // m, before it is grown
  double height = 1;  // m
  Vec2 center{0, 0};  // m, body frame
  double angle = 0;   // rad, body frame
  double radius = 0;  // m ≥ 0
};

struct Circle {
  double radius = 0.5;  // m
  Vec2 center{0, 0};    // m, body frame
};

// A simple polygon of either winding, 3 to kPolygonInputVerticesMax vertices. What is concave, or has more than
// kPolygonVerticesMax vertices, is decomposed into convex shapes. It is grown by `radius` on all sides, which rounds
// its corners; such a one has to be convex and small enough to stay one shape.
struct Polygon {
  std::vector<Vec2> vertices;  // m, body frame
  double radius = 0;           // m ≥ 0
};

// All points within `radius` of the segment from a to b.
struct Capsule {
  Vec2 a{-0.5, 0}, b{0.5, 0};  // m, body frame, at least kSizeMin apart
  double radius = 0.25;        // m
};

// Terrain: a line of 2 to kChainVerticesMax vertices that stops what comes from the right of its direction and lets
// through what comes from the left, as the outline of a counter-clockwise polygon does. A floor is listed from right to
// left; the walls of a room clockwise. For bodies that are not dynamic. Bodies slide over its joints as over one line.
struct Chain {
  std::vector<Vec2> vertices;  // m, body frame; neighbours at least kSizeMin apart
  bool loop = false;           // the last vertex is joined to the first: 3 vertices at least
};

using Geometry = std::variant<Box, Circle, Polygon, Capsule, Chain>;

struct ShapeDef {
  Geometry geometry;
  Material material;
  Filter filter;
  bool sensor = false;
};

struct BodyDef {
  BodyType type = BodyType::kDynamic;
  Vec2 position{0, 0};          // m, of the body's origin
  double angle = 0;             // rad
  Vec2 velocity{0, 0};          // m/s, of the centre of mass
  double angular_velocity = 0;  // rad/s
  std::vector<ShapeDef> shapes;
  std::optional<double> mass;  // kg > 0; absent: from the densities
  double linear_damping = 0;   // 1/s ≥ 0
  double angular_damping = 0;  // 1/s ≥ 0
  double gravity_scale = 1;
  bool fixed_rotation = false;
  bool awake = true;
};

// Acceleration strength · r / (|r|² + softening²)^(3/2) towards the centre.
struct PointAttractor {
  Vec2 center{0, 0};
  double strength = 0;   // m³/s²
  double softening = 0;  // m ≥ 0
};

// Force −(linear + quadratic · |v|) · v at the centre of mass.
struct Drag {
  double linear = 0;     // kg/s ≥ 0
  double quadratic = 0;  // kg/m ≥ 0
};

// Force −stiffness · (r − center) − damping · v at the centre of mass.
struct Spring {
  Vec2 center{0, 0};
  double stiffness = 0;  // N/m ≥ 0
  double damping = 0;    // N·s/m ≥ 0
};

using ForceField = std::variant<PointAttractor, Drag, Spring>;

inline constexpr double kHitSpeedDefault = 1.0;  // m/s

// Asks for an event for each contact that is struck. The thesis's solver cannot tell.
struct HitEvents {
  double speed_min = kHitSpeedDefault;  // m/s ≥ 0: slower ones make no event
};

struct WorldSettings {
  Precision precision = Precision::kFloat;
  Vec2 gravity{0, -9.81};         // m/s²
  double time_step = 1.0 / 60.0;  // s, (0, kTimeStepMax]
  std::uint32_t sub_steps = 4;    // [1, kSubStepsMax]
  SolverKind solver = SolverKind::kSoftStep;
  Integrator integrator = Integrator::kSemiImplicitEuler;
  BroadPhaseKind broad_phase = BroadPhaseKind::kAuto;
  NarrowPhaseKind narrow_phase = NarrowPhaseKind::kSat;
  bool sleeping = true;
  bool continuous = true;
  Mixing friction_mixing = Mixing::kGeometricMean;
  Mixing restitution_mixing = Mixing::kMaximum;
  double restitution_threshold = 0.5;  // m/s ≥ 0
  std::vector<ForceField> fields;
  std::optional<HitEvents> hit_events;  // absent: none
};

}  // namespace urto

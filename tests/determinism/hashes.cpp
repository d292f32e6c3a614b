// Steps a list of worlds and prints the hash of their whole state on the way. Every compiler, optimisation level,
// processor and SIMD width has to print the same (docs/architecture.md, Determinism); golden.txt holds what they print.
//
// usage: determinism_hashes [--check GOLDEN]
//
// A world's line: its name, the number of steps, the hash. With --check it compares with the file once for each SIMD
// instruction set that this machine has, names each line that differs, and exits with 1; the first differing line of a
// world tells when it went apart.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "physics/solver/contact_kernels.h"
#include "physics/world.h"

namespace urto {
namespace {

constexpr int kHashes = 4;  // per world, evenly spread over its steps

// Fractions in [0, 1) without the standard library's distributions, whose results are not fixed by the standard.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  double operator()(double low, double high) { return low + (high - low) * (*this)(); }
  // Two dice as arguments of one call would be thrown in an order that compilers choose.
  Vec2 vector(const Vec2& low, const Vec2& high) {
    const double x = (*this)(low.x(), high.x());
    const double y = (*this)(low.y(), high.y());
    return Vec2(x, y);
  }

 private:
  std::uint64_t state_;
};

struct Case {
  std::string name;
  int steps;
  WorldSettings settings;
  std::function<void(World&)> fill;
};

BodyDef body(BodyType type, double x, double y, Geometry geometry, Material material = {}) {
  BodyDef def;
  def.type = type;
  def.position = Vec2(x, y);
  ShapeDef shape;
  shape.geometry = std::move(geometry);
  shape.material = material;
  def.shapes.push_back(std::move(shape));
  return def;
}

void add(World& world, const BodyDef& def) {
  const Expected<BodyId> id = world.add_body(def);
  if (!id) {
    std::fprintf(stderr, "a body was refused: %s = %s: %s\n", id.error().field.c_str(), id.error().value.c_str(),
                 id.error().message.c_str());
    std::exit(2);
  }
}

void add_ground(World& world, double half_width) {
  add(world, body(BodyType::kStatic, 0, -0.5, Box{2 * half_width, 1}));
}

void add_bin(World& world, double half_width, double height, Material material) {
  add(world, body(BodyType::kStatic, 0, -0.5, Box{2 * half_width + 2, 1}, material));
  add(world, body(BodyType::kStatic, -half_width - 0.5, height / 2, Box{1, height}, material));
  add(world, body(BodyType::kStatic, half_width + 0.5, height / 2, Box{1, height}, material));
}

void fill_pyramid(World& world) {
  constexpr int kRows = 8;
  add_ground(world, 20);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kRows - row; ++column)
      add(world, body(BodyType::kDynamic, (column - 0.5 * (kRows - row - 1)) * 1.05, row + 0.5, Box{1, 1}));
}

Polygon random_polygon(Dice& dice, double radius) {
  // Corners of a square, each pushed along its two edges: convex for any dice below a half.
  Polygon polygon;
  const double a = radius * dice(0.2, 0.9), b = radius * dice(0.2, 0.9);
  polygon.vertices = {{-radius, -a}, {b, -radius}, {radius, a}, {-b, radius}};
  return polygon;
}

// Boxes, discs, convex and concave polygons and compound bodies, with spin.
void fill_mixture(World& world) {
  Dice dice(42);
  Material material{1, 0.5, 0.3};
  add_bin(world, 5, 12, material);
  for (int index = 0; index < 60; ++index) {
    const double x = (index % 6 - 2.5) * 1.5 + dice(-0.1, 0.1), y = 1.5 + index / 6 * 1.3 + dice(-0.1, 0.1);
    const double size = dice(0.3, 0.5);
    BodyDef def = body(BodyType::kDynamic, x, y, Box{2 * size, size}, material);
    if (index % 5 == 1) def.shapes[0].geometry = Circle{size};
    if (index % 5 == 2) def.shapes[0].geometry = random_polygon(dice, size);
    if (index % 5 == 3) {
      Polygon letter;
      letter.vertices = {{-size, -size},      {size, -size}, {size, -0.3 * size}, {-0.3 * size, -0.3 * size},
                         {-0.3 * size, size}, {-size, size}};
      def.shapes[0].geometry = letter;
    }
    if (index % 5 == 4) {
      ShapeDef wheel;
      wheel.geometry = Circle{0.4 * size, Vec2(size, 0)};
      wheel.material = material;
      def.shapes.push_back(wheel);
    }
    def.angle = dice(-3, 3);
    def.velocity = dice.vector(Vec2(-3, -3), Vec2(3, 3));
    def.angular_velocity = dice(-5, 5);
    def.linear_damping = index % 7 == 0 ? 0.1 : 0;
    def.angular_damping = index % 11 == 0 ? 0.2 : 0;
    add(world, def);
  }
}

void fill_discs(World& world) {
  Dice dice(3);
  add_bin(world, 4, 8, Material{1, 0, 1});
  for (int index = 0; index < 40; ++index) {
    BodyDef def =
        body(BodyType::kDynamic, (index % 8 - 3.5) * 0.9, 1 + index / 8 * 0.9, Circle{0.3}, Material{1, 0, 1});
    def.velocity = dice.vector(Vec2(-4, -4), Vec2(4, 4));
    add(world, def);
  }
}

// Thin plates at several hundred metres a second against thin walls, standing and turning ones.
void fill_bullets(World& world) {
  Dice dice(9);
  add(world, body(BodyType::kStatic, 10, 0, Box{0.1, 40}));
  add(world, body(BodyType::kStatic, -10, 0, Box{0.1, 40}));
  BodyDef door = body(BodyType::kKinematic, 0, 0, Box{0.2, 3});
  door.angular_velocity = 2;
  add(world, door);
  for (int index = 0; index < 20; ++index) {
    BodyDef def = body(BodyType::kDynamic, dice(-6, -3), -9 + index * 0.9, Box{0.3, 0.05});
    def.velocity = dice.vector(Vec2(200, -20), Vec2(500, 20));
    def.angular_velocity = dice(-60, 60);
    add(world, def);
  }
}

void fill_tumbler(World& world) {
  BodyDef drum = body(BodyType::kKinematic, 0, 0, Box{6.4, 0.2, Vec2(0, 3)});
  for (const auto& [width, height, x, y] :
       {std::array{6.4, 0.2, 0.0, -3.0}, {0.2, 6.4, 3.0, 0.0}, {0.2, 6.4, -3.0, 0.0}}) {
    ShapeDef wall;
    wall.geometry = Box{width, height, Vec2(x, y)};
    drum.shapes.push_back(wall);
  }
  drum.angular_velocity = 0.6;
  add(world, drum);
  for (int index = 0; index < 64; ++index)
    add(world, body(BodyType::kDynamic, (index % 8 - 3.5) * 0.45, (index / 8 - 3.5) * 0.45, Box{0.35, 0.35}));
}

void fill_orbits(World& world) {
  Dice dice(5);
  for (int index = 0; index < 12; ++index) {
    const double distance = 2 + 0.5 * index, speed = std::sqrt(40 / distance) + dice(-0.5, 0.5);
    const double side = index % 2 ? 1 : -1;
    const bool upright = index % 4 < 2;
    BodyDef def = body(BodyType::kDynamic, 0, 0, Box{0.1, 0.05}, Material{200});
    def.position = upright ? Vec2(0, side * distance) : Vec2(side * distance, 0);
    def.velocity = upright ? Vec2(-side * speed, 0) : Vec2(0, side * speed);
    def.angular_velocity = dice(-9, 9);
    add(world, def);
  }
}

void join(World& world, BodyId a, BodyId b, const Vec2& at_a, const Vec2& at_b, JointGeometry geometry,
          double break_force = kUnbreakable) {
  JointDef def;
  def.body_a = a;
  def.body_b = b;
  def.anchor_a = at_a;
  def.anchor_b = at_b;
  def.geometry = std::move(geometry);
  def.break_force = break_force;
  if (world.add_joint(def)) return;
  std::fprintf(stderr, "a joint was refused\n");
  std::exit(2);
}

// A grid of hinged discs, a bridge that breaks under what falls on it, and a joint of every other kind.
void fill_joints(World& world) {
  constexpr BodyId kGrid = 1;  // ids of a new world count from 1
  constexpr int kSide = 12;
  for (int index = 0; index < kSide * kSide; ++index) {
    const bool held = index % 40 == 0;
    add(world, body(held ? BodyType::kStatic : BodyType::kDynamic, index % kSide, 20 - index / kSide, Circle{0.4}));
    const BodyId id = kGrid + static_cast<BodyId>(index);
    if (index % kSide > 0) join(world, id - 1, id, Vec2(0.5, 0), Vec2(-0.5, 0), RevoluteJoint{});
    if (index >= kSide) join(world, id - kSide, id, Vec2(0, -0.5), Vec2(0, 0.5), RevoluteJoint{});
  }
  const BodyId bridge = kGrid + kSide * kSide;
  add_ground(world, 30);
  add(world, body(BodyType::kStatic, -1, 3, Box{1, 0.2}));
  for (int plank = 0; plank < 12; ++plank) add(world, body(BodyType::kDynamic, plank, 3, Box{0.9, 0.2}));
  add(world, body(BodyType::kStatic, 12, 3, Box{1, 0.2}));
  for (BodyId id = bridge + 1; id < bridge + 14; ++id)
    join(world, id, id + 1, Vec2(0.5, 0), Vec2(-0.5, 0), RevoluteJoint{}, 60);
  const BodyId loose = bridge + 15;
  for (int index = 0; index < 6; ++index) add(world, body(BodyType::kDynamic, -20 + 2 * index, 4, Box{1, 1}));
  const RevoluteJoint revolute{0.1, JointLimits{-1, 2}, JointMotor{true, 3, 20}, JointSpring{2, 0.3}};
  join(world, loose, loose + 1, Vec2(1, 0), Vec2(-1, 0), revolute);
  join(world, loose + 1, loose + 2, Vec2(0, 0), Vec2(0, 0.2), DistanceJoint{2.5, {}, JointSpring{3, 0.1}});
  join(world, loose + 2, loose + 3, Vec2(0, 0), Vec2(0, 0),
       PrismaticJoint{Vec2(1, 0.2), {}, JointLimits{1, 3}, {}, {}});
  join(world, loose + 3, loose + 4, Vec2(1, 0), Vec2(-1, 0), WeldJoint{{}, {}, JointSpring{4, 0.5}});
  join(world, 0, loose + 5, Vec2(0, 0), Vec2(0.4, 0), MouseJoint{Vec2(-8, 7), JointSpring{3, 0.7}, 60});
}

// What a room does to a world: impulses, forces, removals, teleports, in the middle of a run.
void disturb(World& world) {
  BodyColumns columns;
  world.capture(columns, false);
  for (std::size_t index = 0; index < columns.id.size(); index += 3) {
    const BodyId id = columns.id[index];
    if (index % 9 == 0) (void)world.apply_impulse(id, Vec2(0.5, 1.5), Vec2(columns.x[index] + 0.1, columns.y[index]));
    if (index % 9 == 3) (void)world.set_force(id, Vec2(1, 12), 0.2, true);
    if (index % 9 == 6) (void)world.remove_body(id);
  }
  add(world, body(BodyType::kDynamic, 0.3, 14, Box{1, 0.5}));
}

std::vector<Case> cases() {
  std::vector<Case> list;
  for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
    const std::string suffix = precision == Precision::kFloat ? "_float" : "_double";
    WorldSettings settings;
    settings.precision = precision;
    list.push_back({"pyramid" + suffix, 400, settings, fill_pyramid});
    list.push_back({"mixture" + suffix, 400, settings, fill_mixture});
    list.push_back({"discs" + suffix, 200, settings, fill_discs});
    list.push_back({"bullets" + suffix, 120, settings, fill_bullets});
    list.push_back({"tumbler" + suffix, 200, settings, fill_tumbler});
    list.push_back({"joints" + suffix, 400, settings, fill_joints});

    WorldSettings changed = settings;
    changed.narrow_phase = NarrowPhaseKind::kGjk;
    changed.broad_phase = BroadPhaseKind::kBruteForce;
    list.push_back({"mixture_gjk_brute_force" + suffix, 200, changed, fill_mixture});
    changed.narrow_phase = NarrowPhaseKind::kSat;
    changed.broad_phase = BroadPhaseKind::kQuadtree;
    list.push_back({"mixture_quadtree" + suffix, 200, changed, fill_mixture});
    changed.solver = SolverKind::kThesis;
    changed.sub_steps = 10;
    changed.friction_mixing = Mixing::kAverage;
    changed.restitution_mixing = Mixing::kMinimum;
    list.push_back({"mixture_thesis" + suffix, 100, changed, fill_mixture});

    for (const auto& [name, integrator] : {std::pair{"explicit_euler", Integrator::kExplicitEuler},
                                           {"semi_implicit_euler", Integrator::kSemiImplicitEuler},
                                           {"verlet", Integrator::kVerlet},
                                           {"runge_kutta_4", Integrator::kRungeKutta4}}) {
      WorldSettings flight = settings;
      flight.integrator = integrator;
      flight.gravity = Vec2(0, 0);
      flight.fields = {PointAttractor{Vec2(0, 0), 40, 0.05}, Drag{0.001, 0.002}, Spring{Vec2(1, 1), 0.001, 0.0005}};
      list.push_back({std::string("orbits_") + name + suffix, 400, flight, fill_orbits});
    }
  }
  WorldSettings precise;
  precise.precision = Precision::kDouble;
  precise.solver = SolverKind::kPrecise;
  list.push_back({"pyramid_precise", 40, precise, fill_pyramid});
  list.push_back({"discs_precise", 40, precise, fill_discs});
  return list;
}

// Not-a-numbers have signs and payloads that processors choose, so a state that holds one is no state to compare.
void check_finite(const World& world, const std::string& name) {
  BodyColumns columns;
  world.capture(columns, true);
  for (std::size_t index = 0; index < columns.id.size(); ++index) {
    const double sum = columns.x[index] + columns.y[index] + columns.angle[index] + columns.velocity_x[index] +
                       columns.velocity_y[index] + columns.angular_velocity[index];
    if (std::isfinite(sum)) continue;
    std::fprintf(stderr, "%s: body %zu is not finite after %llu steps\n", name.c_str(), index,
                 static_cast<unsigned long long>(world.step_count()));
    std::exit(2);
  }
}

std::vector<std::string> run(const Case& each) {
  std::vector<std::string> lines;
  Expected<std::unique_ptr<World>> world = World::create(each.settings);
  if (!world) {
    std::fprintf(stderr, "%s: the settings were refused: %s\n", each.name.c_str(), world.error().message.c_str());
    std::exit(2);
  }
  each.fill(**world);
  for (int part = 1; part <= kHashes; ++part) {
    for (int step = 0; step < each.steps / kHashes; ++step) (*world)->step();
    char line[160];
    std::snprintf(line, sizeof line, "%-36s %5llu %016llx", each.name.c_str(),
                  static_cast<unsigned long long>((*world)->step_count()),
                  static_cast<unsigned long long>((*world)->state_hash()));
    lines.emplace_back(line);
    check_finite(**world, each.name);
    if (part == 2) disturb(**world);
  }
  return lines;
}

std::vector<std::string> run_all() {
  std::vector<std::string> lines;
  for (const Case& each : cases())
    for (std::string& line : run(each)) lines.push_back(std::move(line));
  return lines;
}

int compare(const std::vector<std::string>& lines, const std::string& target, const char* path) {
  std::ifstream file(path);
  if (!file) {
    std::fprintf(stderr, "cannot read %s\n", path);
    return 2;
  }
  std::vector<std::string> golden;
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line[0] != '#') golden.push_back(line);
  int differing = golden.size() == lines.size() ? 0 : 1;
  if (differing) std::printf("%zu lines instead of %zu\n", lines.size(), golden.size());
  for (std::size_t index = 0; index < std::min(lines.size(), golden.size()); ++index) {
    if (lines[index] == golden[index]) continue;
    ++differing;
    std::printf("expected %s\nfound    %s\n", golden[index].c_str(), lines[index].c_str());
  }
  std::printf("%s: %zu hashes, %d differ\n", target.c_str(), lines.size(), differing);
  return differing ? 1 : 0;
}

}  // namespace
}  // namespace urto

int main(int count, char** arguments) {
  const bool check = count == 3 && std::strcmp(arguments[1], "--check") == 0;
  if (count != 1 && !check) {
    std::fprintf(stderr, "usage: determinism_hashes [--check GOLDEN]\n");
    return 2;
  }
  if (check) {
    int status = 0;
    for (const urto::SimdTarget& target : urto::simd_targets()) {
      urto::use_simd_target(target.id);
      status = std::max(status, urto::compare(urto::run_all(), target.name, arguments[2]));
    }
    return status;
  }
  std::printf("# Made by determinism_hashes: world, steps, hash of the whole state.\n");
  for (const std::string& line : urto::run_all()) std::printf("%s\n", line.c_str());
  return 0;
}

// What joints hold: a ball on a stiff spring that swings like a pendulum, and a chain that starts stretched.

#include <algorithm>
#include <cmath>

#include "accuracy/case.h"
#include "accuracy/cases/order.h"

namespace urto::accuracy {
namespace {

// ---- A pendulum by a stiff spring ----

constexpr double kRod = 1, kSpringHertz = 3;  // m; six times the frequency of the swing
constexpr double kReleaseAngle = 60;          // degrees from the vertical
constexpr double kSwing = 1;                  // s: about half a period

Vec2 release() { return turned({0, -kRod}, degrees(kReleaseAngle)); }

// The motion of a mass m on an undamped spring of length L and stiffness k from a fixed point:
//   x'' = g − ω² (|x| − L) x / |x|,  ω² = k / m = (2π · hertz)²
// which is not linear in x. It has no closed form; the classical Runge-Kutta method with 2·10⁵ steps a second has
// an error below the rounding of a double (h⁴ω⁴ ≈ 8e-17).
struct Swing {
  Vec2 x, v;
};

Vec2 pull(const Vec2& x) {
  const double rate = 2 * kPi * kSpringHertz, length = x.norm();
  return Vec2(0, -kGravity) - x * (rate * rate * (length - kRod) / length);
}

Vec2 swung(double time) {
  const long steps = std::lround(2e5 * time);
  const double h = time / static_cast<double>(steps);
  Swing at{release(), {0, 0}};
  for (long i = 0; i < steps; ++i) {
    const Vec2 v1 = at.v, a1 = pull(at.x);
    const Vec2 v2 = at.v + 0.5 * h * a1, a2 = pull(at.x + 0.5 * h * v1);
    const Vec2 v3 = at.v + 0.5 * h * a2, a3 = pull(at.x + 0.5 * h * v2);
    const Vec2 v4 = at.v + h * a3, a4 = pull(at.x + h * v3);
    at.x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    at.v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return at.x;
}

double pendulum_error(Lab& lab, double time_step, long steps) {
  static const Vec2 reference = swung(kSwing);
  Scene scene;
  scene.settings.time_step = time_step;
  scene.settings.sub_steps = 1;
  const std::size_t pivot = scene.add(ball_at({0, 0}, 0.1, BodyType::kStatic));
  const std::size_t ball = scene.add(ball_at(release(), 0.1));
  JointDef spring;
  DistanceJoint rod;
  rod.length = kRod;
  rod.spring = JointSpring{kSpringHertz, 0};
  spring.geometry = rod;
  scene.links.push_back({pivot, ball, spring});
  Run run(lab, scene);
  run.steps(steps);
  return (run.body(ball).position - reference).norm();
}

double pendulum(Lab& lab) {
  const long steps = std::lround(kSwing * 60 / lab.method().step_scale);
  return pendulum_error(lab, kSwing / static_cast<double>(steps) / lab.method().step_scale, steps);
}

// The first steps are coarser than the orbit's: the swing is over sooner.
double pendulum_order(Lab& lab) { return order_error(lab, kSwing, 1600, 200, pendulum_error); }

// ---- A chain stretched to twice its length ----

constexpr int kLinks = 20;
constexpr double kLinkLength = 1, kLinkThickness = 0.25;  // m

// Links in line from a fixed point, which all hinges start as far from holding together as a link is long: the chain
// lies along `direction` over twice the way that it can reach. A solver that pulls all gaps shut at once makes it fast,
// and it strikes itself into a knot.
Scene stretched_chain(const Vec2& direction) {
  Scene scene;
  const double angle = std::atan2(direction.y(), direction.x());
  std::size_t before = scene.add(ball_at({0, 0}, 0.1, BodyType::kStatic));
  for (int i = 0; i < kLinks; ++i) {
    BodyDef link = box_at(direction * (2 * (i + 0.5) * kLinkLength), kLinkLength, kLinkThickness);
    link.angle = angle;
    const std::size_t number = scene.add(link);
    JointDef hinge;
    hinge.geometry = RevoluteJoint{};
    if (i > 0) hinge.anchor_a = {kLinkLength / 2, 0};
    hinge.anchor_b = {-kLinkLength / 2, 0};
    scene.links.push_back({before, number, hinge});
    before = number;
  }
  return scene;
}

constexpr double kRestSeconds = 20;

// What the hinges are apart, all together, over the chain's length: 0 if it is whole again.
double chain_gap(Lab& lab, const Vec2& direction) {
  const Scene scene = stretched_chain(direction);
  Run run(lab, scene);
  run.seconds(kRestSeconds);
  double sum = 0;
  for (const Scene::Link& link : scene.links) {
    const BodyState a = run.body(link.a), b = run.body(link.b);
    const Vec2 at_a = a.position + turned(link.def.anchor_a, a.angle);
    sum += (b.position + turned(link.def.anchor_b, b.angle) - at_a).norm();
  }
  return sum / (kLinks * kLinkLength);
}

}  // namespace

void add_joint_cases(std::vector<Case>& cases) {
  cases.push_back({3,
                   "pendulum",
                   "a ball on a stiff spring of 1 m, let go at 60°, after 1 s",
                   "position error",
                   "m",
                   {},
                   pendulum,
                   Curves::kIntegrators});
  cases.push_back({3, "pendulum_order", "the same: the order in h", "deviation of the fitted order", "",
                   for_integrators(0.05), pendulum_order, Curves::kIntegrators});
  cases.push_back({30,
                   "chain_length",
                   "a chain of 20 links hangs stretched to twice its length, after 20 s",
                   "gaps of its hinges, over its length",
                   "relative",
                   {{Profile::kDefault, 0.01}},
                   [](Lab& lab) {
                     return chain_gap(lab, {0, -1});
                   }});
  cases.push_back({30,
                   "chain_length_across",
                   "the same chain starts level, and swings",
                   "gaps of its hinges, over its length",
                   "relative",
                   {{Profile::kDefault, 0.01}},
                   [](Lab& lab) {
                     return chain_gap(lab, {1, 0});
                   }});
}

}  // namespace urto::accuracy

#include "physics/solver/precise/collision.h"

#include <limits>

namespace urto {
namespace {

// A segment of the impact ends where slip ends, where compression ends, or where the work is done: no more than three
// kinds of slip and one end of compression.
constexpr int kSegmentsMax = 8;
constexpr int kFrictionSweeps = 64;

Vec2 tangent_of(const Vec2& normal) { return cross<double>(normal, 1.0); }

double inverse_mass_between(const Collision& c, const TouchPoint& p, const Vec2& u, const TouchPoint& q,
                            const Vec2& v) {
  return (c.a.inv_mass + c.b.inv_mass) * dot<double>(u, v) +
         cross<double>(p.arm_a, u) * cross<double>(q.arm_a, v) * c.a.inv_inertia +
         cross<double>(p.arm_b, u) * cross<double>(q.arm_b, v) * c.b.inv_inertia;
}

double energy_of(const Collision& c) {
  const auto of = [](const Body<double>& body, const Path& p) {
    return body.inv_mass == 0.0 ? 0.0
                                : 0.5 * (body.mass * (p.vx * p.vx + p.vy * p.vy) +
                                         (body.inv_inertia > 0.0 ? body.inertia * p.w * p.w : 0.0));
  };
  return of(c.a, c.path_a) + of(c.b, c.path_b);
}

// What the impact knows of itself as the normal impulse grows.
struct Progress {
  double knn, knt, ktt;  // 1/kg
  double friction;
  double vn, vt;  // m/s
  PointImpulse sum;

  // Sign of the slip, or of the slip that begins where the bodies do not slip; 0: they stick.
  double slip() const {
    if (friction == 0.0) return 0.0;
    if (vt != 0.0) return vt > 0.0 ? 1.0 : -1.0;
    if (absolute(knt) <= friction * ktt) return 0.0;
    return knt > 0.0 ? 1.0 : -1.0;
  }
  // Tangent impulse per normal impulse.
  double follow(double sign) const {
    if (friction == 0.0) return 0.0;
    return sign == 0.0 ? -knt / ktt : -sign * friction;
  }
  void advance(double impulse, double ratio) {
    vn += impulse * (knn + ratio * knt);
    vt += impulse * (knt + ratio * ktt);
    sum.normal += impulse;
    sum.tangent += impulse * ratio;
  }
};

// The normal impulse after which slip ends in a segment, or infinity.
double until_stick(const Progress& p, double sign, double ratio) {
  const double rate = p.knt + ratio * p.ktt;
  if (sign == 0.0 || p.vt == 0.0 || rate * sign >= 0.0) return std::numeric_limits<double>::infinity();
  return -p.vt / rate;
}

// Runs until the normal velocity is zero; returns the work the normal force took, J > 0.
double compress(Progress& p) {
  double work = 0;
  for (int i = 0; i < kSegmentsMax && p.vn < 0.0; ++i) {
    const double sign = p.slip(), ratio = p.follow(sign), rate = p.knn + ratio * p.knt;
    const double stick = until_stick(p, sign, ratio);
    const double stop = rate > 0.0 ? -p.vn / rate : std::numeric_limits<double>::infinity();
    const double impulse = min_of(stick, stop);
    if (!(impulse < std::numeric_limits<double>::max())) break;
    const double before = p.vn;
    p.advance(impulse, ratio);
    if (stop <= stick) p.vn = 0.0;
    if (stick <= stop) p.vt = 0.0;
    work -= 0.5 * impulse * (before + p.vn);
  }
  return work;
}

// Runs until the normal force has given the work back.
void restore(Progress& p, double work) {
  for (int i = 0; i < kSegmentsMax && work > 0.0; ++i) {
    const double sign = p.slip(), ratio = p.follow(sign), rate = p.knn + ratio * p.knt;
    if (!(rate > 0.0)) break;
    const double stick = until_stick(p, sign, ratio);
    // vn s + rate s²/2 = work
    const double done = 2 * work / (p.vn + std::sqrt(p.vn * p.vn + 2 * rate * work));
    const double before = p.vn;
    p.advance(min_of(stick, done), ratio);
    if (done <= stick) return;
    p.vt = 0.0;
    work -= 0.5 * stick * (before + p.vn);
  }
}

// The four numbers of two points: impulses that keep normal velocities from approaching, by trying which points push.
// Friction is brought in by sweeps; small and of two points, so they are cheap.
struct TwoPoints {
  Vec2 normal, tangent;
  const Touch& touch;
  const Collision& c;

  double velocity(const Vec2& u, int i) const {
    return parting_speed(u, touch.points[i].arm_a, c.path_a, touch.points[i].arm_b, c.path_b);
  }
  void push(const Vec2& u, double impulse, int i) const { apply(c, u * impulse, touch.points[i]); }

  void stop_approach(PointImpulse (&impulses)[2]) const {
    for (int sweep = 0; sweep < kFrictionSweeps; ++sweep) {
      solve_normals(impulses);
      resist(impulses);
    }
    solve_normals(impulses);
  }

  // The 2×2 complementarity problem by its four cases, as a change of the impulses at hand.
  void solve_normals(PointImpulse (&impulses)[2]) const {
    const double k0 = inverse_mass_between(c, touch.points[0], normal, touch.points[0], normal);
    const double k1 = inverse_mass_between(c, touch.points[1], normal, touch.points[1], normal);
    const double k01 = inverse_mass_between(c, touch.points[0], normal, touch.points[1], normal);
    const double v0 = velocity(normal, 0) - k0 * impulses[0].normal - k01 * impulses[1].normal;
    const double v1 = velocity(normal, 1) - k01 * impulses[0].normal - k1 * impulses[1].normal;
    double x0 = 0, x1 = 0;
    const double determinant = k0 * k1 - k01 * k01;
    const double both0 = (k01 * v1 - k1 * v0) / determinant, both1 = (k01 * v0 - k0 * v1) / determinant;
    if (determinant > 0.0 && both0 >= 0.0 && both1 >= 0.0) {
      x0 = both0;
      x1 = both1;
    } else if (v0 < 0.0 && v1 - k01 * v0 / k0 >= 0.0) {
      x0 = -v0 / k0;
    } else if (v1 < 0.0) {
      x1 = -v1 / k1;
    }
    push(normal, x0 - impulses[0].normal, 0);
    push(normal, x1 - impulses[1].normal, 1);
    impulses[0].normal = x0;
    impulses[1].normal = x1;
  }

  // Friction within what the normal impulses allow.
  void resist(PointImpulse (&impulses)[2]) const {
    for (int i = 0; i < 2; ++i) {
      const double k = inverse_mass_between(c, touch.points[i], tangent, touch.points[i], tangent);
      const double bound = c.friction * impulses[i].normal;
      const double next = clamp_to(impulses[i].tangent - velocity(tangent, i) / k, -bound, bound);
      push(tangent, next - impulses[i].tangent, i);
      impulses[i].tangent = next;
    }
  }
};

}  // namespace

void apply(const Collision& c, const Vec2& impulse, const TouchPoint& point) {
  c.path_a.vx -= c.a.inv_mass * impulse.x();
  c.path_a.vy -= c.a.inv_mass * impulse.y();
  c.path_a.w -= c.a.inv_inertia * cross<double>(point.arm_a, impulse);
  c.path_b.vx += c.b.inv_mass * impulse.x();
  c.path_b.vy += c.b.inv_mass * impulse.y();
  c.path_b.w += c.b.inv_inertia * cross<double>(point.arm_b, impulse);
}

PointImpulse collide_at_point(const Collision& c, const Vec2& normal, const TouchPoint& point) {
  const Vec2 tangent = tangent_of(normal);
  Progress p{inverse_mass_between(c, point, normal, point, normal),
             inverse_mass_between(c, point, normal, point, tangent),
             inverse_mass_between(c, point, tangent, point, tangent),
             c.friction,
             parting_speed(normal, point.arm_a, c.path_a, point.arm_b, c.path_b),
             parting_speed(tangent, point.arm_a, c.path_a, point.arm_b, c.path_b),
             {}};
  const double work = compress(p);
  restore(p, c.restitution * c.restitution * work);
  apply(c, normal * p.sum.normal + tangent * p.sum.tangent, point);
  return p.sum;
}

void collide_at_points(const Collision& c, const Touch& touch, PointImpulse (&impulses)[2]) {
  const double before = energy_of(c);
  const Path start_a = c.path_a, start_b = c.path_b;
  const TwoPoints two{touch.normal, tangent_of(touch.normal), touch, c};
  PointImpulse stop[2], more[2];
  two.stop_approach(stop);
  for (int i = 0; i < 2; ++i) {
    more[i].normal = c.restitution * stop[i].normal;
    two.push(two.normal, more[i].normal, i);
  }
  if (c.friction > 0.0)
    for (int sweep = 0; sweep < kFrictionSweeps; ++sweep) two.resist(more);
  for (int i = 0; i < 2; ++i) impulses[i] = {stop[i].normal + more[i].normal, stop[i].tangent + more[i].tangent};
  if (energy_of(c) <= before) return;
  c.path_a = start_a;
  c.path_b = start_b;
  for (int i = 0; i < 2; ++i) {
    impulses[i] = {(1 + c.restitution) * stop[i].normal, (1 + c.restitution) * stop[i].tangent};
    apply(c, touch.normal * impulses[i].normal + two.tangent * impulses[i].tangent, touch.points[i]);
  }
}

}  // namespace urto

#include "physics/solver/thesis.h"

#include "physics/motion.h"
#include "physics/narrow_phase/manifold.h"
#include "physics/narrow_phase/nearest_vertices.h"

namespace urto {
namespace {

template <class S>
struct Pair {
  Contact<S>& contact;
  const Body<S>&a, &b;
  Motion<S>&ma, &mb;
};

template <class S>
Transform<S> pose_now(const Body<S>& body, const Motion<S>& m) {
  Transform<S> x;
  x.q = Rotation<S>{m.c, m.s}.times(body.rotation());
  x.p = Vec<S>(body.x + m.dx, body.y + m.dy) - x.q.apply(body.local_center());
  return x;
}

// Half of the depth each; all of it for one against an unmovable one.
template <class S>
void push_apart(const Pair<S>& pair, const Vec<S>& normal, S depth) {
  const bool moves_a = pair.a.inv_mass > S(0), moves_b = pair.b.inv_mass > S(0);
  const S share_a = moves_a ? (moves_b ? S(0.5) : S(1)) : S(0), share_b = moves_b ? S(1) - share_a : S(0);
  pair.ma.dx -= share_a * depth * normal.x();
  pair.ma.dy -= share_a * depth * normal.y();
  pair.mb.dx += share_b * depth * normal.x();
  pair.mb.dy += share_b * depth * normal.y();
}

template <class S>
S inverse_mass_along(const Pair<S>& pair, const Vec<S>& ra, const Vec<S>& rb, const Vec<S>& u) {
  const S ca = cross<S>(ra, u), cb = cross<S>(rb, u);
  return pair.a.inv_mass + pair.b.inv_mass + ca * ca * pair.a.inv_inertia + cb * cb * pair.b.inv_inertia;
}

template <class S>
Vec<S> relative_velocity(const Pair<S>& pair, const Vec<S>& ra, const Vec<S>& rb) {
  return Vec<S>((pair.mb.vx - pair.mb.w * rb.y()) - (pair.ma.vx - pair.ma.w * ra.y()),
                (pair.mb.vy + pair.mb.w * rb.x()) - (pair.ma.vy + pair.ma.w * ra.x()));
}

template <class S>
void apply(const Pair<S>& pair, const Vec<S>& ra, const Vec<S>& rb, const Vec<S>& impulse) {
  pair.ma.vx -= pair.a.inv_mass * impulse.x();
  pair.ma.vy -= pair.a.inv_mass * impulse.y();
  pair.ma.w -= pair.a.inv_inertia * cross<S>(ra, impulse);
  pair.mb.vx += pair.b.inv_mass * impulse.x();
  pair.mb.vy += pair.b.inv_mass * impulse.y();
  pair.mb.w += pair.b.inv_inertia * cross<S>(rb, impulse);
}

template <class S>
struct PointImpulse {
  Vec<S> ra, rb;
  S normal = S(0), tangent = S(0);
};

// The normal impulses of all points are found from the velocities before any of them acts; found one after the other,
// the second point would see a body that the first has stopped already, and nothing would bounce.
template <class S>
void collide_at_points(const Pair<S>& pair, const Vec<S>& normal) {
  const int count = static_cast<int>(pair.contact.count);
  const Vec<S> tangent = cross<S>(normal, S(1));
  PointImpulse<S> impulses[2];
  for (int i = 0; i < count; ++i) {
    PointImpulse<S>& p = impulses[i];
    p.ra = Vec<S>(pair.contact.points[i].ax, pair.contact.points[i].ay);
    p.rb = Vec<S>(pair.contact.points[i].bx, pair.contact.points[i].by);
    const S vn = dot<S>(relative_velocity(pair, p.ra, p.rb), normal);
    const S kn = inverse_mass_along(pair, p.ra, p.rb, normal);
    if (vn < S(0) && kn > S(0)) p.normal = -(S(1) + pair.contact.restitution) * vn / (kn * S(count));
  }
  for (int i = 0; i < count; ++i) apply(pair, impulses[i].ra, impulses[i].rb, Vec<S>(normal * impulses[i].normal));
  if (pair.contact.friction > S(0)) {
    for (int i = 0; i < count; ++i) {
      PointImpulse<S>& p = impulses[i];
      const S vt = dot<S>(relative_velocity(pair, p.ra, p.rb), tangent);
      const S kt = inverse_mass_along(pair, p.ra, p.rb, tangent);
      const S bound = pair.contact.friction * p.normal;
      if (kt > S(0)) p.tangent = clamp_to(-vt / (kt * S(count)), -bound, bound);
    }
    for (int i = 0; i < count; ++i) apply(pair, impulses[i].ra, impulses[i].rb, Vec<S>(tangent * impulses[i].tangent));
  }
  for (int i = 0; i < count; ++i) {
    pair.contact.points[i].total_normal_impulse += impulses[i].normal;
    pair.contact.points[i].total_tangent_impulse += impulses[i].tangent;
  }
}

// Takes over where the shapes touch now; impulses of the step so far stay with the points of the same index.
template <class S>
void set_points(const Pair<S>& pair, const Vec<S>* points, int count, S separation, const Transform<S>& pose_a) {
  Contact<S>& c = pair.contact;
  c.count = static_cast<std::uint32_t>(count);
  for (int i = 0; i < count; ++i) {
    const Vec<S> p = pose_a.apply(points[i]);
    ManifoldPoint<S>& m = c.points[i];
    m.ax = p.x() - (pair.a.x + pair.ma.dx);
    m.ay = p.y() - (pair.a.y + pair.ma.dy);
    m.bx = p.x() - (pair.b.x + pair.mb.dx);
    m.by = p.y() - (pair.b.y + pair.mb.dy);
    m.separation = separation;
    m.id = static_cast<std::uint32_t>(i);
  }
}

// Looks at one pair in one sub-iteration.
template <class S>
void collide_pair(WorldData<S>& world, const Pair<S>& pair) {
  const Convex<S>&shape_a = world.convexes[pair.contact.shape_a], &shape_b = world.convexes[pair.contact.shape_b];
  const Transform<S> pose_a = pose_now(pair.a, pair.ma), pose_b = pose_now(pair.b, pair.mb);
  if (!shape_a.bounds(pose_a).overlaps(shape_b.bounds(pose_b))) return;  // the thesis's preliminary check
  const Transform<S> b_in_a = pose_a.inverse_times(pose_b);
  const LocalManifold<S> m = collide(shape_a, shape_b, b_in_a, S(0), world.settings.narrow_phase);
  if (m.count == 0) return;
  const Vec<S> normal = pose_a.q.apply(m.normal);
  S depth = -m.points[0].separation;
  if (m.count > 1) depth = max_of(depth, -m.points[1].separation);
  pair.contact.nx = normal.x();
  pair.contact.ny = normal.y();
  if (shape_a.count >= 3 && shape_b.count >= 3 && shape_a.radius + shape_b.radius == S(0)) {
    const NearestVertices<S> nearest = nearest_vertices(shape_a, placed(shape_b, b_in_a));
    set_points(pair, nearest.points, nearest.count, -depth, pose_a);
  } else {
    set_points(pair, &m.points[0].p, 1, -depth, pose_a);
  }
  push_apart(pair, normal, depth);
  collide_at_points(pair, normal);
}

template <class S>
void forget_points(WorldData<S>& world) {
  for (const ActiveContact& active : world.active) {
    Contact<S>& c = world.contacts[active.contact];
    if (c.sensor()) continue;
    c.count = 0;
    c.points[0] = c.points[1] = ManifoldPoint<S>{};
  }
}

}  // namespace

template <class S>
void solve_thesis(WorldData<S>& world) {
  const std::uint32_t n = world.settings.sub_steps;
  const Mover<S> mover(world, S(world.settings.time_step / n));
  forget_points(world);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t slot : world.awake) mover.fly(world.bodies[slot], world.motions[slot]);
    for (const ActiveContact& active : world.active) {
      Contact<S>& c = world.contacts[active.contact];
      if (c.sensor()) continue;
      collide_pair(world, Pair<S>{c, world.bodies[c.body_a], world.bodies[c.body_b], world.motions[c.body_a],
                                  world.motions[c.body_b]});
    }
  }
}

template void solve_thesis(WorldData<float>&);
template void solve_thesis(WorldData<double>&);

}  // namespace urto

#include "physics/solver/precise/touch.h"

#include "physics/motion.h"
#include "physics/narrow_phase/manifold.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {
namespace {

using Outline = Convex<double>;
using Manifold = LocalManifold<double>;

// Normals more parallel than this are the same direction: two faces that lie on each other.
constexpr double kSameDirection = 1e-3;
// Of two directions in which corners approach, this share of the greater speed makes them equal.
constexpr double kEvenly = 0.5;
constexpr std::uint32_t kNoCorner = 0xff;  // in the place of a corner's number
// 1 − cosine of the angle between a normal and the face that it is of: rounding.
constexpr double kFaceTurn = 1e-14;
constexpr double kTurningMin = 1e-12;  // rad/s, below which arcs are straight
constexpr double kTurnMax = 0.25;      // rad, to the middle of an interval: faster turns are not followed so far

std::uint32_t after(const Outline& shape, std::uint32_t i) { return i + 1 < shape.count ? i + 1 : 0; }

double separation_of(const Outline& reference, std::uint32_t face, const Outline& other) {
  const Vec2& normal = reference.normals[face];
  double least = dot<double>(normal, other.vertices[0]);
  for (std::uint32_t i = 1; i < other.count; ++i) least = min_of(least, dot<double>(normal, other.vertices[i]));
  return least - dot<double>(normal, reference.vertices[face]);
}

bool has_face_along(const Outline& shape, const Rotation<double>& turn, const Vec2& outward) {
  if (shape.count < 2) return false;
  const Vec2 local = turn.apply_inverse(outward);
  for (std::uint32_t i = 0; i < shape.count; ++i)
    if (dot<double>(shape.normals[i], local) > 1.0 - kFaceTurn) return true;
  return false;
}

std::uint32_t facing(const Outline& other, const Vec2& normal) {
  std::uint32_t face = 0;
  for (std::uint32_t i = 1; i < other.count; ++i)
    if (dot<double>(normal, other.normals[i]) < dot<double>(normal, other.normals[face])) face = i;
  return face;
}

// The part of the other shape's facing edge that lies over the reference face (Sutherland and Hodgman 1974).
Manifold over_face(const Outline& reference, std::uint32_t face, const Outline& other, double reach, bool flip) {
  Manifold m;
  const Vec2 normal = reference.normals[face], tangent(-normal.y(), normal.x());
  const std::uint32_t j1 = facing(other, normal), j2 = after(other, j1);
  const Vec2 origin = reference.vertices[face];
  const double width = dot<double>(tangent, reference.vertices[after(reference, face)] - origin);
  const Vec2 p = other.vertices[j1], q = other.vertices[j2], edge = q - p;
  const double tp = dot<double>(tangent, p - origin), tq = dot<double>(tangent, q - origin);
  m.normal = flip ? Vec2(-normal) : normal;
  if (tp < -kTouchDistance || tq > width + kTouchDistance) return m;
  const double span = tp - tq;
  const auto point_at = [&](double t) { return Vec2(p + edge * clamp_to((tp - t) / span, 0.0, 1.0)); };
  const Vec2 ends[2] = {span > 0.0 && tp > width ? point_at(width) : p, span > 0.0 && tq < 0.0 ? point_at(0.0) : q};
  const std::uint32_t corners[2] = {j1, j2};
  for (int i = 0; i < 2; ++i) {
    const double gap = dot<double>(normal, ends[i] - origin);
    if (gap > reach) continue;
    if (m.count == 1 && length<double>(ends[1] - ends[0]) < kTouchDistance) continue;
    m.points[m.count].p = ends[i] - normal * (0.5 * gap);
    m.points[m.count].separation = gap;
    m.points[m.count].id = (flip ? ManifoldIds::kFlip : 0u) | (face << 8) | corners[i];
    ++m.count;
  }
  return m;
}

struct Candidate {
  double separation;
  std::uint32_t face;
  bool flip;
};

// The faces that separate the two shapes best, or nearly so.
int best_faces(const Outline& a, const Outline& b, Candidate* out) {
  double best = 0;
  Candidate all[2 * kPolygonVerticesMax] = {};
  int count = 0;
  for (int side = 0; side < 2; ++side) {
    const Outline &reference = side == 0 ? a : b, &other = side == 0 ? b : a;
    for (std::uint32_t i = 0; i < reference.count; ++i) {
      all[count] = {separation_of(reference, i, other), i, side == 1};
      best = count == 0 ? all[0].separation : max_of(best, all[count].separation);
      ++count;
    }
  }
  int kept = 0;
  for (int i = 0; i < count; ++i)
    if (all[i].separation >= best - kTouchDistance) out[kept++] = all[i];
  return kept;
}

class Toucher {
 public:
  Toucher(const WorldData<double>& world, const Contact<double>& c, const Path& path_a, const Path& path_b)
      : a_(world.bodies[c.body_a]),
        b_(world.bodies[c.body_b]),
        path_a_(path_a),
        path_b_(path_b),
        at_a_(a_, path_a),
        at_b_(b_, path_b),
        apart_(between(a_, at_a_, b_, at_b_)) {}

  Touch polygons(const Outline& a, const Outline& b, double reach) const {
    const Outline moved = placed(b, frame_of(a_, at_a_, b_, at_b_));
    Candidate faces[2 * kPolygonVerticesMax] = {};
    const int count = best_faces(a, moved, faces);
    Touch best;
    if (faces[0].separation > reach) return best;
    double least_approach = 0;
    for (int i = 0; i < count; ++i) {
      const Candidate& f = faces[i];
      const Touch touch =
          in_world(f.flip ? over_face(moved, f.face, a, reach, true) : over_face(a, f.face, moved, reach, false));
      const double speed = approach(touch);
      if (i == 0) {
        best = touch;
        least_approach = speed;
        continue;
      }
      const bool corner = absolute(cross<double>(touch.normal, best.normal)) > kSameDirection;
      if (corner) {
        const double most = max_of(speed, least_approach), least = min_of(speed, least_approach);
        if (most > kRestSpeed && least <= kRestSpeed) return Touch{};  // they pass
        if (least >= kEvenly * most - kRestSpeed && best.count > 0 && touch.count > 0) return corner_touch(best, touch);
      }
      if (best.count == 0 || (touch.count > 0 && speed < least_approach - kRestSpeed)) {
        best = touch;
        least_approach = speed;
      }
    }
    return best;
  }

  Touch general(const Outline& a, const Outline& b, double reach) const {
    return in_world(collide(a, b, frame_of(a_, at_a_, b_, at_b_), reach, NarrowPhaseKind::kSat));
  }

 private:
  Touch in_world(const Manifold& m) const {
    Touch touch;
    touch.normal = at_a_.q.apply(m.normal);
    touch.count = m.count;
    for (int i = 0; i < m.count; ++i) {
      TouchPoint& p = touch.points[i];
      p.arm_a = at_a_.q.apply(m.points[i].p - a_.local_center());
      p.arm_b = p.arm_a - apart_;
      p.gap = m.points[i].separation;
      p.id = m.points[i].id;
    }
    return touch;
  }

  // Corner against corner, with as much reason for one face as for the other: any direction between theirs would do,
  // and the middle one is the same for a mirrored pair.
  static Touch corner_touch(const Touch& a, const Touch& b) {
    Touch touch;
    touch.normal = (a.normal + b.normal) / length<double>(a.normal + b.normal);
    touch.points[0] = a.points[0];
    touch.points[0].id = ManifoldIds::kCorners | kNoCorner;
    touch.count = 1;
    return touch;
  }

  double approach(const Touch& touch) const {
    double most = 0;
    for (int i = 0; i < touch.count; ++i) {
      const TouchPoint& p = touch.points[i];
      most = max_of(most, -parting_speed(touch.normal, p.arm_a, path_a_, p.arm_b, path_b_));
    }
    return most;
  }

  const Body<double>&a_, &b_;
  const Path &path_a_, &path_b_;
  Stance at_a_, at_b_;
  Vec2 apart_;
};

}  // namespace

double parting_speed(const Vec2& normal, const Vec2& arm_a, const Path& a, const Vec2& arm_b, const Path& b) {
  return normal.x() * ((b.vx - a.vx) - (b.w * arm_b.y() - a.w * arm_a.y())) +
         normal.y() * ((b.vy - a.vy) + (b.w * arm_b.x() - a.w * arm_a.x()));
}

// Where a face of the one meets a corner of the other, the gap is that of the corner (its centre if it is round) from
// the face: φ = n·(p − q) with n and q fixed to the face's body, so
//   φ″ = n·(p″ − q″) − 2 ω n·(1 × v),
// the centripetal and Coriolis terms in the frame of the face. Where two corners meet it is the distance of their
// centres d, and φ″ = n·(p″ − q″) + (t·v)²/d.
MiddleOfTouch middle_of(const WorldData<double>& world, const Contact<double>& contact, const Vec2& normal,
                        const TouchPoint& point, const Path& path_a, const Path& path_b, double duration) {
  const double wa = path_a.w, wb = path_b.w, fastest = max_of(absolute(wa), absolute(wb));
  MiddleOfTouch m;
  m.normal = normal;
  m.arm_a = point.arm_a;
  m.arm_b = point.arm_b;
  if (fastest < kTurningMin) return m;
  const Outline &a = world.convexes[contact.shape_a], &b = world.convexes[contact.shape_b];
  const bool face_a = has_face_along(a, Stance(world.bodies[contact.body_a], path_a).q, normal);
  const bool face_b = !face_a && has_face_along(b, Stance(world.bodies[contact.body_b], path_b).q, -normal);
  const double half = min_of(0.5 * duration, kTurnMax / fastest), radii = a.radius + b.radius;
  Rotation<double> turn_a, turn_b;
  rotation_by(half * wa, turn_a.c, turn_a.s);
  rotation_by(half * wb, turn_b.c, turn_b.s);
  const Vec2 velocity(path_b.vx - path_a.vx, path_b.vy - path_a.vy);
  const Vec2 apart = point.arm_a - point.arm_b + velocity * half;
  const Vec2 core_a = turn_a.apply(point.arm_a - normal * a.radius),
             core_b = turn_b.apply(point.arm_b + normal * b.radius);
  const Vec2 between_cores = core_b + apart - core_a;
  if (face_a || face_b) {
    m.normal = (face_a ? turn_a : turn_b).apply(normal);
  } else if (radii > 0.0 && length<double>(between_cores) > 0.5 * radii) {
    m.normal = between_cores / length<double>(between_cores);
  }
  m.arm_a = face_a ? Vec2(core_b + apart - m.normal * b.radius) : Vec2(core_a + m.normal * a.radius);
  m.arm_b = m.arm_a - apart;
  // The two material points whose gap it is: both at the corner, but for two corners.
  const Vec2 arm_a = face_a ? Vec2(core_b + apart) : core_a, arm_b = face_b ? Vec2(core_a - apart) : core_b;
  const Vec2 tangent = cross<double>(m.normal, 1.0);
  const Vec2 v = velocity + cross<double>(wb, arm_b) - cross<double>(wa, arm_a);
  const Vec2 arc = arm_a * (wa * wa) - arm_b * (wb * wb);
  double gain = dot<double>(m.normal, arc);
  if (face_a || face_b) {
    gain -= 2 * (face_a ? wa : wb) * dot<double>(m.normal, cross<double>(1.0, v));
  } else if (radii > 0.0) {
    gain += dot<double>(tangent, v) * dot<double>(tangent, v) / radii;
  }
  m.gain_normal = (duration - half) * gain;
  m.gain_tangent = (duration - half) * dot<double>(tangent, arc);
  return m;
}

Touch find_touch(const WorldData<double>& world, const Contact<double>& contact, const Path& path_a, const Path& path_b,
                 double reach) {
  const Outline &a = world.convexes[contact.shape_a], &b = world.convexes[contact.shape_b];
  const Toucher toucher(world, contact, path_a, path_b);
  const bool sharp = a.count >= 3 && b.count >= 3 && a.radius == 0.0 && b.radius == 0.0;
  return sharp ? toucher.polygons(a, b, reach) : toucher.general(a, b, reach);
}

}  // namespace urto

#include "physics/solver/precise/impact_time.h"

#include "physics/narrow_phase/gjk.h"
#include "physics/solver/precise/tolerances.h"

namespace urto {
namespace {

double size_of(double x, double y) { return std::sqrt(x * x + y * y); }

// One shape at a moment of its path.
struct Runner {
  const Body<double>& body;
  const Convex<double>& shape;
  const Path& path;
  double arm = 0;    // m, of the corner furthest from the centre of mass
  double reach = 0;  // m, the same with the radius
  Path now;
  Vec2 arms[kPolygonVerticesMax];  // m, world axes

  Runner(const Body<double>& b, const Convex<double>& convex, const Path& p) : body(b), shape(convex), path(p), now(p) {
    for (std::uint32_t i = 0; i < shape.count; ++i)
      arm = max_of(arm, length<double>(shape.vertices[i] - body.local_center()));
    reach = arm + shape.radius;
  }
  Stance move_to(double time) {
    now = path.from(time);
    const Stance stance(body, now);
    for (std::uint32_t i = 0; i < shape.count; ++i) arms[i] = stance.q.apply(shape.vertices[i] - body.local_center());
    return stance;
  }
  // The greatest turning speed until then.
  double turning(double end) const { return max_of(absolute(now.w), absolute(now.w + (end - now.since) * path.aw)); }
  bool turns() const { return now.w != 0.0 || path.aw != 0.0; }
};

// How the bodies move relative to each other from now on.
struct Relation {
  Vec2 apart, velocity;
  double acceleration, speed_max;  // m/s², m/s: bounds

  Relation(const Runner& a, const Stance& at_a, const Runner& b, const Stance& at_b, double end) {
    apart = between(a.body, at_a, b.body, at_b);
    velocity = Vec2(b.now.vx - a.now.vx, b.now.vy - a.now.vy);
    acceleration = size_of(b.path.ax - a.path.ax, b.path.ay - a.path.ay);
    speed_max = length<double>(velocity) + acceleration * (end - a.now.since);
  }
};

// The lower bound of the distance along a turning normal: smallest over all pairs of corners.
class Bound {
 public:
  Bound(const Runner& a, const Runner& b, const Relation& relation, const Vec2& normal, double turn, double turn_gain,
        double end)
      : a_(a), b_(b), normal_(normal), relation_(relation), turn_(turn) {
    const double wa = a.turning(end), wb = b.turning(end);
    const double wn = turn == 0.0 && turn_gain == 0.0 ? 0.0 : max_of(wa, wb);
    const double away = length<double>(relation.apart) + relation.speed_max * (end - a.now.since) + a.arm + b.arm;
    curve_ = relation.acceleration + (wa * wa + absolute(a.path.aw)) * a.arm + (wb * wb + absolute(b.path.aw)) * b.arm +
             2 * wn * (relation.speed_max + wa * a.arm + wb * b.arm) +
             (wn * wn + absolute(turn_gain)) * (wn > 0.0 ? away : 0.0);
  }

  // Seconds until the bound falls to level; `span` if it does not before that. closing: it falls already now.
  double time_above(double level, double span, bool& closing) const {
    const Vec2 turned = cross<double>(turn_, normal_);
    double first = span;
    closing = false;
    for (std::uint32_t i = 0; i < a_.shape.count; ++i) {
      for (std::uint32_t j = 0; j < b_.shape.count; ++j) {
        const Vec2 d = relation_.apart + (b_.arms[j] - a_.arms[i]);
        const double c = dot<double>(normal_, d) - a_.shape.radius - b_.shape.radius - level;
        const Vec2 v = relation_.velocity + cross<double>(b_.now.w, b_.arms[j]) - cross<double>(a_.now.w, a_.arms[i]);
        const double rate = dot<double>(normal_, v) + dot<double>(turned, d);
        const double time = fall_time(c, rate, span);
        first = min_of(first, time);
        closing |= c <= kImpactDistance && rate < 0.0;
      }
    }
    return first;
  }

 private:
  // First down-crossing of c + rate s − curve s²/2.
  double fall_time(double c, double rate, double span) const {
    if (c <= 0.0 && rate <= 0.0) return 0.0;
    if (c + span * (rate - 0.5 * curve_ * span) > 0.0) return span;  // concave: it has not been below in between
    const double under = rate * rate + 2 * curve_ * c;
    if (under <= 0.0) return 0.0;
    const double root = std::sqrt(under);
    return rate > 0.0 ? (curve_ > 0.0 ? (rate + root) / curve_ : span) : 2 * c / (root - rate);
  }

  const Runner &a_, &b_;
  Vec2 normal_;
  const Relation& relation_;
  double turn_;
  double curve_;
};

}  // namespace

Encounter first_encounter(const WorldData<double>& world, const Contact<double>& contact, const Path& path_a,
                          const Path& path_b, double from, double to) {
  Runner a(world.bodies[contact.body_a], world.convexes[contact.shape_a], path_a);
  Runner b(world.bodies[contact.body_b], world.convexes[contact.shape_b], path_b);
  double time = from, level = 0.5 * kImpactDistance;
  for (int advance = 0; advance < kAdvancesMaxPrecise; ++advance) {
    const Stance at_a = a.move_to(time), at_b = b.move_to(time);
    const Relation relation(a, at_a, b, at_b, to);
    const double rest = to - time;
    // Discs around the centres: what serves bodies far from each other.
    const double room = length<double>(relation.apart) - a.reach - b.reach;
    if (room > relation.speed_max * rest) return {};
    const Distance<double> d = gjk_distance(a.shape, b.shape, frame_of(a.body, at_a, b.body, at_b));
    if (advance == 0) level = min_of(level, d.separation);  // what parts is followed from where it is
    const Vec2 normal = at_a.q.apply(d.normal);
    bool closing = false, closing_edge = false;
    const Bound still(a, b, relation, normal, 0.0, 0.0, to);
    double step = still.time_above(level, rest, closing);
    const bool edge_a = d.edge_a && a.turns(), edge_b = !edge_a && d.edge_b && b.turns();
    if (step < rest && (edge_a || edge_b)) {
      const Runner& turner = edge_a ? a : b;
      const Bound turning(a, b, relation, normal, turner.now.w, turner.path.aw, to);
      step = max_of(step, turning.time_above(level, rest, closing_edge));
      closing = closing && closing_edge;
    }
    if (step >= rest) return {};
    if (d.separation <= kImpactDistance && closing) return {true, time};
    if (room > 0.0) step = max_of(step, room / relation.speed_max);
    if (time + step == time) return {true, time};
    time += step;
  }
  return {true, time};
}

}  // namespace urto

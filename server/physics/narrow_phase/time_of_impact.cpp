#include "physics/narrow_phase/time_of_impact.h"

#include <limits>

#include "physics/narrow_phase/gjk.h"

namespace urto {
namespace {

// An advance ends at the target unless a body turns by more than a quarter circle or the nearest features change. The
// tests allow half of this for spinning plates of 1 mm at 1000 m/s, the worst that is known.
constexpr int kAdvancesMax = 64;
// Every round drops one pair of corners for good; more than a few pairs in one advance are rare.
constexpr int kRootRoundsMax = 16;

template <class S>
constexpr S kQuarterTurn = S(1.5707963);  // rounded down: the bounds below hold up to π/2

// sin α ≥ α − kSineBend·α² on [0, π/2]: (π/2 − 1)/(π/2)², rounded up.
template <class S>
constexpr S kSineBend = S(0.23134);

// One body on its way: its corners as seen from the centre of mass, in the body's frame.
template <class S>
struct Mover {
  const Convex<S>& shape;
  const Sweep<S>& sweep;
  S turn;       // rad over the whole step
  S reach = 0;  // m, of the corner furthest from the centre of mass
  Vec<S> arms[kPolygonVerticesMax];
  Rotation<S> q;

  Mover(const Convex<S>& convex, const Sweep<S>& motion)
      : shape(convex), sweep(motion), turn(motion.angle1 - motion.angle0) {
    for (std::uint32_t i = 0; i < shape.count; ++i) {
      arms[i] = shape.vertices[i] - sweep.local_center;
      reach = max_of(reach, dot(arms[i], arms[i]));
    }
    reach = std::sqrt(reach);
    q = Rotation<S>::from_angle(sweep.angle0);
  }

  void move_to(S t) {
    if (turn != S(0)) q = Rotation<S>::from_angle(sweep.angle0 + t * turn);
  }
};

// A lower bound of the height of an arm that turns, as height + rate·τ − bend·τ², τ in steps from now.
//
// The height along a direction is h·cos α + g·sin α after a turn of α. Up to a quarter turn
//   cos α ≥ 1 − α²/2, so  h·cos α ≥ h − max(h, 0)·α²/2, and
//   α ≥ sin α ≥ α − kSineBend·α², so  g·sin α ≥ g·α − kSineBend·max(g, 0)·α².
// The bound is exact in the first order, which makes the advancement converge quadratically, where the classic bound by
// speed of the furthest corner (Mirtich 1996) converges linearly.
template <class S>
struct HeightBound {
  S height, rate = S(0), bend = S(0);

  HeightBound(const Vec<S>& up, const Vec<S>& arm, S turn) : height(dot(up, arm)) {
    if (turn == S(0)) return;
    const S size = absolute(turn);
    const S g = turn < S(0) ? cross(up, arm) : -cross(up, arm);
    rate = g * size;
    bend = size * size * (S(0.5) * max_of(height, S(0)) + kSineBend<S> * max_of(g, S(0)));
  }
};

// Those of all corners of a shape that turns by `turn` a step against the direction.
template <class S>
struct HeightBounds {
  S height[kPolygonVerticesMax], rate[kPolygonVerticesMax], bend[kPolygonVerticesMax];
  std::uint32_t count;

  HeightBounds(const Mover<S>& mover, const Vec<S>& direction, S turn) : count(mover.shape.count) {
    const Vec<S> up = mover.q.apply_inverse(direction);
    for (std::uint32_t i = 0; i < count; ++i) {
      const HeightBound<S> bound(up, mover.arms[i], turn);
      height[i] = bound.height;
      rate[i] = bound.rate;
      bend[i] = bound.bend;
    }
  }

  S lowest(S tau, std::uint32_t& corner) const {
    corner = 0;
    S best = height[0] + tau * (rate[0] - tau * bend[0]);
    for (std::uint32_t i = 1; i < count; ++i) {
      const S value = height[i] + tau * (rate[i] - tau * bend[i]);
      if (value < best) {
        best = value;
        corner = i;
      }
    }
    return best;
  }
};

// A lower bound of the separation along a normal (from a to b) over a span of time to come. The normal turns with the
// body whose edge is nearest, or stays: any will do, but the right one makes the bound tight. Seen from the normal, the
// bodies turn by so much less and the line between the centres turns back.
//
// The sum of two minima of concave functions and of a concave one: concave, so that it falls below a level once only.
template <class S>
struct SeparationBound {
  S span;  // up to where the bound holds: a quarter turn of anything, or the rest of the step
  HeightBounds<S> a, b;
  S gap, speed, bend = S(0);  // of the centres along the normal, less both radii

  SeparationBound(const Mover<S>& mover_a, const Mover<S>& mover_b, const Vec<S>& normal, S normal_turn,
                  const Vec<S>& centers, const Vec<S>& motion, S rest)
      : span(rest), a(mover_a, -normal, mover_a.turn - normal_turn), b(mover_b, normal, mover_b.turn - normal_turn) {
    const S size = absolute(normal_turn);
    const S fastest = max_of(size, max_of(absolute(mover_a.turn - normal_turn), absolute(mover_b.turn - normal_turn)));
    if (fastest * rest > kQuarterTurn<S>) span = kQuarterTurn<S> / fastest;
    const HeightBound<S> line(normal, centers, -normal_turn);
    gap = (line.height - mover_a.shape.radius) - mover_b.shape.radius;
    speed = dot(normal, motion);
    if (size > S(0)) {
      // τ·(u·cos α + v·sin α) with u = speed: u·cos α ≥ u − max(u, 0)·α²/2 and α ≤ size·span; v·sin α ≥ −max(−v, 0)·α.
      const S v = normal_turn < S(0) ? -cross(normal, motion) : cross(normal, motion);
      bend = line.bend + size * (S(0.5) * max_of(speed, S(0)) * size * span + max_of(-v, S(0)));
      speed += line.rate;
    }
  }

  S at(S tau, std::uint32_t& corner_a, std::uint32_t& corner_b) const {
    return gap + tau * (speed - tau * bend) + (a.lowest(tau, corner_a) + b.lowest(tau, corner_b));
  }

  // Whether a corner no higher than `within` above the lowest of its shape moves towards the other shape.
  bool closing(S within) const { return speed + slowest(a, within) + slowest(b, within) < S(0); }

  // How long a pair of corners stays above level; it is above it now.
  S pair_time(std::uint32_t i, std::uint32_t j, S level) const {
    const S c = gap + (a.height[i] + b.height[j]) - level;
    const S rate = speed + a.rate[i] + b.rate[j], curve = bend + a.bend[i] + b.bend[j];
    if (c <= S(0)) return S(0);
    const S root = std::sqrt(rate * rate + S(4) * curve * c);
    return rate > S(0) ? (rate + root) / (S(2) * curve) : S(2) * c / (root - rate);
  }

  // A time up to span for which the separation stays above accept < aim; as long as can be had cheaply.
  S safe_time(S aim, S accept) const {
    std::uint32_t i, j;
    S end = span;
    S value = at(end, i, j);
    for (int round = 0; round < kRootRoundsMax && value < accept; ++round) {
      const S next = pair_time(i, j, aim);
      if (!(next < end)) break;
      end = next;
      value = at(end, i, j);
    }
    if (value >= accept) return end;
    // The chord of a concave function lies below it.
    const S start = at(S(0), i, j);
    return start > aim ? end * ((start - aim) / (start - value)) : S(0);
  }

 private:
  static S slowest(const HeightBounds<S>& bounds, S within) {
    std::uint32_t corner;
    const S low = bounds.lowest(S(0), corner);
    S rate = bounds.rate[corner];
    for (std::uint32_t i = 0; i < bounds.count; ++i) {
      if (bounds.height[i] <= low + within) rate = min_of(rate, bounds.rate[i]);
    }
    return rate;
  }
};

// How long discs around both centres stay apart by level: what serves bodies that spin far from each other. A shape
// that does not turn needs no disc.
template <class S>
S disc_time(const Mover<S>& a, const Mover<S>& b, const Vec<S>& normal, const Vec<S>& centers, const Vec<S>& motion,
            S level, S rest) {
  const auto reach_along = [](const Mover<S>& mover, const Vec<S>& direction) {
    if (mover.turn != S(0)) return mover.reach + mover.shape.radius;
    const Vec<S> up = mover.q.apply_inverse(direction);
    S reach = dot(up, mover.arms[0]);
    for (std::uint32_t i = 1; i < mover.shape.count; ++i) reach = max_of(reach, dot(up, mover.arms[i]));
    return reach + mover.shape.radius;
  };
  const S room = dot(normal, centers) - reach_along(a, normal) - reach_along(b, -normal) - level;
  if (room <= S(0)) return S(0);
  const S speed = dot(normal, motion);
  return speed >= S(0) || room >= -speed * rest ? rest : room / -speed;
}

// b's frame as seen from a's, by the difference of the centres: a world far from its origin costs no digits.
template <class S>
Transform<S> frame_of(const Mover<S>& a, const Mover<S>& b, const Vec<S>& centers) {
  Transform<S> b_in_a;
  b_in_a.q = a.q.inverse_times(b.q);
  b_in_a.p = (a.q.apply_inverse(centers) + a.sweep.local_center) - b_in_a.q.apply(b.sweep.local_center);
  return b_in_a;
}

}  // namespace

template <class S>
Impact<S> time_of_impact(const Convex<S>& shape_a, const Sweep<S>& sweep_a, const Convex<S>& shape_b,
                         const Sweep<S>& sweep_b, S target, S tolerance) {
  Mover<S> a(shape_a, sweep_a), b(shape_b, sweep_b);
  const Vec<S> start = sweep_b.c0 - sweep_a.c0;
  const Vec<S> motion = (sweep_b.c1 - sweep_b.c0) - (sweep_a.c1 - sweep_a.c0);
  S t = 0;
  for (int advance = 0; advance < kAdvancesMax; ++advance) {
    a.move_to(t);
    b.move_to(t);
    const Vec<S> centers = start + t * motion;
    const Distance<S> distance = gjk_distance(shape_a, shape_b, frame_of(a, b, centers));
    const S room = distance.separation - target;
    if (room < S(0)) return {advance == 0 ? ImpactKind::kOverlapped : ImpactKind::kHit, t, advance};
    const Vec<S> normal = a.q.apply(distance.normal);
    // Half of the tolerance keeps rounding from carrying the advance past the target.
    const S margin = S(0.5) * min_of(room, tolerance);
    const S aim = target + margin, accept = target + S(0.5) * margin;
    const S rest = S(1) - t;
    const SeparationBound<S> fixed(a, b, normal, S(0), centers, motion, rest);
    S step = fixed.safe_time(aim, accept);
    bool closing = fixed.closing(tolerance);
    const S edge_turn = distance.edge_a ? a.turn : (distance.edge_b ? b.turn : S(0));
    if (step < rest && edge_turn != S(0)) {
      const SeparationBound<S> turning(a, b, normal, edge_turn, centers, motion, rest);
      step = max_of(step, turning.safe_time(aim, accept));
      closing = closing && turning.closing(tolerance);
    }
    if (step < rest) step = max_of(step, disc_time(a, b, normal, centers, motion, aim, rest));
    if (step >= rest) return {ImpactKind::kSeparated, S(1), advance};
    if (room <= tolerance && closing) return {ImpactKind::kHit, t, advance};
    // Too close to tell a time from the next one: this is the target to the last digit.
    if (t + step == t) return {ImpactKind::kHit, t, advance};
    t += step;
  }
  return {ImpactKind::kFailed, t, kAdvancesMax};
}

template Impact<float> time_of_impact<float>(const Convex<float>&, const Sweep<float>&, const Convex<float>&,
                                             const Sweep<float>&, float, float);
template Impact<double> time_of_impact<double>(const Convex<double>&, const Sweep<double>&, const Convex<double>&,
                                               const Sweep<double>&, double, double);

}  // namespace urto

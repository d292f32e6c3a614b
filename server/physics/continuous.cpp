#include "physics/continuous.h"

#include <algorithm>

#include "physics/bounds.h"
#include "physics/joint_graph.h"
#include "physics/narrow_phase/gjk.h"
#include "physics/narrow_phase/time_of_impact.h"

namespace urto {
namespace {

// When a pair of shapes, at least one of a fast body, first touches; computed while its bodies had these stops.
template <class S>
struct ImpactEvent {
  S time;
  S stop_low, stop_high;
  Proxy low, high;
};

template <class S>
class ContinuousCollision {
 public:
  explicit ContinuousCollision(WorldData<S>& world) : world_(world) {}

  void run() {
    stretch_bounds();
    find_impacts();
    take_impacts_in_order();
    shorten_motions();
  }

 private:
  // The broad phase shall see the whole way of each fast body.
  void stretch_bounds() {
    stop_.assign(world_.bodies.size(), S(1));
    fast_.assign(world_.bodies.size(), 0);
    for (std::uint32_t slot : world_.scratch.fast) {
      fast_[slot] = 1;
      for (Proxy p = world_.bodies[slot].first_shape; p != kNone; p = world_.shapes[p].next) {
        Shape<S>& shape = world_.shapes[p];
        shape.fat = way_of(p).expanded(shape.reach + shape.margin);
        world_.broad_phase->move(p, shape.fat);
        proxies_.push_back(p);
      }
    }
  }

  // Bounds of a shape over the whole step: of all turns where it turns.
  Aabb<S> way_of(Proxy p) const {
    const Shape<S>& shape = world_.shapes[p];
    const Body<S>& body = world_.bodies[shape.body];
    const Motion<S>& m = world_.motions[shape.body];
    const Vec<S> way(m.dx, m.dy);
    if (m.da == S(0)) {
      const Aabb<S> box = tight_bounds(world_, p);
      return box.merged(Aabb<S>{box.lower + way, box.upper + way});
    }
    const Vec<S> from = body.center(), to = from + way;
    return Aabb<S>{from, from}.merged(Aabb<S>{to, to}).expanded(body.extent_max);
  }

  // The motion of a body between two moments of the step, standing still after its stop.
  Sweep<S> sweep_of(std::uint32_t slot, S from, S to) const {
    const Body<S>& body = world_.bodies[slot];
    const Motion<S>& m = world_.motions[slot];
    const S t0 = min_of(from, stop_[slot]), t1 = min_of(to, stop_[slot]);
    Sweep<S> sweep;
    sweep.local_center = body.local_center();
    sweep.c0 = Vec<S>(body.x + t0 * m.dx, body.y + t0 * m.dy);
    sweep.c1 = Vec<S>(body.x + t1 * m.dx, body.y + t1 * m.dy);
    sweep.angle0 = body.angle + t0 * m.da;
    sweep.angle1 = body.angle + t1 * m.da;
    return sweep;
  }

  void find_impacts() {
    const auto may_pass = [this](Proxy low, Proxy high) {
      const Shape<S>&a = world_.shapes[low], &b = world_.shapes[high];
      if (a.sensor() || b.sensor() || a.body == b.body || !filters_touch(a, b)) return false;
      return close_in_fast(a.body, b.body) && !kept_apart(world_, a.body, b.body);
    };
    world_.broad_phase->find_pairs_where(proxies_, may_pass, world_.scratch.pairs);
    for (const auto& [low, high] : world_.scratch.pairs) push_impact(low, high);
  }

  // m, no point of b comes nearer to a point of a by more than this in the step.
  S approach_max(std::uint32_t a, std::uint32_t b) const {
    const Motion<S>&ma = world_.motions[a], &mb = world_.motions[b];
    const Vec<S> way(mb.dx - ma.dx, mb.dy - ma.dy);
    return length<S>(way) + absolute(ma.da) * world_.bodies[a].extent_max +
           absolute(mb.da) * world_.bodies[b].extent_max;
  }

  // Bodies that move together, as the pieces of a heap do, cannot pass through each other however fast they are.
  bool close_in_fast(std::uint32_t a, std::uint32_t b) const {
    const Body<S>&ba = world_.bodies[a], &bb = world_.bodies[b];
    S thickness = ba.dynamic() ? ba.extent_min : bb.extent_min;
    if (bb.dynamic()) thickness = min_of(thickness, bb.extent_min);
    return approach_max(a, b) > S(kFastFraction) * thickness;
  }

  void push_impact(Proxy low, Proxy high) {
    ImpactEvent<S> event{S(1), stop_[world_.shapes[low].body], stop_[world_.shapes[high].body], low, high};
    if (!first_impact(low, high, event.time)) return;
    events_.push_back(event);
    std::push_heap(events_.begin(), events_.end(), later);
  }

  static bool later(const ImpactEvent<S>& x, const ImpactEvent<S>& y) {
    if (x.time != y.time) return x.time > y.time;
    return x.low != y.low ? x.low > y.low : x.high > y.high;
  }

  // A pair moves in at most two pieces: until the first of its bodies stops, and until the second does.
  bool first_impact(Proxy low, Proxy high, S& time) const {
    const std::uint32_t a = world_.shapes[low].body, b = world_.shapes[high].body;
    const S first = min_of(stop_[a], stop_[b]), second = max_of(stop_[a], stop_[b]);
    return impact_between(low, high, S(0), first, time) ||
           (first < second && impact_between(low, high, first, second, time));
  }

  bool impact_between(Proxy low, Proxy high, S from, S to, S& time) const {
    if (!(from < to)) return false;
    const Shape<S>&a = world_.shapes[low], &b = world_.shapes[high];
    const Convex<S>&ca = world_.convexes[low], &cb = world_.convexes[high];
    const Sweep<S> sa = sweep_of(a.body, from, to), sb = sweep_of(b.body, from, to);
    const S reach = min_of(a.reach, b.reach);
    // What touches already is the contact solver's business; what is near stops nearer.
    const S apart = gjk_distance(ca, cb, sa.pose(S(0)).inverse_times(sb.pose(S(0)))).separation;
    if (apart <= S(kImpactToleranceFraction) * reach) return false;
    // What is further apart than the pair can close in by needs no search.
    if (apart > approach_max(a.body, b.body) + reach) return false;
    const S target = min_of(S(kImpactTargetFraction) * reach, S(0.5) * apart);
    const Impact<S> impact = time_of_impact(ca, sa, cb, sb, target, S(0.25) * target);
    if (impact.kind == ImpactKind::kSeparated || impact.kind == ImpactKind::kOverlapped) return false;
    time = from + impact.time * (to - from);
    return true;
  }

  // Earliest first. An impact that was computed before one of its bodies was stopped is computed anew.
  void take_impacts_in_order() {
    while (!events_.empty()) {
      std::pop_heap(events_.begin(), events_.end(), later);
      const ImpactEvent<S> event = events_.back();
      events_.pop_back();
      const std::uint32_t a = world_.shapes[event.low].body, b = world_.shapes[event.high].body;
      if (event.stop_low != stop_[a] || event.stop_high != stop_[b]) {
        push_impact(event.low, event.high);
        continue;
      }
      if (fast_[a]) stop_[a] = min_of(stop_[a], event.time);
      if (fast_[b]) stop_[b] = min_of(stop_[b], event.time);
    }
  }

  void shorten_motions() {
    for (std::uint32_t slot : world_.scratch.fast) {
      Motion<S>& m = world_.motions[slot];
      const S t = stop_[slot];
      if (t == S(1)) continue;
      m.dx *= t;
      m.dy *= t;
      m.da *= t;
    }
  }

  WorldData<S>& world_;
  std::vector<S> stop_;             // by body slot: share of the step after which it stands
  std::vector<std::uint8_t> fast_;  // by body slot
  std::vector<Proxy> proxies_;
  std::vector<ImpactEvent<S>> events_;
};

}  // namespace

template <class S>
void collide_continuously(WorldData<S>& world) {
  std::vector<std::uint32_t>& fast = world.scratch.fast;
  fast.clear();
  for (std::uint32_t slot : world.awake)
    if (moves_fast(world.bodies[slot], world.motions[slot])) fast.push_back(slot);
  if (!fast.empty()) ContinuousCollision<S>(world).run();
}

template void collide_continuously(WorldData<float>&);
template void collide_continuously(WorldData<double>&);

}  // namespace urto

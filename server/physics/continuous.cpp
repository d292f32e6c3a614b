#include "physics/continuous.h"

#include <algorithm>

#include "physics/bounds.h"
#include "physics/constants.h"
#include "physics/contact_graph.h"
#include "physics/course.h"
#include "physics/impact.h"
#include "physics/motion_kernels.h"
#include "physics/narrow_phase/closing_kernels.h"
#include "physics/narrow_phase/gjk.h"
#include "physics/narrow_phase/manifold.h"

namespace urto {
namespace {

// m, how far the body's farthest point comes in the step, at most.
template <class S>
S way_of(const Body<S>& body, const Motion<S>& m) {
  return std::sqrt(m.dx * m.dx + m.dy * m.dy) + absolute(m.da) * body.extent_max;
}

// A dynamic body by its own thickness; a kinematic one may be too fast for whatever it meets.
template <class S>
bool moves_fast(const Body<S>& body, const Motion<S>& m) {
  return way_of(body, m) > (body.dynamic() ? S(kFastFraction) * body.extent_min : S(0));
}

// Up to this share of fast bodies, their contacts are cheaper to go through than all.
constexpr double kFewFast = 0.125;

// When a pair first touches; computed when its bodies had had so many impacts.
template <class S>
struct ImpactEvent {
  S time;
  std::uint32_t contact;
  Proxy low, high;
  std::uint32_t impacts_low, impacts_high;
};

// Bodies that move fast in this step, by awake index.
template <class S>
std::vector<std::uint32_t> list_fast(WorldData<S>& world) {
  std::vector<std::vector<std::uint32_t>>& lists = lists_by_part(world);
  world.team->share(world.awake.size(), kBodiesPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
    constexpr std::size_t kBlock = static_cast<std::size_t>(kLanes<S>);
    for (std::size_t i = begin; i < end; i += kBlock) {
      const std::uint32_t* const slots = &world.awake[i];
      const std::size_t count = std::min(kBlock, end - i);
      std::uint32_t fast = motion_kernels<S>().fast(world.bodies.data(), world.motions.data(), slots, count);
      for (; fast != 0; fast &= fast - 1) lists[part].push_back(slots[__builtin_ctz(fast)]);
    }
  });
  std::vector<std::uint32_t> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

template <class S>
class ContinuousCollision {
 public:
  ContinuousCollision(WorldData<S>& world, const std::vector<std::uint32_t>& fast)
      : world_(world), fast_(fast), courses_(world) {}

  void run() {
    const bool few = fast_.size() < kFewFast * world_.awake.size();
    cover_ways(few ? fast_ : world_.awake);
    few ? list_contacts_of_fast() : list_closing();
    find_first_impacts();
    take_impacts_in_order();
    change_motions();
  }

 private:
  // Finding pairs -----------------------------------------------------------------------------------------------

  // Places get the ways of this step: of the fast ones, or of all if the kernels shall look at them. Where one leads
  // out of the bounds that the broad phase knows they are stretched, so that there is a contact of every pair that may
  // meet.
  void cover_ways(const std::vector<std::uint32_t>& slots) {
    std::vector<std::vector<Proxy>>& fast = lists_by_part(world_);
    world_.team->share(slots.size(), kBodiesPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) note_way(slots[i], fast[part]);
      keep_leaving(fast[part]);
    });
    for (const std::vector<Proxy>& left : fast)
      for (Proxy p : left) stretch(p);
    update_broad_phase(world_);
  }

  void note_way(std::uint32_t slot, std::vector<Proxy>& out) {
    const Body<S>& body = world_.bodies[slot];
    const Motion<S>& m = world_.motions[slot];
    const bool fast = moves_fast(body, m);
    for (Proxy p = body.first_shape; p != kNone; p = world_.shapes[p].next) {
      Place<S>& place = world_.places[p];
      place.way_x = m.dx;
      place.way_y = m.dy;
      place.turn = absolute(m.da) * body.extent_max;
      place.fast = fast ? S(1) : S(0);
      const Shape<S>& shape = world_.shapes[p];
      if (fast && !shape.sensor() && !holds_way(shape, body, m)) out.push_back(p);
    }
  }

  // Of these proxies, those whose way leads out of their bounds.
  void keep_leaving(std::vector<Proxy>& proxies) const {
    constexpr std::size_t kBlock = static_cast<std::size_t>(kLanes<S>);
    const StepEnd<S> world = step_end(world_);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < proxies.size(); i += kBlock) {
      const std::size_t count = std::min(kBlock, proxies.size() - i);
      std::uint32_t leaving = motion_kernels<S>().leaving(world, &proxies[i], count);
      for (; leaving != 0; leaving &= leaving - 1) {
        const Proxy p = proxies[i + static_cast<std::size_t>(__builtin_ctz(leaving))];
        if (!world_.shapes[p].fat.contains(way_bounds(world_, p))) proxies[kept++] = p;
      }
    }
    proxies.resize(kept);
  }

  // Whether bounds hold the disc around a body all the way: the outline need not be gone round then.
  static bool holds_way(const Shape<S>& shape, const Body<S>& body, const Motion<S>& m) {
    const Vec<S> from(body.x, body.y), to(body.x + m.dx, body.y + m.dy);
    return shape.fat.contains(Aabb<S>{from, from}.merged(Aabb<S>{to, to}).expanded(body.extent_max));
  }

  void stretch(Proxy p) {
    Shape<S>& shape = world_.shapes[p];
    shape.fat = way_bounds(world_, p).expanded(shape.reach + shape.margin);
    world_.broad_phase->move(p, shape.fat);
    mark_moved(world_, p);
    world_.scratch.stretched.push_back(shape.body);
  }

  struct Batch {
    std::uint32_t count = 0;
    std::uint32_t a[kLanes<S>] = {}, b[kLanes<S>] = {}, contact[kLanes<S>] = {};
  };

  void flush(Batch& batch, std::vector<std::uint32_t>& out) const {
    note(closing_kernels<S>().closing(world_.places.data(), batch.a, batch.b), batch.count, batch.contact, out);
    batch.count = 0;
  }

  static void note(std::uint32_t found, std::uint32_t count, const std::uint32_t* contacts,
                   std::vector<std::uint32_t>& out) {
    for (found &= (1u << count) - 1; found != 0; found &= found - 1) out.push_back(contacts[__builtin_ctz(found)]);
  }

  bool noted_fast(Proxy p) const { return world_.places[p].fast > S(0); }

  // Of a few bodies, all contacts; which of these close in turns out when their impacts are sought.
  void list_contacts_of_fast() {
    for (const std::uint32_t slot : fast_) {
      for_each_contact_of(world_, slot, [&](std::uint32_t contact) {
        const Contact<S>& c = world_.contacts[contact];
        const bool listed = c.body_b == slot && noted_fast(c.shape_a);
        if (!c.sensor() && !listed) closing_.push_back(contact);
      });
    }
  }

  void list_closing() {
    std::vector<std::vector<std::uint32_t>>& lists = lists_by_part(world_);
    world_.team->share(world_.active.size(), kPairsPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
      Batch batch;
      for (std::size_t i = begin; i < end; ++i) {
        const ActiveContact& active = world_.active[i];
        if (active.sensor) continue;
        batch.a[batch.count] = active.shape_a;
        batch.b[batch.count] = active.shape_b;
        batch.contact[batch.count] = active.contact;
        if (++batch.count == static_cast<std::uint32_t>(kLanes<S>)) flush(batch, lists[part]);
      }
      flush(batch, lists[part]);
    });
    take_up(lists);
    for (auto& list : lists) list.clear();
    const auto& blocks = list_blocks(world_.touching);
    world_.team->share(blocks.size(), kBlocksPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const ContactBlockRest<S>& rest = *blocks[i].rest;
        const std::uint32_t found = closing_kernels<S>().swinging(world_.places.data(), rest.shape_a, rest.shape_b);
        note(found, blocks[i].block->count, rest.contact, lists[part]);
      }
    });
    take_up(lists);
  }

  void take_up(const std::vector<std::vector<std::uint32_t>>& lists) {
    for (const auto& list : lists) closing_.insert(closing_.end(), list.begin(), list.end());
  }

  void find_first_impacts() {
    std::vector<S> times(closing_.size(), S(1));
    world_.team->share(closing_.size(), kImpactsPerShare, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) find_impact(world_.contacts[closing_[i]], S(0), times[i]);
    });
    for (std::size_t i = 0; i < closing_.size(); ++i)
      if (times[i] < S(1)) note_impact(closing_[i], times[i]);
  }

  // Impacts of a pair -------------------------------------------------------------------------------------------

  // m, no point of b comes nearer to a point of a by more than this in a whole step. Seen from a body that turns, the
  // other's centre moves at D − ω × r and, as r changes, by up to ω·D more; what turns alike does not close in.
  S approach_max(std::uint32_t a, std::uint32_t b, S now) const {
    const Course<S> ca = courses_.of(a), cb = courses_.of(b);
    const Vec<S> way(cb.dx - ca.dx, cb.dy - ca.dy);
    const S reach_a = world_.bodies[a].extent_max, reach_b = world_.bodies[b].extent_max;
    const S plain = length<S>(way) + (absolute(ca.da) * reach_a + absolute(cb.da) * reach_b);
    if (ca.da == S(0) && cb.da == S(0)) return plain;
    const Vec<S> between = courses_.center_at(b, now) - courses_.center_at(a, now);
    const auto seen_turning = [&](S turn, S reach) {
      const Vec<S> turned(way.x() + turn * between.y(), way.y() - turn * between.x());
      return length<S>(turned) + (S(0.5) * absolute(turn) * length<S>(way) + absolute(cb.da - ca.da) * reach);
    };
    return min_of(plain, min_of(seen_turning(ca.da, reach_b), seen_turning(cb.da, reach_a)));
  }

  // Bodies that move together, as the pieces of a heap do, cannot pass through each other however fast they are.
  static bool passes(const Body<S>& a, const Body<S>& b, S way) {
    S thickness = a.dynamic() ? a.extent_min : b.extent_min;
    if (b.dynamic()) thickness = min_of(thickness, b.extent_min);
    return way > S(kFastFraction) * thickness;
  }

  // What touches does not close in where it touches, or the contact would have seen to it; but it may swing around that
  // place, and out behind the other if that is no thicker than the swing.
  bool may_swing_through(const Contact<S>& c) const {
    const Body<S>&a = world_.bodies[c.body_a], &b = world_.bodies[c.body_b];
    const S turn = absolute(courses_.of(c.body_b).da - courses_.of(c.body_a).da);
    if (!(turn * min_of(a.extent_max, b.extent_max) > S(kFastFraction) * (a.extent_min + b.extent_min))) return false;
    // A chain has no inside to sink into.
    return !world_.convexes[c.shape_a].chain_segment() && !world_.convexes[c.shape_b].chain_segment();
  }

  // Whether discs around the bodies are further apart than those come nearer.
  bool out_of_reach(const Contact<S>& c, S way, S now) const {
    const S discs = world_.bodies[c.body_a].extent_max + world_.bodies[c.body_b].extent_max;
    const S reach = min_of(world_.shapes[c.shape_a].reach, world_.shapes[c.shape_b].reach);
    const S near = S(1 + kDiscSlack) * (discs + way + reach);
    const Vec<S> between = courses_.center_at(c.body_b, now) - courses_.center_at(c.body_a, now);
    return dot(between, between) > near * near;
  }

  // The pair's next impact after `now`, if it has one in this step.
  bool find_impact(const Contact<S>& c, S now, S& time) const {
    // A contact that has a lane was solved in this step: what it lets come nearer may.
    if (c.has_lane() && !may_swing_through(c)) return false;
    const Body<S>&body_a = world_.bodies[c.body_a], &body_b = world_.bodies[c.body_b];
    const S approach = approach_max(c.body_a, c.body_b, now);
    if (!passes(body_a, body_b, approach)) return false;
    if (!c.has_lane() && out_of_reach(c, approach * (S(1) - now), now)) return false;
    const Convex<S>&a = world_.convexes[c.shape_a], &b = world_.convexes[c.shape_b];
    const Sweep<S> sa = courses_.sweep_from(c.body_a, now), sb = courses_.sweep_from(c.body_b, now);
    const S reach = min_of(world_.shapes[c.shape_a].reach, world_.shapes[c.shape_b].reach);
    const S apart = gjk_distance(a, b, sa.pose(S(0)).inverse_times(sb.pose(S(0)))).separation;
    S target, tolerance;
    if (!c.has_lane() && apart > S(kImpactToleranceFraction) * reach) {
      if (apart > approach * (S(1) - now) + reach) return false;
      target = min_of(S(kImpactTargetFraction) * reach, S(0.5) * apart);
      tolerance = S(0.25) * target;
    } else {
      if (!may_swing_through(c)) return false;
      target = min_of(apart, S(0)) - S(kImpactTargetFraction) * reach;
      tolerance = S(0.25 * kImpactTargetFraction) * reach;
    }
    const Impact<S> impact = time_of_impact(a, sa, b, sb, target, tolerance);
    if (impact.kind == ImpactKind::kSeparated || impact.kind == ImpactKind::kOverlapped) return false;
    time = now + impact.time * (S(1) - now);
    return time < S(1);
  }

  void note_impact(std::uint32_t contact, S time) {
    const Contact<S>& c = world_.contacts[contact];
    events_.push_back({time, contact, c.shape_a, c.shape_b, courses_.impacts(c.body_a), courses_.impacts(c.body_b)});
    std::push_heap(events_.begin(), events_.end(), later);
  }

  static bool later(const ImpactEvent<S>& x, const ImpactEvent<S>& y) {
    if (x.time != y.time) return x.time > y.time;
    return x.low != y.low ? x.low > y.low : x.high > y.high;
  }

  // Taking impacts ----------------------------------------------------------------------------------------------

  // An impact that was computed before one of its bodies had another is out of date, and looked for anew.
  void take_impacts_in_order() {
    while (!events_.empty()) {
      std::pop_heap(events_.begin(), events_.end(), later);
      const ImpactEvent<S> event = events_.back();
      events_.pop_back();
      const Contact<S>& c = world_.contacts[event.contact];
      if (event.impacts_low == courses_.impacts(c.body_a) && event.impacts_high == courses_.impacts(c.body_b)) {
        take_impact(c, event.time);
      } else {
        look_again(event.contact, max_of(courses_.of(c.body_a).since, courses_.of(c.body_b).since));
      }
    }
  }

  void look_again(std::uint32_t contact, S now) {
    S time;
    if (find_impact(world_.contacts[contact], now, time)) note_impact(contact, time);
  }

  // After a body took a course that leads where it would not have come.
  void look_around(std::uint32_t slot, S now) {
    for_each_contact_of(world_, slot, [&](std::uint32_t contact) {
      if (!world_.contacts[contact].sensor()) look_again(contact, now);
    });
  }

  // Nothing, if the two do not touch after all, as what comes at a chain from behind.
  Touch<S> touch_at(const Contact<S>& c, S now) const {
    const Transform<S> pose_a = courses_.sweep_from(c.body_a, now).pose(S(0));
    const Transform<S> b_in_a = pose_a.inverse_times(courses_.sweep_from(c.body_b, now).pose(S(0)));
    const LocalManifold<S> m = manifold_at(c, b_in_a);
    Touch<S> touch;
    touch.normal = pose_a.q.apply(m.normal);
    touch.count = m.count;
    for (int i = 0; i < m.count; ++i) {
      const Vec<S> point = pose_a.apply(m.points[i].p);
      touch.arms_a[i] = point - courses_.center_at(c.body_a, now);
      touch.arms_b[i] = point - courses_.center_at(c.body_b, now);
    }
    return touch;
  }

  LocalManifold<S> manifold_at(const Contact<S>& c, const Transform<S>& b_in_a) const {
    const Convex<S>&a = world_.convexes[c.shape_a], &b = world_.convexes[c.shape_b];
    const S reach = min_of(world_.shapes[c.shape_a].reach, world_.shapes[c.shape_b].reach);
    LocalManifold<S> m = collide(a, b, b_in_a, reach, world_.settings.narrow_phase);
    if (m.count > 0 || a.chain_segment() || b.chain_segment()) return m;
    // Corners that pass close by have no manifold where a face lies further off; but these two have met.
    const Distance<S> d = gjk_distance(a, b, b_in_a);
    m.normal = d.normal;
    m.add_point(S(0.5) * (d.point_a + d.point_b), d.separation, 0);
    return m;
  }

  void take_impact(const Contact<S>& c, S now) {
    const Touch<S> touch = touch_at(c, now);
    if (touch.count == 0) return;
    if (is_free(c.body_a) && is_free(c.body_b)) {
      bounce(c, touch, now);
    } else {
      give_way(c, touch, now);
    }
  }

  // Whether nothing holds the body but what it meets now.
  bool is_free(std::uint32_t slot) const {
    const Body<S>& body = world_.bodies[slot];
    if (!body.dynamic()) return true;
    const std::vector<std::uint64_t>& taken = world_.touching.taken;
    return world_.settings.solver == SolverKind::kSoftStep && body.awake() && body.first_joint == kNoJoint &&
           (slot >= taken.size() || taken[slot] == 0) && courses_.impacts(slot) < kImpactsMax;
  }

  // As gravity had made the velocity by now; what is left of the step adds the rest later.
  Twist<S> velocity_of(std::uint32_t slot, S now) const {
    const Body<S>& body = world_.bodies[slot];
    const Motion<S>& m = world_.motions[slot];
    Twist<S> twist{Vec<S>(m.vx, m.vy), m.w, body.inv_mass, body.inv_inertia};
    const S yet = (S(1) - now) * S(world_.settings.time_step);
    if (body.dynamic()) twist.v -= world_.settings.gravity.template cast<S>() * (body.gravity_scale * yet);
    return twist;
  }

  // Of a whole step.
  Twist<S> way_of_course(std::uint32_t slot) const {
    const Body<S>& body = world_.bodies[slot];
    const Course<S> course = courses_.of(slot);
    return {Vec<S>(course.dx, course.dy), course.da, body.inv_mass, body.inv_inertia};
  }

  void set_way(std::uint32_t slot, const Twist<S>& way) {
    Course<S>& course = courses_.latest(slot);
    course.dx = way.v.x();
    course.dy = way.v.y();
    course.da = way.w;
  }

  void bounce(const Contact<S>& c, const Touch<S>& touch, S now) {
    const Twist<S> before_a = velocity_of(c.body_a, now), before_b = velocity_of(c.body_b, now);
    const S closing = -normal_velocity(touch, before_a, before_b);
    if (!(closing > S(0))) return give_way(c, touch, now);
    const bool springs = closing > S(world_.settings.restitution_threshold);
    Twist<S> after_a = before_a, after_b = before_b;
    collide_at(touch, springs ? c.restitution : S(0), c.friction, after_a, after_b);
    change_velocity(c.body_a, before_a, after_a, now);
    change_velocity(c.body_b, before_b, after_b, now);
    // A way is not quite a velocity times the step: what still closes in is taken off.
    Twist<S> way_a = way_of_course(c.body_a), way_b = way_of_course(c.body_b);
    collide_at(touch, S(0), S(0), way_a, way_b);
    if (way_a.inv_mass > S(0)) set_way(c.body_a, way_a);
    if (way_b.inv_mass > S(0)) set_way(c.body_b, way_b);
    for (std::uint32_t slot : {c.body_a, c.body_b})
      if (world_.bodies[slot].dynamic()) look_around(slot, now);
    report(c, touch, now, closing);
  }

  void change_velocity(std::uint32_t slot, const Twist<S>& before, const Twist<S>& after, S now) {
    if (!world_.bodies[slot].dynamic()) return;
    const Vec<S> v = after.v - before.v;
    const S w = after.w - before.w, time_step = S(world_.settings.time_step);
    Motion<S>& m = world_.motions[slot];
    m.vx += v.x();
    m.vy += v.y();
    m.w += w;
    Course<S>& course = courses_.turn_at(slot, now);
    course.dx += v.x() * time_step;
    course.dy += v.y() * time_step;
    course.da += w * time_step;
  }

  // Whoever is fast goes on with what it met, and does not turn; for the second time it stops.
  void give_way(const Contact<S>& c, const Touch<S>& touch, S now) {
    const bool yields_a = yields(c.body_a, c.body_b), yields_b = yields(c.body_b, c.body_a);
    if (!yields_a && !yields_b) return;
    Twist<S> a = way_of_course(c.body_a), b = way_of_course(c.body_b);
    hold(a, yields_a);
    hold(b, yields_b);
    collide_at(touch, S(0), S(0), a, b);
    if (yields_a) go_on(c.body_a, a, pushes(c.body_b), now);
    if (yields_b) go_on(c.body_b, b, pushes(c.body_a), now);
  }

  static void hold(Twist<S>& way, bool yields) {
    way.inv_inertia = S(0);
    (yields ? way.w : way.inv_mass) = S(0);
  }

  void go_on(std::uint32_t slot, Twist<S> way, bool pushed, S now) {
    courses_.turn_at(slot, now);
    if (!pushed && courses_.impacts(slot) >= kWaysMax) way.v = Vec<S>::Zero();
    set_way(slot, way);
  }

  // What a kinematic body meets has no choice.
  bool pushes(std::uint32_t slot) const { return world_.bodies[slot].body_type() == BodyType::kKinematic; }

  bool yields(std::uint32_t slot, std::uint32_t other) const {
    const Body<S>& body = world_.bodies[slot];
    if (!body.dynamic() || courses_.impacts(slot) >= (pushes(other) ? kImpactsMax : kWaysMax)) return false;
    return pushes(other) || moves_fast(body, world_.motions[slot]);
  }

  // The two part again within the step: no manifold will ever tell of it.
  void report(const Contact<S>& c, const Touch<S>& touch, S now, S closing) {
    const bool hit = world_.settings.hit_events && closing > S(world_.settings.hit_events->speed_min);
    ContactEvent event = end_event(world_, c);
    const Vec<S> point = courses_.center_at(c.body_a, now) + touch.arms_a[0];
    event.point = Vec2(double(point.x()), double(point.y()));
    event.normal = Vec2(double(touch.normal.x()), double(touch.normal.y()));
    event.approach_speed = double(closing);
    const auto tell = [&](ContactEvent::Kind kind) {
      event.kind = kind;
      world_.events.push_back(event);
    };
    if (!c.touching()) tell(ContactEvent::Kind::kBegin);
    if (hit) tell(ContactEvent::Kind::kHit);
    if (!c.touching()) world_.events.push_back(end_event(world_, c));
  }

  void change_motions() {
    for (const Course<S>& course : courses_.changed()) {
      if (!world_.bodies[course.body].awake()) wake_body(world_, course.body);
      const S rest = S(1) - course.since;
      Motion<S>& m = world_.motions[course.body];
      m.dx = course.x + rest * course.dx;
      m.dy = course.y + rest * course.dy;
      m.da = course.a + rest * course.da;
    }
  }

  WorldData<S>& world_;
  const std::vector<std::uint32_t>& fast_;  // body slots
  Courses<S> courses_;
  std::vector<std::uint32_t> closing_;  // contacts
  std::vector<ImpactEvent<S>> events_;
};

}  // namespace

template <class S>
void collide_continuously(WorldData<S>& world) {
  const std::vector<std::uint32_t> fast = list_fast(world);
  if (!fast.empty()) ContinuousCollision<S>(world, fast).run();
}

template void collide_continuously(WorldData<float>&);
template void collide_continuously(WorldData<double>&);

}  // namespace urto

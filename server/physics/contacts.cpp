#include "physics/contacts.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "physics/constants.h"
#include "physics/contact_graph.h"
#include "physics/narrow_phase/box_kernels.h"
#include "physics/narrow_phase/manifold.h"
#include "physics/narrow_phase/polygon_kernels.h"
#include "physics/narrow_phase/rounded_kernels.h"
#include "physics/seams.h"
#include "physics/solver/contact_kernels.h"

namespace urto {
namespace {

template <class S>
struct WorldManifold {
  Vec<S> normal;   // from a to b, world frame
  Vec<S> between;  // m, from a's centre of mass to b's
  Vec<S> anchors[2];
  LocalManifold<S> local;
};

template <class S>
WorldManifold<S> manifold_of(const WorldData<S>& world, Proxy shape_a, Proxy shape_b, S reach) {
  const Body<S>&a = world.bodies[world.shapes[shape_a].body], &b = world.bodies[world.shapes[shape_b].body];
  const Transform<S> pose_a = a.pose(), b_in_a = pose_a.inverse_times(b.pose());
  WorldManifold<S> m;
  m.local = collide(world.convexes[shape_a], world.convexes[shape_b], b_in_a, reach, world.settings.narrow_phase);
  m.normal = pose_a.q.apply(m.local.normal);
  m.between = Vec<S>(b.x - a.x, b.y - a.y);
  for (int i = 0; i < m.local.count; ++i) m.anchors[i] = pose_a.q.apply(m.local.points[i].p - a.local_center());
  return m;
}

// What lies about in memory is asked for so early that it is there when it is needed: nothing else is waited for as
// long in scenes of some thousand bodies.
template <class S>
void fetch_place(const WorldData<S>& world, Proxy proxy) {
  __builtin_prefetch(&world.places[proxy]);
}
template <class S>
void fetch_outline(const WorldData<S>& world, Proxy proxy) {
  const auto* const line = reinterpret_cast<const char*>(&world.outlines[proxy]);
  __builtin_prefetch(line);
  __builtin_prefetch(line + 64);
}

// Touching contacts: their lanes ---------------------------------------------------------------------------------

template <class S>
void write_manifold(const WorldManifold<S>& m, std::uint32_t lane, ManifoldLanes<S>& out) {
  out.nx[lane] = m.normal.x();
  out.ny[lane] = m.normal.y();
  out.between_x[lane] = m.between.x();
  out.between_y[lane] = m.between.y();
  out.count[lane] = S(m.local.count);
  for (int i = 0; i < m.local.count; ++i) {
    out.x[i][lane] = m.anchors[i].x();
    out.y[i][lane] = m.anchors[i].y();
    out.separation[i][lane] = m.local.points[i].separation;
    out.id[i][lane] = S(m.local.points[i].id);
  }
}

template <class S>
void collide_side_by_side(const WorldData<S>& world, PairKind kind, const std::uint32_t* a, const std::uint32_t* b,
                          ManifoldLanes<S>& out) {
  if (kind == PairKind::kBoxes) {
    box_kernels<S>().collide(world.places.data(), a, b, out);
  } else if (kind == PairKind::kRounded) {
    rounded_kernels<S>().collide(world.places.data(), world.outlines.data(), a, b, out);
  } else {
    polygon_kernels<S>().collide(world.places.data(), world.outlines.data(), a, b, out);
  }
}

// Bit mask of the lanes that a kernel left to the general routine.
template <class S>
std::uint32_t asking_lanes(const ManifoldLanes<S>& manifolds) {
  std::uint32_t asking = 0;
  for (std::uint32_t lane = 0; lane < static_cast<std::uint32_t>(kLanes<S>); ++lane)
    asking |= static_cast<std::uint32_t>(manifolds.count[lane] == S(kAskGeneral)) << lane;
  return asking;
}

template <class S>
void copy_lanes(const ManifoldLanes<S>& from, std::uint32_t lanes, ManifoldLanes<S>& to) {
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::uint32_t>(__builtin_ctz(lanes));
    const auto copy = [lane](const auto& source, auto& target) { target[lane] = source[lane]; };
    copy(from.nx, to.nx);
    copy(from.ny, to.ny);
    copy(from.between_x, to.between_x);
    copy(from.between_y, to.between_y);
    copy(from.count, to.count);
    for (int i = 0; i < 2; ++i) {
      copy(from.x[i], to.x[i]);
      copy(from.y[i], to.y[i]);
      copy(from.separation[i], to.separation[i]);
      copy(from.id[i], to.id[i]);
    }
  }
}

template <class S>
void collide_lanes(const WorldData<S>& world, const ContactBlock<S>& block, const ContactBlockRest<S>& rest,
                   ManifoldLanes<S>& out) {
  const std::uint32_t used = (1u << block.count) - 1;
  // The kernel for rounded shapes also takes sharp polygons.
  const std::uint32_t outlines = rest.polygons | rest.rounded;
  std::uint32_t general = used & ~(rest.boxes | outlines);
  if (outlines != 0) {
    const PairKind kind = rest.rounded != 0 ? PairKind::kRounded : PairKind::kPolygons;
    collide_side_by_side(world, kind, rest.shape_a, rest.shape_b, out);
    general |= outlines & asking_lanes(out);
  }
  if (rest.boxes != 0) {
    ManifoldLanes<S> boxes;
    const bool alone = outlines == 0;
    collide_side_by_side(world, PairKind::kBoxes, rest.shape_a, rest.shape_b, alone ? out : boxes);
    if (!alone) copy_lanes(boxes, rest.boxes, out);
  }
  for (; general != 0; general &= general - 1) {
    const auto lane = static_cast<std::uint32_t>(__builtin_ctz(general));
    const Proxy a = rest.shape_a[lane], b = rest.shape_b[lane];
    write_manifold(manifold_of(world, a, b, reach_of(world.places[a], world.places[b])), lane, out);
  }
}

// Of a block that will be looked at soon.
template <class S>
void fetch_shapes(const WorldData<S>& world, const ContactBlockRest<S>& rest) {
  for (std::uint32_t lane = 0; lane < static_cast<std::uint32_t>(kLanes<S>); ++lane) {
    for (const Proxy proxy : {rest.shape_a[lane], rest.shape_b[lane]}) {
      fetch_place(world, proxy);
      if ((rest.polygons | rest.rounded) != 0) fetch_outline(world, proxy);
    }
  }
}

template <class S>
void take(const WorldData<S>& world, const ManifoldLanes<S>& manifolds, ContactBlock<S>& block,
          ContactBlockRest<S>& rest) {
  const bool half = block.count <= static_cast<std::uint32_t>(kLanes<S>) / 2;
  (half ? half_passes<S>() : contact_passes<S>()).take(world.motions.data(), manifolds, block, rest);
}

template <class S>
void list_parted(const ManifoldLanes<S>& manifolds, const ContactBlock<S>& block, const ContactBlockRest<S>& rest,
                 std::vector<std::uint32_t>& parted) {
  for (std::uint32_t lane = 0; lane < block.count; ++lane)
    if (manifolds.count[lane] == S(0)) parted.push_back(rest.contact[lane]);
}

template <class S>
bool any_parted(const ManifoldLanes<S>& manifolds, const ContactBlock<S>& block) {
  bool any = false;
  for (std::uint32_t lane = 0; lane < block.count; ++lane) any |= manifolds.count[lane] == S(0);
  return any;
}

// Contacts with unmovable bodies, whose blocks begin at `first`, are looked at together before any is taken over.
template <class S>
void update_ground_lanes(WorldData<S>& world, std::size_t first, std::vector<std::vector<std::uint32_t>>& parted) {
  const auto& blocks = world.touching.blocks;
  std::vector<ManifoldLanes<S>>& manifolds = world.scratch.manifolds;
  const std::size_t count = blocks.size() - first;
  if (manifolds.size() < count) manifolds.resize(count);
  world.team->share(count, kBlocksPerShare, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      collide_lanes(world, *blocks[first + i].block, *blocks[first + i].rest, manifolds[i]);
  });
  // By ground block; those by contact have been read by now.
  std::vector<std::uint8_t>& parts_here = world.scratch.findings;
  parts_here.resize(count);
  const std::size_t last_color = count - world.touching.colors[kColorsMax - 1].blocks.size();
  for (std::size_t i = 0; i < count; ++i)
    note_ground(world, i >= last_color, *blocks[first + i].block, *blocks[first + i].rest, manifolds[i]);
  join_seams(world);
  world.team->share(count, kBlocksPerShare, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      take(world, manifolds[i], *blocks[first + i].block, *blocks[first + i].rest);
      parts_here[i] = any_parted(manifolds[i], *blocks[first + i].block);
    }
  });
  finish_seams(world);
  // After those of all parts, so that the order does not depend on how many there are.
  for (std::size_t i = 0; i < count; ++i) {
    if (parts_here[i] != 0) list_parted(manifolds[i], *blocks[first + i].block, *blocks[first + i].rest, parted.back());
  }
}

// Leaves the contacts that part now in the lists by part.
template <class S>
void update_lanes(WorldData<S>& world) {
  list_blocks(world.touching);
  std::vector<std::vector<std::uint32_t>>& parted = lists_by_part(world);
  const auto& blocks = world.touching.blocks;
  std::size_t ground = 0;
  for (std::uint32_t color = 0; color < kMovableColors; ++color) ground += world.touching.colors[color].blocks.size();
  world.team->share(ground, kBlocksPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
    ManifoldLanes<S> manifolds{};
    for (std::size_t i = begin; i < end; ++i) {
      if (i + 1 < end) fetch_shapes(world, *blocks[i + 1].rest);
      collide_lanes(world, *blocks[i].block, *blocks[i].rest, manifolds);
      take(world, manifolds, *blocks[i].block, *blocks[i].rest);
      list_parted(manifolds, *blocks[i].block, *blocks[i].rest, parted[part]);
    }
  });
  update_ground_lanes(world, ground, parted);
  world.touching.current = true;
}

// They join the contacts that do not touch, with an event if they had touched.
template <class S>
void release_parted(WorldData<S>& world, std::uint32_t slot) {
  release_lane(world, slot);
  Contact<S>& c = world.contacts[slot];
  c.count = 0;
  c.nx = c.ny = S(0);
  c.points[0] = c.points[1] = ManifoldPoint<S>{};
  if (!c.touching()) return;
  toggle_touch(world, c);
  world.events.push_back(end_event(world, c));
}

// Contacts without a lane ----------------------------------------------------------------------------------------

template <class S>
void carry_over(const ManifoldPoint<S>* old, std::uint32_t old_count, ManifoldPoint<S>& point) {
  for (std::uint32_t i = 0; i < old_count; ++i) {
    if (old[i].id != point.id) continue;
    point.normal_impulse = old[i].normal_impulse;
    point.tangent_impulse = old[i].tangent_impulse;
    point.preload = old[i].preload;
    return;
  }
}

// Sets a record's manifold; impulses stay with their features.
template <class S>
void update_manifold(const WorldData<S>& world, Contact<S>& c) {
  const S reach = c.sensor() ? S(0) : reach_of(world.places[c.shape_a], world.places[c.shape_b]);
  const WorldManifold<S> m = manifold_of(world, c.shape_a, c.shape_b, reach);
  const ManifoldPoint<S> old[2] = {c.points[0], c.points[1]};
  const std::uint32_t old_count = c.count;
  c.nx = m.normal.x();
  c.ny = m.normal.y();
  c.count = static_cast<std::uint32_t>(m.local.count);
  for (int i = 0; i < 2; ++i) {
    ManifoldPoint<S>& p = c.points[i];
    p = ManifoldPoint<S>{};
    if (i >= m.local.count) continue;
    p.ax = m.anchors[i].x();
    p.ay = m.anchors[i].y();
    p.bx = p.ax - m.between.x();
    p.by = p.ay - m.between.y();
    p.separation = m.local.points[i].separation;
    p.id = m.local.points[i].id;
    carry_over(old, old_count, p);
  }
}

// m/s at which the surfaces close in at the first point.
template <class S>
S approach_speed(const WorldData<S>& world, const Contact<S>& c) {
  const Motion<S>&a = world.motions[c.body_a], &b = world.motions[c.body_b];
  const ManifoldPoint<S>& p = c.points[0];
  const S vx = (b.vx - b.w * p.by) - (a.vx - a.w * p.ay), vy = (b.vy + b.w * p.bx) - (a.vy + a.w * p.ax);
  return max_of(S(0), -(vx * c.nx + vy * c.ny));
}

// m, of a disc around the shape's centroid that holds it.
template <class S>
S disc_around(const Place<S>& place) {
  return place.half_height > S(0) ? place.half_width + place.half_height : -place.half_height;
}

// Whether discs around two shapes are out of each other's reach: then there is no manifold, and no need to ask a
// kernel.
template <class S>
bool discs_apart(const Place<S>& a, const Place<S>& b) {
  const auto smaller = [](S x, S y) { return x < y ? x : y; };  // no branch
  const S dx = b.x - a.x, dy = b.y - a.y;
  const S way = std::abs(b.way_x - a.way_x) + std::abs(b.way_y - a.way_y) + (a.turn + b.turn);
  const S reach = smaller(a.reach, b.reach) + smaller(way, smaller(a.bound, b.bound));
  // The share is for rounding.
  const S near = S(1 + kDiscSlack) * (disc_around(a) + disc_around(b) + reach);
  return dx * dx + dy * dy > near * near;
}

enum Finding : std::uint8_t { kApart = 0, kParted, kMet };

// Looks at contacts that do not touch yet, and notes what it finds by their index: kParted what has left the other's
// bounds, kMet what has a manifold now. Several may look at different contacts side by side.
template <class S>
class Lookout {
 public:
  explicit Lookout(WorldData<S>& world) : world_(world), lanes_(world.settings.solver == SolverKind::kSoftStep) {}

  void look_at(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i + kAhead < end) fetch(world_.active[i + kAhead]);
      look_at(static_cast<std::uint32_t>(i));
    }
    flush(boxes_);
    flush(polygons_);
    flush(rounded_);
  }

 private:
  static constexpr std::size_t kAhead = 12;  // pairs

  void fetch(const ActiveContact& active) const {
    for (const Proxy proxy : {active.shape_a, active.shape_b}) {
      fetch_place(world_, proxy);
      __builtin_prefetch(&world_.shapes[proxy].fat);
    }
  }

  void look_at(std::uint32_t index) {
    const ActiveContact& active = world_.active[index];
    if (!world_.shapes[active.shape_a].fat.overlaps(world_.shapes[active.shape_b].fat)) {
      world_.scratch.findings[index] = kParted;
      return;
    }
    const Place<S>&a = world_.places[active.shape_a], &b = world_.places[active.shape_b];
    const PairKind kind = pair_kind(a, b);
    if (!lanes_ || active.sensor || kind == PairKind::kGeneral) return update_one(index);
    if (kind == PairKind::kBoxes) return add(index, true, boxes_);
    const bool round = a.half_height != S(0) && b.half_height != S(0);
    add(index, !round || !discs_apart(a, b), kind == PairKind::kPolygons ? polygons_ : rounded_);
  }

  // What a kernel may take is looked at side by side.
  struct Batch {
    PairKind kind;
    std::uint32_t count = 0;
    std::uint32_t a[kLanes<S>] = {}, b[kLanes<S>] = {}, index[kLanes<S>] = {};
  };

  // Without a branch on `near`, which nobody could foretell.
  void add(std::uint32_t index, bool near, Batch& batch) {
    batch.a[batch.count] = world_.active[index].shape_a;
    batch.b[batch.count] = world_.active[index].shape_b;
    batch.index[batch.count] = index;
    batch.count += near ? 1 : 0;
    if (batch.kind != PairKind::kBoxes) {
      fetch_outline(world_, world_.active[index].shape_a);
      fetch_outline(world_, world_.active[index].shape_b);
    }
    if (batch.count == static_cast<std::uint32_t>(kLanes<S>)) flush(batch);
  }

  void flush(Batch& batch) {
    if (batch.count == 0) return;
    collide_side_by_side(world_, batch.kind, batch.a, batch.b, manifolds_);
    for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
      if (manifolds_.count[lane] > S(0)) world_.scratch.findings[batch.index[lane]] = kMet;
      if (manifolds_.count[lane] == S(kAskGeneral)) update_one(batch.index[lane]);
    }
    batch.count = 0;
  }

  void update_one(std::uint32_t index) {
    const ActiveContact& active = world_.active[index];
    if (lanes_ && !active.sensor) {
      // Its lane will have the manifold; to know that there is one is enough.
      const S reach = reach_of(world_.places[active.shape_a], world_.places[active.shape_b]);
      if (manifold_of(world_, active.shape_a, active.shape_b, reach).local.count > 0)
        world_.scratch.findings[index] = kMet;
      return;
    }
    Contact<S>& c = world_.contacts[active.contact];
    if (world_.settings.solver == SolverKind::kThesis && !c.sensor())
      return;  // it looks for itself, in every sub-iteration
    update_manifold(world_, c);
    if (c.count == 0) return;
    if (!c.touching() || world_.settings.hit_events) c.approach = approach_speed(world_, c);
    if (!c.sensor()) world_.scratch.findings[index] = kMet;
  }

  WorldData<S>& world_;
  const bool lanes_;
  Batch boxes_{PairKind::kBoxes}, polygons_{PairKind::kPolygons}, rounded_{PairKind::kRounded};
  ManifoldLanes<S> manifolds_{};
};

// Calls visit(index) for each finding that is one: few are, so eight are asked at a time.
template <class Visit>
void for_each_finding(const std::vector<std::uint8_t>& findings, const Visit& visit) {
  for (std::size_t i = 0; i < findings.size(); i += 8) {
    const std::size_t end = std::min(i + 8, findings.size());
    std::uint64_t eight = 0;
    std::memcpy(&eight, &findings[i], end - i);
    if (eight == 0) continue;
    for (std::size_t k = i; k < end; ++k)
      if (findings[k] != kApart) visit(k);
  }
}

template <class S>
void find_met_and_parted(WorldData<S>& world) {
  Scratch<S>& scratch = world.scratch;
  scratch.findings.assign(world.active.size(), kApart);
  world.team->share(world.active.size(), kPairsPerShare,
                    [&](unsigned, std::size_t begin, std::size_t end) { Lookout<S>(world).look_at(begin, end); });
  scratch.parted.clear();
  scratch.met.clear();
  for_each_finding(scratch.findings, [&](std::size_t i) {
    (scratch.findings[i] == kParted ? scratch.parted : scratch.met).push_back(world.active[i].contact);
  });
}

// Waking comes last: it makes further contacts active.
template <class S>
void update_active(WorldData<S>& world) {
  find_met_and_parted(world);
  const std::vector<std::uint32_t>& gone = world.scratch.parted;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (i + 4 < gone.size()) __builtin_prefetch(&world.contacts[gone[i + 4]]);
    destroy_contact(world, gone[i]);
  }
  for (std::uint32_t slot : world.scratch.met) {
    Contact<S>& c = world.contacts[slot];
    c.count = c.count > 0 ? c.count : 1;  // which it is, the lane will know
    if (world.settings.solver == SolverKind::kSoftStep) give_lane(world, slot);
  }
  for (std::uint32_t slot : world.scratch.met) {
    for (std::uint32_t body : {world.contacts[slot].body_a, world.contacts[slot].body_b})
      if (!world.bodies[body].awake() && world.bodies[body].dynamic()) wake_body(world, body);
  }
}

// Events ---------------------------------------------------------------------------------------------------------

template <class S>
ContactEvent begin_event(const WorldData<S>& world, const Contact<S>& c) {
  ContactEvent event = end_event(world, c);
  event.kind = ContactEvent::Kind::kBegin;
  const Body<S>& a = world.bodies[c.body_a];
  const ManifoldPoint<S>& p =
      c.count > 1 && c.points[1].separation < c.points[0].separation ? c.points[1] : c.points[0];
  event.point = Vec2(double(a.x + p.ax), double(a.y + p.ay));
  event.normal = Vec2(double(c.nx), double(c.ny));
  event.approach_speed = double(c.approach);
  return event;
}

template <class S>
bool meets(const Contact<S>& c) {
  for (std::uint32_t i = 0; i < c.count; ++i)
    if (c.points[i].separation <= S(0) || c.points[i].total_normal_impulse > S(0)) return true;
  return false;
}

template <class S>
void report_lane(WorldData<S>& world, std::uint32_t slot, const ContactBlockRest<S>& rest, std::uint32_t lane) {
  toggle_touch(world, world.contacts[slot]);
  Contact<S> c = settled(world, slot);
  c.approach = max_of(S(0), -rest.approach[0][lane]);
  world.events.push_back(c.touching() ? begin_event(world, c) : end_event(world, c));
}

template <class S>
void report_lanes(WorldData<S>& world) {
  const auto& blocks = list_blocks(world.touching);
  std::vector<std::vector<std::uint32_t>>& changed = lists_by_part(world);
  world.team->share(blocks.size(), kBlocksPerShare, [&](unsigned part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      ContactBlockRest<S>& rest = *blocks[i].rest;
      const std::uint32_t meeting = contact_passes<S>().meeting(*blocks[i].block, rest);
      if (meeting == rest.begun) continue;
      changed[part].push_back(static_cast<std::uint32_t>(i));
      changed[part].push_back(meeting ^ rest.begun);
      rest.begun = meeting;
    }
  });
  for (const std::vector<std::uint32_t>& list : changed) {
    for (std::size_t i = 0; i < list.size(); i += 2) {
      const ContactBlockRest<S>& rest = *blocks[list[i]].rest;
      for (std::uint32_t lanes = list[i + 1]; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::uint32_t>(__builtin_ctz(lanes));
        report_lane(world, rest.contact[lane], rest, lane);
      }
    }
  }
}

template <class S>
void report_active(WorldData<S>& world) {
  for (const ActiveContact& active : world.active) {
    // With lanes, only sensors can touch without one.
    if (world.settings.solver == SolverKind::kSoftStep && !active.sensor) continue;
    Contact<S>& c = world.contacts[active.contact];
    const bool meeting = meets(c);
    if (meeting == c.touching()) continue;
    toggle_touch(world, c);
    world.events.push_back(meeting ? begin_event(world, c) : end_event(world, c));
  }
}

}  // namespace

template <class S>
S reach_of(const Place<S>& a, const Place<S>& b) {
  const S wx = b.way_x - a.way_x, wy = b.way_y - a.way_y;
  const S way = std::sqrt(wx * wx + wy * wy) + (a.turn + b.turn);
  return min_of(a.reach, b.reach) + min_of(way, min_of(a.bound, b.bound));
}

template <class S>
void update_contacts(WorldData<S>& world) {
  update_active(world);
  update_lanes(world);
  for (const auto& parted : world.scratch.by_part)
    for (std::uint32_t slot : parted) release_parted(world, slot);
}

template <class S>
void report_contact_events(WorldData<S>& world) {
  report_lanes(world);
  report_active(world);
}

#define URTO_INSTANTIATE(S)                           \
  template void update_contacts(WorldData<S>&);       \
  template void report_contact_events(WorldData<S>&); \
  template S reach_of(const Place<S>&, const Place<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

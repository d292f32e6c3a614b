#include "physics/seams.h"

#include <algorithm>

#include "physics/constants.h"
#include "physics/narrow_phase/manifold.h"

namespace urto {
namespace {

// Contacts of one shape with the ground that are looked at together; a shape that lies on more slides over the rest as
// it would without this.
constexpr std::size_t kGroundContactsMax = 64;
constexpr int kNoVertex = -1;
// Of a point that stands in the contact with another plate than its own: no manifold has such an id, so that the corner
// takes its impulses along and no other point does.
constexpr std::uint32_t kUnited = 1u << 17;
constexpr std::uint32_t kUnitedAgain = 1u << 19;  // in every other step, so that it differs from the step before too

template <class S>
bool is_point(S id) {
  return id >= S(0) && id != S(kIdlePoint) && id != S(kGhostPoint);
}

// One contact with the ground, seen from the shape that moves: places are relative to its body's centre of mass.
template <class S>
struct Surface {
  const GroundLane<S>* lane = nullptr;
  Vec<S> normal = Vec<S>::Zero();       // from the ground to the shape
  S plane = 0;                          // along the normal, of the ground's face
  bool face = false;                    // the normal is that of a face of the ground
  int own[2] = {kNoVertex, kNoVertex};  // the shape's vertex at a point, if it is at one
  bool dropped[2] = {false, false};
  bool joined = false;  // a point was left to the neighbour beyond a seam
  int points = 0;       // before any was dropped

  bool kept(int i) const { return i < points && !dropped[i]; }
  ManifoldLanes<S>& now() const { return *lane->manifolds; }
  S& separation(int i) const { return now().separation[i][lane->lane]; }
  S& id(int i) const { return now().id[i][lane->lane]; }

  // m, of a point of the new manifold.
  Vec<S> point(int i) const {
    const std::uint32_t k = lane->lane;
    const Vec<S> from_a(now().x[i][k], now().y[i][k]);
    return lane->moves_b ? Vec<S>(from_a - Vec<S>(now().between_x[k], now().between_y[k])) : from_a;
  }
  void set_point(int i, const Vec<S>& place) {
    const std::uint32_t k = lane->lane;
    now().x[i][k] = place.x() + (lane->moves_b ? now().between_x[k] : S(0));
    now().y[i][k] = place.y() + (lane->moves_b ? now().between_y[k] : S(0));
  }
  // Points lie midway between the surfaces.
  Vec<S> on_ground(int i) const { return point(i) - normal * (S(0.5) * separation(i)); }

  // Of the manifold before, which still lies in the block.
  Vec<S> old_normal() const {
    const Vec<S> n(lane->block->nx[lane->lane], lane->block->ny[lane->lane]);
    return lane->moves_b ? n : Vec<S>(-n);
  }
  Vec<S> old_point(int i) const {
    const std::uint32_t k = lane->lane;
    const ContactBlock<S>& block = *lane->block;
    S along = block.points[i].along[k], lever = block.points[i].lever[k];
    if (lane->moves_b) {
      along -= block.between_along[k];
      lever -= block.between_lever[k];
    }
    const S nx = block.nx[k], ny = block.ny[k];
    return Vec<S>(along * nx + lever * ny, along * ny - lever * nx);
  }
};

// What a corner carried on ground that no longer holds it.
template <class S>
struct Orphan {
  Vec<S> normal = Vec<S>::Zero();
  S normal_impulse = 0, tangent_impulse = 0, preload = 0;
  bool there = false;
};

template <class S>
class SeamJoiner {
 public:
  SeamJoiner(WorldData<S>& world, Proxy shape)
      : world_(world),
        convex_(world.convexes[shape]),
        body_(world.bodies[world.shapes[shape].body]),
        reach_(world.shapes[shape].reach) {}

  void add(const GroundLane<S>& lane) {
    if (count_ == kGroundContactsMax) return;
    Surface<S>& s = surfaces_[count_++];
    s = Surface<S>{};
    s.lane = &lane;
    s.points = static_cast<int>(s.now().count[lane.lane]);
    const Vec<S> normal(s.now().nx[lane.lane], s.now().ny[lane.lane]);
    s.normal = lane.moves_b ? normal : Vec<S>(-normal);
    if (s.points > 0) find_face(s);
    for (int i = 0; i < s.points; ++i) s.own[i] = own_vertex(s.point(i), s.normal);
  }

  void join() {
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t k = 0; k < count_; ++k)
        if (i != k) drop_ghost(surfaces_[i], surfaces_[k]);
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t k = i + 1; k < count_; ++k)
        if (one_plane(surfaces_[i], surfaces_[k])) drop_seam_points(surfaces_[i], surfaces_[k]);
    for (std::size_t i = 0; i < count_; ++i) find_orphans(surfaces_[i]);
    for (std::size_t i = 0; i < count_; ++i) adopt(surfaces_[i]);
    for (std::size_t i = 0; i < count_; ++i) close_up(surfaces_[i]);
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t k = i + 1; k < count_; ++k) unite(surfaces_[i], surfaces_[k]);
  }

 private:
  S step() const { return S(kSeamStepFraction) * reach_; }
  S gap() const { return S(kSeamFraction) * reach_; }
  static bool same_direction(const Vec<S>& a, const Vec<S>& b) { return dot<S>(a, b) >= S(1 - kSeamTurn); }

  template <class Visit>
  void for_each_ground_vertex(const Surface<S>& s, Visit&& visit) const {
    const Convex<S>& ground = world_.convexes[s.lane->ground];
    const Body<S>& body = world_.bodies[world_.shapes[s.lane->ground].body];
    const Vec<S> between(body.x - body_.x, body.y - body_.y);
    for (std::uint32_t i = 0; i < ground.count; ++i)
      visit(Vec<S>(body.rotation().apply(ground.vertices[i] - body.local_center()) + between),
            Vec<S>(body.rotation().apply(ground.normals[i])), ground.radius);
  }

  // What meets round has the very normal of the face, or that of a corner; what is flat may have its own.
  void find_face(Surface<S>& s) const {
    if (world_.convexes[s.lane->ground].count < 2) return;
    const bool round = convex_.count == 1 || (static_cast<std::uint32_t>(s.id(0)) & ManifoldIds::kCorners) != 0;
    for_each_ground_vertex(s, [&](const Vec<S>& vertex, const Vec<S>& normal, S radius) {
      if (s.face || !same_direction(normal, s.normal)) return;
      if (round && absolute(cross<S>(normal, s.normal)) > S(kSeamRoundTurn)) return;
      s.face = true;
      s.plane = dot<S>(s.normal, vertex) + radius;
    });
  }

  Vec<S> vertex(std::uint32_t i) const { return body_.rotation().apply(convex_.vertices[i] - body_.local_center()); }

  // Which of the shape's vertices is at a point; of two above each other, the one nearer to the ground.
  int own_vertex(const Vec<S>& at, const Vec<S>& normal) const {
    if (convex_.count == 1) return 0;
    const Vec<S> tangent = cross<S>(normal, S(1));
    int found = kNoVertex;
    S lowest = 0;
    for (std::uint32_t i = 0; i < convex_.count; ++i) {
      const Vec<S> corner = vertex(i);
      if (absolute(dot<S>(tangent, corner - at)) > step()) continue;
      const S height = dot<S>(normal, corner);
      if (found != kNoVertex && height >= lowest) continue;
      found = static_cast<int>(i);
      lowest = height;
    }
    return found;
  }

  // Whether b is a ghost beside a.
  void drop_ghost(const Surface<S>& a, Surface<S>& b) const {
    if (!a.face || !a.kept(0) || !b.kept(0) || (b.face && same_direction(a.normal, b.normal))) return;
    for (int i = 0; i < b.points; ++i) {
      const S height = dot<S>(a.normal, b.on_ground(i)) - a.plane;
      if (height > step() || height < -gap()) return;
    }
    bool behind = true;
    for_each_ground_vertex(b, [&](const Vec<S>& vertex, const Vec<S>&, S radius) {
      behind = behind && dot<S>(a.normal, vertex) + radius - a.plane <= step();
    });
    if (behind) b.dropped[0] = b.dropped[1] = true;
  }

  bool one_plane(const Surface<S>& a, const Surface<S>& b) const {
    return a.face && b.face && same_direction(a.normal, b.normal) && absolute(a.plane - b.plane) <= step();
  }

  // Two points at the seam go both. Of two at one corner of the shape, which is just passing the seam, the one at the
  // very corner stays.
  void drop_seam_points(Surface<S>& a, Surface<S>& b) const {
    const Vec<S> tangent = cross<S>(a.normal, S(1));
    for (Surface<S>* s : {&a, &b}) {
      if (!s->kept(0) || !s->kept(1) || s->own[0] == kNoVertex || s->own[0] != s->own[1]) continue;
      drop_at_seam(*s, off_corner(*s, 1, tangent) < off_corner(*s, 0, tangent) ? 0 : 1);
    }
    for (int i = 0; i < a.points; ++i) {
      for (int k = 0; k < b.points; ++k) {
        if (!a.kept(i) || !b.kept(k) || a.own[i] != b.own[k]) continue;
        const bool corner = a.own[i] != kNoVertex;
        if (!corner && absolute(dot<S>(tangent, a.point(i) - b.point(k))) > gap()) continue;
        const bool b_nearer = corner && off_corner(b, k, tangent) < off_corner(a, i, tangent);
        if (!corner || b_nearer) drop_at_seam(a, i);
        if (!b_nearer) drop_at_seam(b, k);
      }
    }
  }

  S off_corner(const Surface<S>& s, int i, const Vec<S>& tangent) const {
    return absolute(dot<S>(tangent, vertex(static_cast<std::uint32_t>(s.own[i])) - s.point(i)));
  }

  void drop_at_seam(Surface<S>& s, int i) const { s.dropped[i] = s.joined = true; }

  void find_orphans(const Surface<S>& s) {
    const ContactBlock<S>& block = *s.lane->block;
    const std::uint32_t k = s.lane->lane;
    for (int i = 0; i < 2; ++i) {
      const S id = s.lane->rest->id[i][k];
      if (!is_point(id) || goes_on(s, id)) continue;
      if (block.points[i].normal_impulse[k] == S(0) && block.points[i].preload[k] == S(0)) continue;
      const int vertex = own_vertex(s.old_point(i), s.old_normal());
      if (vertex == kNoVertex) continue;
      Orphan<S>& orphan = orphans_[vertex];
      orphan.there = true;
      orphan.normal = s.old_normal();
      orphan.normal_impulse += block.points[i].normal_impulse[k];
      orphan.tangent_impulse += block.points[i].tangent_impulse[k];
      orphan.preload += block.points[i].preload[k];
    }
  }

  // A point of this id takes over the impulses.
  static bool goes_on(const Surface<S>& s, S id) {
    for (int i = 0; i < s.points; ++i)
      if (s.kept(i) && s.id(i) == id) return true;
    return false;
  }

  void adopt(const Surface<S>& s) {
    for (int i = 0; i < s.points; ++i) {
      if (!s.kept(i) || s.own[i] == kNoVertex) continue;
      Orphan<S>& orphan = orphans_[s.own[i]];
      if (!orphan.there || !same_direction(orphan.normal, s.normal)) continue;
      world_.scratch.adopted.push_back({s.lane->block, s.lane->rest, s.lane->lane, s.id(i), orphan.normal_impulse,
                                        orphan.tangent_impulse, orphan.preload});
      orphan = Orphan<S>{};
    }
  }

  // What was dropped leaves the manifold. The contact goes on with a point that never pushes if it was its last.
  void close_up(Surface<S>& s) {
    if (s.points == 0 || (!s.dropped[0] && !s.dropped[1])) return;
    const std::uint32_t k = s.lane->lane;
    const int left = (s.kept(0) ? 1 : 0) + (s.kept(1) ? 1 : 0);
    if (s.dropped[0] && s.kept(1)) {
      s.set_point(0, s.point(1));
      s.separation(0) = s.separation(1);
      s.id(0) = s.id(1);
    }
    s.now().count[k] = S(1);
    s.points = left;
    if (left == 0) idle(s);
    s.dropped[0] = s.dropped[1] = false;
  }

  static void idle(const Surface<S>& s) {
    s.separation(0) = S(kFarSeparation);
    s.id(0) = S(s.joined ? kIdlePoint : kGhostPoint);
  }

  // One point left on each of two still plates alike: both go into the contact with the first, which solves them
  // together, as those on one plate are.
  void unite(Surface<S>& a, Surface<S>& b) {
    if (!a.joined || !b.joined || a.points != 1 || b.points != 1) return;
    if (!one_plane(a, b) || !stands(a) || !stands(b)) return;
    if (a.lane->block->friction[a.lane->lane] != b.lane->block->friction[b.lane->lane]) return;
    if (a.lane->rest->restitution[a.lane->lane] != b.lane->rest->restitution[b.lane->lane]) return;
    a.set_point(1, b.point(0));
    a.separation(1) = b.separation(0);
    std::uint32_t id = static_cast<std::uint32_t>(b.id(0)) | kUnited;
    for (int i = 0; i < 2; ++i)
      if (a.lane->rest->id[i][a.lane->lane] == S(id)) id |= kUnitedAgain;
    a.id(1) = S(id);
    a.now().count[a.lane->lane] = S(2);
    a.points = 2;
    for (AdoptedImpulse<S>& adopted : world_.scratch.adopted) {
      if (adopted.rest != b.lane->rest || adopted.lane != b.lane->lane) continue;
      adopted.block = a.lane->block;
      adopted.rest = a.lane->rest;
      adopted.lane = a.lane->lane;
      adopted.id = a.id(1);
    }
    take_along(a, b);
    b.points = 0;
    idle(b);
  }

  // What b's point carries as b's own follows it into a's contact.
  void take_along(const Surface<S>& a, const Surface<S>& b) {
    const std::uint32_t k = b.lane->lane;
    for (int i = 0; i < 2; ++i) {
      if (b.lane->rest->id[i][k] != b.id(0)) continue;
      const PointLanes<S>& p = b.lane->block->points[i];
      world_.scratch.adopted.push_back({a.lane->block, a.lane->rest, a.lane->lane, a.id(1), p.normal_impulse[k],
                                        p.tangent_impulse[k], p.preload[k]});
    }
  }

  bool stands(const Surface<S>& s) const {
    return world_.bodies[world_.shapes[s.lane->ground].body].body_type() == BodyType::kStatic;
  }

  WorldData<S>& world_;
  const Convex<S>& convex_;
  const Body<S>& body_;
  S reach_;
  Surface<S> surfaces_[kGroundContactsMax];
  std::size_t count_ = 0;
  Orphan<S> orphans_[kPolygonVerticesMax];
};

template <class S>
void adopt_impulses(const std::vector<AdoptedImpulse<S>>& adopted) {
  for (const AdoptedImpulse<S>& each : adopted) {
    for (int i = 0; i < 2; ++i) {
      if (each.rest->id[i][each.lane] != each.id) continue;
      PointLanes<S>& p = each.block->points[i];
      p.normal_impulse[each.lane] += each.normal_impulse;
      p.tangent_impulse[each.lane] += each.tangent_impulse;
      p.preload[each.lane] += each.preload;
      break;
    }
  }
}

}  // namespace

template <class S>
void note_ground(WorldData<S>& world, bool last_color, ContactBlock<S>& block, ContactBlockRest<S>& rest,
                 ManifoldLanes<S>& manifolds) {
  for (std::uint32_t lane = 0; lane < block.count; ++lane) {
    const bool moves_b = (block.movable_b >> lane & 1u) != 0;
    const std::uint32_t body = moves_b ? block.b[lane] : block.a[lane];
    const std::uint64_t grounds = world.touching.taken[body] >> kMovableColors;
    if ((grounds & (grounds - 1)) == 0 && !last_color) continue;  // one at most
    const Proxy a = rest.shape_a[lane], b = rest.shape_b[lane];
    world.scratch.ground.push_back({moves_b ? b : a, moves_b ? a : b, lane, moves_b, &block, &rest, &manifolds});
  }
}

template <class S>
void join_seams(WorldData<S>& world) {
  const std::vector<GroundLane<S>>& ground = world.scratch.ground;
  std::vector<std::uint64_t>& order = world.scratch.ground_order;
  world.scratch.adopted.clear();
  order.clear();
  for (std::size_t i = 0; i < ground.size(); ++i) order.push_back((std::uint64_t{ground[i].shape} << 32) | i);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size();) {
    const auto shape = static_cast<Proxy>(order[i] >> 32);
    std::size_t end = i + 1;
    while (end < order.size() && order[end] >> 32 == shape) ++end;
    if (end - i > 1) {
      SeamJoiner<S> joiner(world, shape);
      for (; i < end; ++i) joiner.add(ground[order[i] & 0xffffffffu]);
      joiner.join();
    }
    i = end;
  }
}

template <class S>
void finish_seams(WorldData<S>& world) {
  adopt_impulses(world.scratch.adopted);
  world.scratch.ground.clear();
}

#define URTO_INSTANTIATE(S)                                                                                  \
  template void note_ground(WorldData<S>&, bool, ContactBlock<S>&, ContactBlockRest<S>&, ManifoldLanes<S>&); \
  template void join_seams(WorldData<S>&);                                                                   \
  template void finish_seams(WorldData<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

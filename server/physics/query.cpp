#include "physics/query.h"

#include <algorithm>

#include "physics/force_field.h"
#include "physics/narrow_phase/gjk.h"
#include "physics/narrow_phase/ray_cast.h"

namespace urto {
namespace {

template <class S>
std::vector<Proxy> solid_proxies_in(const WorldData<S>& world, const Aabb<S>& box) {
  std::vector<Proxy> found;
  if (world.broad_phase) world.broad_phase->query(box, found);
  std::erase_if(found, [&](Proxy p) { return world.shapes[p].sensor(); });
  return found;
}

template <class S>
Transform<S> pose_of(const WorldData<S>& world, Proxy proxy) {
  return world.bodies[world.shapes[proxy].body].pose();
}

// Ascending and each once.
void sort_unique(std::vector<BodyId>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

// Keeps the best hit of each body (the one with the least key), then orders by key, then id.
template <class Hit, class Key>
void keep_best(std::vector<Hit>& hits, Key key) {
  std::sort(hits.begin(), hits.end(),
            [&](const Hit& a, const Hit& b) { return a.body != b.body ? a.body < b.body : key(a) < key(b); });
  hits.erase(std::unique(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.body == b.body; }),
             hits.end());
  std::stable_sort(hits.begin(), hits.end(), [&](const Hit& a, const Hit& b) { return key(a) < key(b); });
}

Vec2 to_double(const auto& v) { return Vec2(double(v.x()), double(v.y())); }

template <class S>
NearHit near_hit(const WorldData<S>& world, Proxy p, const Vec2& point) {
  const Transform<S> pose = pose_of(world, p);
  Convex<S> probe;
  probe.count = 1;
  probe.vertices[0] = pose.apply_inverse(point.cast<S>());
  const Distance<S> d = gjk_distance(world.convexes[p], probe, Transform<S>{});
  NearHit hit;
  hit.body = id_of(world, world.shapes[p].body);
  if (d.separation <= S(0)) {
    hit.point = point;
    return hit;
  }
  hit.distance = double(d.separation);
  hit.point = to_double(pose.apply(d.point_a));
  hit.normal = to_double(pose.q.apply(d.normal));
  return hit;
}

}  // namespace

template <class S>
std::vector<BodyId> bodies_at(const WorldData<S>& world, const Vec2& point) {
  const Vec<S> p = point.cast<S>();
  std::vector<BodyId> ids;
  for (Proxy proxy : solid_proxies_in(world, Aabb<S>{p, p}))
    if (contains_point(world.convexes[proxy], pose_of(world, proxy).apply_inverse(p)))
      ids.push_back(id_of(world, world.shapes[proxy].body));
  sort_unique(ids);
  return ids;
}

template <class S>
std::vector<BodyId> bodies_in(const WorldData<S>& world, const Vec2& lower, const Vec2& upper) {
  const Aabb<S> box{lower.cast<S>(), upper.cast<S>()};
  std::vector<BodyId> ids;
  for (Proxy proxy : solid_proxies_in(world, box))
    if (world.convexes[proxy].bounds(pose_of(world, proxy)).overlaps(box))
      ids.push_back(id_of(world, world.shapes[proxy].body));
  sort_unique(ids);
  return ids;
}

template <class S>
std::vector<RayHit> bodies_along(const WorldData<S>& world, const Vec2& origin, const Vec2& translation) {
  std::vector<Proxy> proxies;
  if (world.broad_phase) world.broad_phase->query_segment(origin.cast<S>(), translation.cast<S>(), proxies);
  std::vector<RayHit> hits;
  for (Proxy proxy : proxies) {
    if (world.shapes[proxy].sensor()) continue;
    const Transform<S> pose = pose_of(world, proxy);
    const ConvexRayHit<S> hit = ray_cast<S>(world.convexes[proxy], pose.apply_inverse(origin.cast<S>()),
                                            pose.q.apply_inverse(translation.cast<S>()));
    if (!hit.hit) continue;
    const double fraction = double(hit.fraction);
    hits.push_back({id_of(world, world.shapes[proxy].body), origin + fraction * translation,
                    to_double(pose.q.apply(hit.normal)), fraction});
  }
  keep_best(hits, [](const RayHit& h) { return h.fraction; });
  return hits;
}

template <class S>
std::vector<NearHit> bodies_near(const WorldData<S>& world, const Vec2& point, double distance_max,
                                 std::uint32_t count_max) {
  const Vec<S> p = point.cast<S>();
  std::vector<NearHit> hits;
  for (Proxy proxy : solid_proxies_in(world, Aabb<S>{p, p}.expanded(S(distance_max)))) {
    const NearHit hit = near_hit(world, proxy, point);
    if (hit.distance <= distance_max) hits.push_back(hit);
  }
  keep_best(hits, [](const NearHit& h) { return h.distance; });
  if (hits.size() > count_max) hits.resize(count_max);
  return hits;
}

template <class S>
Energy energy_of(const WorldData<S>& world) {
  Energy out;
  for (std::uint32_t slot = 0; slot < world.bodies.size(); ++slot) {
    const Body<S>& b = world.bodies[slot];
    if (!b.alive() || !b.dynamic()) continue;
    const Motion<S>& m = world.motions[slot];
    const double mass = double(b.mass), inertia = b.inv_inertia > S(0) ? double(b.inertia) : 0.0;
    const Vec2 x(double(b.x), double(b.y)), v(double(m.vx), double(m.vy));
    const double w = double(m.w);
    out.kinetic += 0.5 * (mass * dot<double>(v, v) + inertia * w * w);
    out.potential -= mass * double(b.gravity_scale) * dot<double>(world.settings.gravity, x);
    if (!world.settings.fields.empty()) out.potential += field_potential(world.settings.fields, x, mass);
    out.momentum += mass * v;
    out.angular_momentum += mass * cross<double>(x, v) + inertia * w;
  }
  return out;
}

template <class S>
std::vector<ContactPoint> contact_points_of(const WorldData<S>& world) {
  std::vector<ContactPoint> out;
  for (std::uint32_t slot = 0; slot < world.contacts.size(); ++slot) {
    if (!world.contacts[slot].alive() || world.contacts[slot].sensor()) continue;
    const Contact<S> c = settled(world, slot);
    const Body<S>& a = world.bodies[c.body_a];
    for (std::uint32_t i = 0; i < c.count; ++i) {
      const ManifoldPoint<S>& p = c.points[i];
      out.push_back({id_of(world, c.body_a), id_of(world, c.body_b), Vec2(double(a.x + p.ax), double(a.y + p.ay)),
                     Vec2(double(c.nx), double(c.ny)), double(p.separation), double(p.total_normal_impulse),
                     double(p.total_tangent_impulse)});
    }
  }
  return out;
}

#define URTO_INSTANTIATE(S)                                                                           \
  template std::vector<BodyId> bodies_at(const WorldData<S>&, const Vec2&);                           \
  template std::vector<BodyId> bodies_in(const WorldData<S>&, const Vec2&, const Vec2&);              \
  template std::vector<RayHit> bodies_along(const WorldData<S>&, const Vec2&, const Vec2&);           \
  template std::vector<NearHit> bodies_near(const WorldData<S>&, const Vec2&, double, std::uint32_t); \
  template Energy energy_of(const WorldData<S>&);                                                     \
  template std::vector<ContactPoint> contact_points_of(const WorldData<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

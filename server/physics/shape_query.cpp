#include "physics/shape_query.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/broad_phase/segment_bounds.h"
#include "physics/geometry/polygon.h"
#include "physics/narrow_phase/gjk.h"
#include "physics/narrow_phase/shape_cast.h"

namespace urto {
namespace {

// Shapes in double ----------------------------------------------------------------------------------------------

void set_vertices(Convex<double>& out, const std::vector<Vec2>& vertices) {
  out.count = static_cast<std::uint32_t>(vertices.size());
  for (std::uint32_t i = 0; i < out.count; ++i) {
    out.vertices[i] = vertices[i];
    out.centroid += vertices[i] / double(out.count);
    const Vec2 edge = vertices[i + 1 < out.count ? i + 1 : 0] - vertices[i];
    if (out.count > 1) out.normals[i] = cross<double>(edge, 1.0) / length<double>(edge);
  }
}

struct ConvexMaker {
  Convex<double>& out;

  void operator()(const PointGeometry&) const { set_vertices(out, {Vec2(0, 0)}); }
  void operator()(const Circle& circle) const {
    set_vertices(out, {circle.center});
    out.radius = circle.radius;
  }
  void operator()(const Capsule& capsule) const {
    set_vertices(out, {capsule.a, capsule.b});
    out.radius = capsule.radius;
  }
  void operator()(const Box& box) const {
    const Rotation<double> q = Rotation<double>::from_angle(box.angle);
    const double x = 0.5 * box.width, y = 0.5 * box.height;
    std::vector<Vec2> corners = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    for (Vec2& corner : corners) corner = box.center + q.apply(corner);
    set_vertices(out, corners);
    out.radius = box.radius;
  }
  void operator()(const Polygon& polygon) const {
    set_vertices(out, decompose_polygon(polygon.vertices)->front());
    out.radius = polygon.radius;
  }
};

// The shape that asks, where it is.
struct Probe {
  Convex<double> convex;
  Transform<double> pose;
  Aabb<double> bounds;

  explicit Probe(const QueryShape& shape) : pose{shape.position, Rotation<double>::from_angle(shape.angle)} {
    std::visit(ConvexMaker{convex}, shape.geometry);
    bounds = convex.bounds(pose);
  }
};

template <class S>
Convex<double> to_double(const Convex<S>& shape) {
  Convex<double> out;
  out.count = shape.count;
  out.radius = double(shape.radius);
  out.centroid = shape.centroid.template cast<double>();
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    out.vertices[i] = shape.vertices[i].template cast<double>();
    out.normals[i] = shape.normals[i].template cast<double>();
  }
  return out;
}

// A rotation that was rounded to float is one no longer in double until it has length 1 again.
template <class S>
Transform<double> pose_in_double(const Body<S>& body) {
  const double c = double(body.c), s = double(body.s), size = std::sqrt(c * c + s * s);
  Transform<double> pose;
  pose.q = {c / size, s / size};
  pose.p = Vec2(double(body.x), double(body.y)) - pose.q.apply(Vec2(double(body.local_x), double(body.local_y)));
  return pose;
}

// Candidates -----------------------------------------------------------------------------------------------------

// Rounded outwards, by a bit more than needed.
template <class S>
Aabb<S> outward(const Aabb<double>& box) {
  const auto room = [](double value) { return 4 * double(std::numeric_limits<S>::epsilon()) * std::abs(value); };
  Aabb<S> out;
  out.lower = Vec<S>(S(box.lower.x() - room(box.lower.x())), S(box.lower.y() - room(box.lower.y())));
  out.upper = Vec<S>(S(box.upper.x() + room(box.upper.x())), S(box.upper.y() + room(box.upper.y())));
  return out;
}

template <class S>
bool sees(const QueryOptions& options, const Shape<S>& shape) {
  if (shape.sensor()) return false;
  if (!options.filter) return true;
  return (options.filter->mask & shape.category) != 0 && (shape.mask & options.filter->category) != 0;
}

// Calls `look` with the proxy, its outline in double and the frame of the probe as seen from it.
template <class S, class Look>
void for_each_seen(const WorldData<S>& world, const Probe& probe, const Aabb<double>& box, const QueryOptions& options,
                   Look&& look) {
  std::vector<Proxy> proxies;
  if (world.broad_phase) world.broad_phase->query(outward<S>(box), proxies);
  for (const Proxy proxy : proxies) {
    const Shape<S>& shape = world.shapes[proxy];
    if (!sees(options, shape)) continue;
    const Transform<double> pose = pose_in_double(world.bodies[shape.body]);
    look(proxy, to_double(world.convexes[proxy]), pose, pose.inverse_times(probe.pose));
  }
}

// Keeps the best hit of each body (the one with the least key), orders by key, then id, and cuts off what is too much.
template <class Hit, class Key>
QueryHits<Hit> best_of_bodies(std::vector<Hit> hits, const QueryOptions& options, Key key) {
  std::stable_sort(hits.begin(), hits.end(),
                   [&](const Hit& a, const Hit& b) { return a.body != b.body ? a.body < b.body : key(a) < key(b); });
  const auto same_body = [](const Hit& a, const Hit& b) { return a.body == b.body; };
  hits.erase(std::unique(hits.begin(), hits.end(), same_body), hits.end());
  std::stable_sort(hits.begin(), hits.end(), [&](const Hit& a, const Hit& b) { return key(a) < key(b); });
  const bool truncated = hits.size() > options.count_max;
  if (truncated) hits.resize(options.count_max);
  return {std::move(hits), truncated};
}

}  // namespace

template <class S>
QueryHits<CastHit> bodies_cast_at(const WorldData<S>& world, const QueryShape& shape, const Vec2& translation,
                                  const QueryOptions& options) {
  const Probe probe(shape);
  const Aabb<double> end{probe.bounds.lower + translation, probe.bounds.upper + translation};
  // A box that moves meets another one if its centre's way meets that one grown by its half extents.
  const Vec2 half = 0.5 * (probe.bounds.upper - probe.bounds.lower);
  const SegmentBounds<double> way(probe.bounds.center(), translation);
  std::vector<CastHit> hits;
  for_each_seen(
      world, probe, probe.bounds.merged(end), options,
      [&](Proxy proxy, const Convex<double>& convex, const Transform<double>& pose,
          const Transform<double>& probe_in_shape) {
        const Aabb<S>& fat = world.shapes[proxy].fat;
        const Aabb<double> grown{fat.lower.template cast<double>() - half, fat.upper.template cast<double>() + half};
        if (!way.meets(grown)) return;
        const ShapeCast<double> cast =
            shape_cast<double>(convex, probe.convex, probe_in_shape, pose.q.apply_inverse(translation));
        if (!cast.hit) return;
        hits.push_back(
            {id_of(world, world.shapes[proxy].body), pose.apply(cast.point), pose.q.apply(cast.normal), cast.fraction});
      });
  return best_of_bodies(std::move(hits), options, [](const CastHit& hit) { return hit.fraction; });
}

template <class S>
QueryHits<BodyId> bodies_overlapping(const WorldData<S>& world, const QueryShape& shape, const QueryOptions& options) {
  const Probe probe(shape);
  std::vector<BodyId> ids;
  for_each_seen(world, probe, probe.bounds, options,
                [&](Proxy proxy, const Convex<double>& convex, const Transform<double>&,
                    const Transform<double>& probe_in_shape) {
                  if (gjk_distance<double>(convex, probe.convex, probe_in_shape).separation > 0) return;
                  ids.push_back(id_of(world, world.shapes[proxy].body));
                });
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const bool truncated = ids.size() > options.count_max;
  if (truncated) ids.resize(options.count_max);
  return {std::move(ids), truncated};
}

template <class S>
QueryHits<ClosestHit> bodies_closest_to(const WorldData<S>& world, const QueryShape& shape, double distance_max,
                                        const QueryOptions& options) {
  const Probe probe(shape);
  std::vector<ClosestHit> hits;
  for_each_seen(world, probe, probe.bounds.expanded(distance_max), options,
                [&](Proxy proxy, const Convex<double>& convex, const Transform<double>& pose,
                    const Transform<double>& probe_in_shape) {
                  const Distance<double> d = gjk_distance<double>(convex, probe.convex, probe_in_shape);
                  if (d.separation > distance_max) return;
                  hits.push_back({id_of(world, world.shapes[proxy].body), pose.apply(d.point_a), pose.apply(d.point_b),
                                  pose.q.apply(d.normal), d.separation});
                });
  return best_of_bodies(std::move(hits), options, [](const ClosestHit& hit) { return hit.distance; });
}

#define URTO_INSTANTIATE(S)                                                                                   \
  template QueryHits<CastHit> bodies_cast_at(const WorldData<S>&, const QueryShape&, const Vec2&,             \
                                             const QueryOptions&);                                            \
  template QueryHits<BodyId> bodies_overlapping(const WorldData<S>&, const QueryShape&, const QueryOptions&); \
  template QueryHits<ClosestHit> bodies_closest_to(const WorldData<S>&, const QueryShape&, double, const QueryOptions&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

#include "physics/narrow_phase/ray_cast.h"

namespace urto {
namespace {

// A cast in progress: the earliest entry found so far.
template <class S>
struct Cast {
  Vec<S> origin, translation;
  ConvexRayHit<S> hit;

  void enter(S fraction, const Vec<S>& normal) {
    if (fraction < S(0) || fraction > S(1) || (hit.hit && fraction >= hit.fraction)) return;
    hit.hit = true;
    hit.fraction = fraction;
    hit.normal = normal;
  }
};

template <class S>
Vec<S> unit_or_zero(const Vec<S>& v) {
  const S size = length(v);
  return size > S(0) ? Vec<S>(v * (S(1) / size)) : Vec<S>(Vec<S>::Zero());
}

// Outward unit normal of edge i. A capsule's two edges are the two sides of one segment.
template <class S>
Vec<S> edge_normal(const Convex<S>& shape, std::uint32_t i, const Vec<S>& edge) {
  return shape.count > 2 ? shape.normals[i] : unit_or_zero(cross(edge, S(1)));
}

// The disc around center, for an origin outside it.
template <class S>
void enter_disc(Cast<S>& cast, const Vec<S>& center, S radius) {
  const Vec<S>& d = cast.translation;
  const Vec<S> m = cast.origin - center;
  const S closing = -dot(m, d);
  if (closing <= S(0)) return;
  const S dd = dot(d, d);
  const S moment = cross(m, d);
  const S discriminant = radius * radius * dd - moment * moment;
  if (discriminant < S(0)) return;
  // The smaller root of dd·t² − 2·closing·t + gap = 0 as a quotient, which subtracts nothing but the gap itself.
  const S distance = length(m);
  const S gap = (distance - radius) * (distance + radius);
  const S fraction = gap / (closing + std::sqrt(discriminant));
  const Vec<S> normal = unit_or_zero(Vec<S>(m + fraction * d));
  cast.enter(fraction, dot(normal, normal) > S(0) ? normal : unit_or_zero(Vec<S>(-d)));
}

// Clips the segment by the half-planes of a polygon without radius.
template <class S>
ConvexRayHit<S> cast_polygon(const Convex<S>& shape, const Vec<S>& origin, const Vec<S>& translation) {
  S lower = 0, upper = 1;
  bool entered = false;
  std::uint32_t entry = 0;
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    const S depth = dot(shape.normals[i], Vec<S>(shape.vertices[i] - origin));  // of the origin behind the edge
    const S speed = dot(shape.normals[i], translation);
    if (speed == S(0)) {
      if (depth < S(0)) return {};
    } else if (speed < S(0)) {
      if (depth < lower * speed) {
        lower = depth / speed;
        entered = true;
        entry = i;
      }
    } else if (depth < upper * speed) {
      upper = depth / speed;
    }
    if (upper < lower) return {};
  }
  ConvexRayHit<S> out;
  out.hit = true;
  if (entered) {
    out.fraction = lower;
    out.normal = shape.normals[entry];
  }
  return out;
}

// The outline of a rounded shape: its edges moved out by the radius, and discs around its vertices.
template <class S>
ConvexRayHit<S> cast_rounded(const Convex<S>& shape, const Vec<S>& origin, const Vec<S>& translation) {
  Cast<S> cast{origin, translation, {}};
  for (std::uint32_t i = 0; i < shape.count; ++i) enter_disc(cast, shape.vertices[i], shape.radius);
  for (std::uint32_t i = 0; i < shape.count && shape.count > 1; ++i) {
    const Vec<S>& start = shape.vertices[i];
    const Vec<S> edge = shape.vertices[i + 1 < shape.count ? i + 1 : 0] - start;
    const Vec<S> normal = edge_normal(shape, i, edge);
    const S speed = dot(normal, translation);
    if (speed >= S(0)) continue;
    const Vec<S> offset = origin - start;
    const S fraction = (shape.radius - dot(normal, offset)) / speed;
    const S along = dot(edge, Vec<S>(offset + fraction * translation));
    if (along >= S(0) && along <= dot(edge, edge)) cast.enter(fraction, normal);
  }
  return cast.hit;
}

template <class S>
S squared_distance_to_segment(const Vec<S>& p, const Vec<S>& start, const Vec<S>& edge) {
  const Vec<S> offset = p - start;
  const S along = dot(offset, edge), size = dot(edge, edge);
  if (along <= S(0) || size <= S(0)) return dot(offset, offset);
  if (along >= size) {
    const Vec<S> beyond = offset - edge;
    return dot(beyond, beyond);
  }
  const S moment = cross(edge, offset);
  return moment * moment / size;
}

}  // namespace

template <class S>
bool contains_point(const Convex<S>& shape, const Vec<S>& point) {
  if (shape.count > 2) {
    S outside = dot(shape.normals[0], Vec<S>(point - shape.vertices[0]));
    for (std::uint32_t i = 1; i < shape.count; ++i) {
      outside = max_of(outside, dot(shape.normals[i], Vec<S>(point - shape.vertices[i])));
    }
    if (outside <= S(0)) return true;
    if (outside > shape.radius) return false;
  }
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    const Vec<S> edge = shape.vertices[i + 1 < shape.count ? i + 1 : 0] - shape.vertices[i];
    if (squared_distance_to_segment(point, shape.vertices[i], edge) <= shape.radius * shape.radius) return true;
  }
  return false;
}

template <class S>
ConvexRayHit<S> ray_cast(const Convex<S>& shape, const Vec<S>& origin, const Vec<S>& translation) {
  if (shape.count > 2 && shape.radius == S(0)) return cast_polygon(shape, origin, translation);
  if (contains_point(shape, origin)) {
    ConvexRayHit<S> inside;
    inside.hit = true;
    return inside;
  }
  return cast_rounded(shape, origin, translation);
}

template bool contains_point<float>(const Convex<float>&, const Vec<float>&);
template bool contains_point<double>(const Convex<double>&, const Vec<double>&);
template ConvexRayHit<float> ray_cast<float>(const Convex<float>&, const Vec<float>&, const Vec<float>&);
template ConvexRayHit<double> ray_cast<double>(const Convex<double>&, const Vec<double>&, const Vec<double>&);

}  // namespace urto

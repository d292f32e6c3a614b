#pragma once

// Convex shapes for the tests of geometry and narrow phase: built in double, rounded once to the scalar.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <vector>

#include "physics/geometry/convex.h"
#include "physics/places.h"

namespace urto::testing_shapes {

inline Convex<double> convex_of(const std::vector<Vec2>& counter_clockwise, double radius = 0) {
  Convex<double> shape;
  shape.count = static_cast<std::uint32_t>(counter_clockwise.size());
  shape.radius = radius;
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    shape.vertices[i] = counter_clockwise[i];
    shape.centroid += counter_clockwise[i] / shape.count;
    const Vec2 edge = counter_clockwise[(i + 1) % shape.count] - counter_clockwise[i];
    shape.normals[i] = shape.count > 1 ? Vec2(Vec2(edge.y(), -edge.x()) / edge.norm()) : Vec2(0, 0);
  }
  return shape;
}

template <class To, class From>
Convex<To> cast_to(const Convex<From>& shape) {
  Convex<To> out;
  out.count = shape.count;
  out.radius = static_cast<To>(shape.radius);
  out.centroid = shape.centroid.template cast<To>();
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    out.vertices[i] = shape.vertices[i].template cast<To>();
    out.normals[i] = shape.normals[i].template cast<To>();
  }
  return out;
}

inline Transform<double> pose_of(double x, double y, double angle) {
  Transform<double> pose;
  pose.p = Vec2(x, y);
  pose.q.c = std::cos(angle);
  pose.q.s = std::sin(angle);
  return pose;
}

template <class To, class From>
Transform<To> cast_pose(const Transform<From>& pose) {
  Transform<To> out;
  out.p = pose.p.template cast<To>();
  out.q.c = static_cast<To>(pose.q.c);
  out.q.s = static_cast<To>(pose.q.s);
  return out;
}

// x → −x, the corners put back in counter-clockwise order.
template <class S>
Convex<S> mirror(const Convex<S>& shape) {
  Convex<S> out = shape;
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    const Vec<S> v = shape.vertices[shape.count - 1 - i];
    const Vec<S> n = shape.normals[(2 * shape.count - 2 - i) % shape.count];
    out.vertices[i] = Vec<S>(-v.x(), v.y());
    out.normals[i] = Vec<S>(-n.x(), n.y());
  }
  out.centroid.x() = -shape.centroid.x();
  return out;
}

template <class S>
Transform<S> mirror(const Transform<S>& pose) {
  Transform<S> out = pose;
  out.p.x() = -pose.p.x();
  out.q.s = -pose.q.s;
  return out;
}

inline Convex<double> box(double width, double height, double radius = 0) {
  const double x = 0.5 * width, y = 0.5 * height;
  return convex_of({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, radius);
}

inline Convex<double> circle(double radius, const Vec2& center = {0, 0}) { return convex_of({center}, radius); }

inline Convex<double> capsule(const Vec2& a, const Vec2& b, double radius) { return convex_of({a, b}, radius); }

// count vertices on an ellipse at uneven angles: convex whatever the draw.
inline Convex<double> random_polygon(std::mt19937_64& random, std::uint32_t count, double size, double radius = 0) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double turn = 6.283185307179586;
  const double aspect = std::exp(-3 * unit(random)), tilt = turn * unit(random);
  std::vector<Vec2> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = turn * (i + 0.7 * unit(random)) / count;
    const Vec2 p(size * std::cos(angle), size * aspect * std::sin(angle));
    points.emplace_back(std::cos(tilt) * p.x() - std::sin(tilt) * p.y(),
                        std::sin(tilt) * p.x() + std::cos(tilt) * p.y());
  }
  return convex_of(points, radius);
}

// Any kind: point, segment, triangle to octagon, with and without a radius.
inline Convex<double> random_shape(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto count = static_cast<std::uint32_t>(std::uniform_int_distribution<int>(1, 8)(random));
  const double radius = count < 3 || unit(random) < 0.5 ? size * unit(random) : 0;
  return random_polygon(random, count, size, radius);
}

// The place of an outline whose body has its centre of mass at the pose's origin.
template <class S>
Place<S> place_of(const Convex<S>& convex, const Transform<S>& pose, S reach) {
  Place<S> place;
  const Vec<S> center = pose.apply(convex.centroid);
  place.x = center.x();
  place.y = center.y();
  place.offset_x = center.x() - pose.p.x();
  place.offset_y = center.y() - pose.p.y();
  place.c = pose.q.c;
  place.s = pose.q.s;
  place.reach = reach;
  place.half_width = convex.radius;
  const bool sharp = convex.count > 2 && convex.radius == S(0);
  place.vertices = sharp ? S(convex.count) : -S(convex.count);
  return place;
}

}  // namespace urto::testing_shapes

#pragma once

#include <vector>

#include "physics/definitions.h"
#include "physics/error.h"

namespace urto {

// Area, centroid and second moment of a flat shape of density 1.
struct AreaProperties {
  double area = 0;           // m²
  Vec2 centroid{0, 0};       // m
  double second_moment = 0;  // m⁴ about the centroid
};

AreaProperties polygon_area_properties(const std::vector<Vec2>& counter_clockwise);
AreaProperties circle_area_properties(double radius, const Vec2& center);
AreaProperties box_area_properties(double width, double height, const Vec2& center);
// Of a convex outline of 2 or more vertices (2: a capsule's segment) grown by a radius.
AreaProperties rounded_area_properties(const std::vector<Vec2>& counter_clockwise, double radius);

// A simple polygon of either winding as convex, counter-clockwise parts of at most kPolygonVerticesMax vertices that
// cover it without overlap. A polygon that is convex and small enough is returned as it is (made counter-clockwise,
// without collinear vertices). Deterministic; few parts rather than many (ear clipping or better, then merging of
// triangles, Hertel–Mehlhorn).
// Errors: kInvalidValue (fewer than 3 or more than kPolygonInputVerticesMax vertices, not finite, beyond kSizeMax),
// kDegenerateShape (coinciding neighbours, crossing edges, no area, thinner than kSizeMin). Error::field is
// "vertices" or "vertices[i]".
Expected<std::vector<std::vector<Vec2>>> decompose_polygon(const std::vector<Vec2>& vertices);

// Whether the vertices make a chain: kInvalidValue (too few or too many vertices, not finite, beyond kSizeMax),
// kDegenerateShape (neighbours nearer than kSizeMin, an edge that folds back onto the one before). It may cross itself.
Status check_chain(const std::vector<Vec2>& vertices, bool loop);

}  // namespace urto

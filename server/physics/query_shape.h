#pragma once

// What the queries of a world look with, and what they find.

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "physics/definitions.h"
#include "physics/error.h"

namespace urto {

// Bounds of what shape casts, overlaps and closest-point queries answer.
inline constexpr std::uint32_t kQueryHitsDefault = 256;
inline constexpr std::uint32_t kQueryHitsMax = 4096;

struct PointGeometry {};
using QueryGeometry = std::variant<PointGeometry, Box, Circle, Polygon, Capsule>;

// A point or a convex shape, described in a frame of its own as in a body's, and where that frame is.
struct QueryShape {
  QueryGeometry geometry;  // a polygon: convex, at most kPolygonVerticesMax vertices
  Vec2 position{0, 0};     // m, world frame
  double angle = 0;        // rad
};

struct QueryOptions {
  // Sees the shapes that a shape of this filter would touch. Absent: all.
  std::optional<Filter> filter = std::nullopt;
  std::uint32_t count_max = kQueryHitsDefault;  // of bodies, 1 to kQueryHitsMax
};

struct CastHit {
  BodyId body = 0;
  Vec2 point{0, 0};     // m, world frame, where the surfaces meet; within the overlap if they overlap at the start
  Vec2 normal{0, 0};    // unit, out of the body; zero if they overlap at the start
  double fraction = 0;  // of the translation, [0, 1], never after the true one; 0 if they overlap at the start
};

struct ClosestHit {
  BodyId body = 0;
  Vec2 point{0, 0};        // m, world frame, the body's nearest (or, if they overlap, deepest) point
  Vec2 query_point{0, 0};  // m, world frame, that of the shape that asks
  Vec2 normal{0, 0};       // unit, out of the body
  double distance = 0;     // m; negative: the least way that parts them
};

// Each body once. Full: the hits that come first in the query's order are kept, the rest is left out.
template <class Hit>
struct QueryHits {
  std::vector<Hit> hits;
  bool truncated = false;  // more than count_max bodies were found
};

// Errors: kInvalidValue, kDegenerateShape. Fields begin with "shape.", "translation", "distance_max", "count_max".
Status check_query_shape(const QueryShape& shape);
Status check_cast(const QueryShape& shape, const Vec2& translation, const QueryOptions& options);
Status check_overlap(const QueryShape& shape, const QueryOptions& options);
Status check_closest(const QueryShape& shape, double distance_max, const QueryOptions& options);

}  // namespace urto

#pragma once

#include "physics/data.h"
#include "physics/query_shape.h"

namespace urto {

// Questions that are asked with a shape. Arguments have been checked; sensors are not seen; chains are seen from both
// sides. They are computed in double whatever the world's scalar is: what they say of a float world is exact to the
// rounding of its own coordinates. Touching counts as overlapping.

// Bodies that the shape meets on its way, first hit first, then ascending id.
template <class S>
QueryHits<CastHit> bodies_cast_at(const WorldData<S>& world, const QueryShape& shape, const Vec2& translation,
                                  const QueryOptions& options);

// Ascending id.
template <class S>
QueryHits<BodyId> bodies_overlapping(const WorldData<S>& world, const QueryShape& shape, const QueryOptions& options);

// Bodies within a distance of the shape, nearest first, then ascending id.
template <class S>
QueryHits<ClosestHit> bodies_closest_to(const WorldData<S>& world, const QueryShape& shape, double distance_max,
                                        const QueryOptions& options);

}  // namespace urto

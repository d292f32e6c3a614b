#pragma once

#include "physics/narrow_phase/manifold.h"

namespace urto {

// Where a shape touches a segment of a chain, without ghost collisions at the joints. The segment runs from v1 to v2;
// g1 and g2 are its neighbours in the chain. Only what is on its right is stopped.
//
//     n0 ^     ^ n1       the normals that a contact may have at a convex joint lie between n0 and n1 (the joint's
//   g1 ---- v1 ---- v2    region of the Gauss map, Catto, "Ghost Collisions", box2d.org 2020); a contact that would
//                         have another is left to the neighbour, whose region it is.
//
// At a concave joint no normal but the segment's own exists: what would push sideways there is turned to it. The joint
// v1 belongs to this segment and v2 to the next (unless the chain ends there), so that a disc on a joint has one
// contact and not two.
//
// `other` in the segment's frame; the normal points from the segment to it. Ids as in ManifoldIds.
template <class S>
LocalManifold<S> collide_chain_segment(const Convex<S>& segment, const Convex<S>& other, S reach);

}  // namespace urto

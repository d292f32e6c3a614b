#pragma once

#include "physics/data.h"

namespace urto {

// Unmovable shapes side by side make one surface, and a body that slides over it shall not feel where one ends and the
// next begins. What two shapes alone know of each other is not enough for that; here the contacts of one shape with
// all the ground are looked at together, after their manifolds were found and before they are solved:
//
//             +---------+           1. A contact that would push aside although all of its ground lies behind the
//             |  slides |→             plane of another face under the same shape is a ghost: it is left out.
//       ------p0---xx---p1------    2. Of two faces in one plane that meet under the shape, the two points at the seam
//       plate A |  | plate B           (xx) are left out: the load rests on the shape's own corners, as on one plate.
//                                   3. What a corner of the shape carried on one plate it carries on the next.
//
// The ends of the ground, steps, ridges and valleys stay what they are: their points are no seam's.

// Part of the phase update_contacts, between the finding of manifolds and their taking over into the lanes, whose
// points and impulses are still those of the step before. First every block of a colour for unmovable bodies is noted
// (the last colour takes what fits nowhere, and says nothing of how many contacts a body has):
template <class S>
void note_ground(WorldData<S>& world, bool last_color, ContactBlock<S>& block, ContactBlockRest<S>& rest,
                 ManifoldLanes<S>& manifolds);
// Then points are dropped from the new manifolds, and
template <class S>
void join_seams(WorldData<S>& world);
// when the manifolds have been taken over, impulses go where the corners are now.
template <class S>
void finish_seams(WorldData<S>& world);

}  // namespace urto

#pragma once

#include "physics/geometry/aabb.h"

namespace urto {

// Does a segment meet a box? The answer is monotone in floating point: if a box meets the segment, so does every box
// that contains it. (Each value below is a sum of rounded terms, and every one of them is monotone in the box's sides.)
// Hence trees that test their nodes with it find exactly what a linear scan finds.
template <class S>
class SegmentBounds {
 public:
  SegmentBounds(const Vec<S>& origin, const Vec<S>& translation)
      : origin_(origin), translation_(translation), bounds_(around(origin, origin + translation)) {}

  bool meets(const Aabb<S>& box) const {
    if (!bounds_.overlaps(box)) return false;
    // d × (corner − origin) over the four corners: all on one side of the line means that they do not meet.
    const S along_x0 = translation_.x() * (box.lower.y() - origin_.y());
    const S along_x1 = translation_.x() * (box.upper.y() - origin_.y());
    const S along_y0 = translation_.y() * (origin_.x() - box.lower.x());
    const S along_y1 = translation_.y() * (origin_.x() - box.upper.x());
    const S least = min_of(along_x0, along_x1) + min_of(along_y0, along_y1);
    const S greatest = max_of(along_x0, along_x1) + max_of(along_y0, along_y1);
    return !(least > S(0)) && !(greatest < S(0));
  }

  const Aabb<S>& bounds() const { return bounds_; }

 private:
  static Aabb<S> around(const Vec<S>& a, const Vec<S>& b) {
    return {Vec<S>(min_of(a.x(), b.x()), min_of(a.y(), b.y())), Vec<S>(max_of(a.x(), b.x()), max_of(a.y(), b.y()))};
  }

  Vec<S> origin_, translation_;
  Aabb<S> bounds_;
};

}  // namespace urto

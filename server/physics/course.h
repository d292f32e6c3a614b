#pragma once

#include <vector>

#include "physics/data.h"
#include "physics/narrow_phase/time_of_impact.h"

namespace urto {

// How bodies move within a step, t from 0 to 1: on straight lines, turning evenly, until an impact changes that. The
// first piece is the solver's own motion; only what an impact has changed is kept here.
template <class S>
struct Course {
  S since = 0;               // share of the step at which the piece began
  S x = 0, y = 0, a = 0;     // m, m, rad come by then
  S dx = 0, dy = 0, da = 0;  // m, m, rad per whole step from then on
  std::uint32_t body = kNone;
  std::uint32_t impacts = 0;  // so far
};

template <class S>
class Courses {
 public:
  // Borrows the world's list of places, which is as long as there are bodies, so that only changed ones cost anything.
  explicit Courses(WorldData<S>& world) : world_(world), index_(world.scratch.course) {
    index_.resize(world.bodies.size(), kNone);
  }
  ~Courses() {
    for (const Course<S>& course : changed_) index_[course.body] = kNone;
  }
  Courses(const Courses&) = delete;
  Courses& operator=(const Courses&) = delete;

  Course<S> of(std::uint32_t slot) const {
    if (index_[slot] != kNone) return changed_[index_[slot]];
    const Motion<S>& m = world_.motions[slot];
    Course<S> course;
    course.dx = m.dx;
    course.dy = m.dy;
    course.da = m.da;
    course.body = slot;
    return course;
  }

  std::uint32_t impacts(std::uint32_t slot) const { return index_[slot] == kNone ? 0 : changed_[index_[slot]].impacts; }

  // The course from t on, for the caller to give it another direction. Counts as an impact.
  Course<S>& turn_at(std::uint32_t slot, S t) {
    if (index_[slot] == kNone) {
      changed_.push_back(of(slot));
      index_[slot] = static_cast<std::uint32_t>(changed_.size() - 1);
    }
    Course<S>& course = changed_[index_[slot]];
    const S past = t - course.since;
    course.x += past * course.dx;
    course.y += past * course.dy;
    course.a += past * course.da;
    course.since = t;
    ++course.impacts;
    return course;
  }

  // That of a body which has had an impact.
  Course<S>& latest(std::uint32_t slot) { return changed_[index_[slot]]; }

  Vec<S> center_at(std::uint32_t slot, S t) const {
    const Course<S> c = of(slot);
    const Body<S>& body = world_.bodies[slot];
    return Vec<S>(body.x + (c.x + (t - c.since) * c.dx), body.y + (c.y + (t - c.since) * c.dy));
  }

  // From t, which is not before the last impact, to the end of the step.
  Sweep<S> sweep_from(std::uint32_t slot, S t) const {
    const Course<S> c = of(slot);
    const Body<S>& body = world_.bodies[slot];
    Sweep<S> sweep;
    sweep.local_center = body.local_center();
    sweep.c0 = center_at(slot, t);
    sweep.c1 = center_at(slot, S(1));
    sweep.angle0 = body.angle + (c.a + (t - c.since) * c.da);
    sweep.angle1 = body.angle + (c.a + (S(1) - c.since) * c.da);
    return sweep;
  }

  const std::vector<Course<S>>& changed() const { return changed_; }

 private:
  const WorldData<S>& world_;
  std::vector<std::uint32_t>& index_;  // by body slot, into changed_
  std::vector<Course<S>> changed_;
};

}  // namespace urto

#pragma once

#include "physics/constants.h"
#include "physics/solver/joint_kernels.h"
#include "physics/solver/joint_rows.h"

namespace urto {

// The joints' share of a soft step (soft_step.h), in each pass before the contacts', so that contacts are firmest.
template <class S>
class JointPasses {
 public:
  // Gathers the active joints; h: a sub-step in seconds.
  JointPasses(WorldData<S>& world, JointSet<S>& set, S h)
      : world_(world),
        set_(set),
        settings_{h, S(1) / h, implicit_spring(S(kJointHertzPerSubStepRate) / h, S(kJointDampingRatio), h)},
        points_(point_passes<S>()) {
    if (!world_.model.joints) return;
    gather_joints(world_, set_, h);
    run(points_.prepare);
  }
  void warm_start() {
    if (!world_.model.joints) return;
    warm_start_rows(world_, set_);
    run(points_.warm_start);
  }
  void solve() {
    if (!world_.model.joints) return;
    solve_rows(world_, set_, settings_);
    run(points_.solve);
  }
  void relax() {
    if (!world_.model.joints) return;
    relax_rows(world_, set_, settings_);
    run(points_.relax);
  }
  void store() {
    if (world_.model.joints) store_joints(world_, set_);
  }

 private:
  void run(typename PointPasses<S>::Pass pass) {
    pass(world_.motions.data(), set_.points.data(), set_.points.size(), settings_);
  }
  WorldData<S>& world_;
  JointSet<S>& set_;
  JointSettings<S> settings_;
  const PointPasses<S>& points_;
};

}  // namespace urto

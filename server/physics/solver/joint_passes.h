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
    share(points_.prepare, 0, set_.points.size(), kBlocksPerShare);
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
  using Pass = typename PointPasses<S>::Pass;

  // Colour after colour.
  void run(Pass pass) {
    std::size_t begin = 0;
    for (const std::uint32_t& end : set_.ends) {
      const bool one_by_one = &end == &set_.ends[kPointColors - 1];
      if (end > begin) share(pass, begin, end, one_by_one ? end - begin : kBlocksPerShare);
      begin = end;
    }
  }
  void share(Pass pass, std::size_t first, std::size_t last, std::size_t grain) {
    world_.team->share(last - first, grain, [&](unsigned, std::size_t begin, std::size_t end) {
      pass(world_.motions.data(), &set_.points[first] + begin, end - begin, settings_);
    });
  }
  WorldData<S>& world_;
  JointSet<S>& set_;
  JointSettings<S> settings_;
  const PointPasses<S>& points_;
};

}  // namespace urto

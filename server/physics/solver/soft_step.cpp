#include "physics/solver/soft_step.h"

#include <algorithm>
#include <atomic>

#include "physics/constants.h"
#include "physics/motion.h"
#include "physics/motion_kernels.h"
#include "physics/solver/contact_kernels.h"
#include "physics/solver/joint_passes.h"
#include "physics/solver/softness.h"

namespace urto {
namespace {

// What a block of contacts costs in a pass, in bodies that are moved, and from how many on it pays to share them out
// (decision 5: a heap of 2000 bodies loses by it, one of 5000 gains).
constexpr std::size_t kBodiesPerBlock = 24, kBodiesToShareSolve = 9000;

// A body without contacts and joints advances by the scene's integrator; one with contacts needs velocities that the
// contacts have seen, which is what semi-implicit Euler gives.
template <class S>
bool flies(const WorldData<S>& world, std::uint32_t slot) {
  const std::vector<std::uint64_t>& taken = world.touching.taken;
  return world.model.second_integrator && (slot >= taken.size() || taken[slot] == 0) &&
         world.bodies[slot].first_joint == kNoJoint;
}

// Whether nothing but gravity acts on the bodies between contacts. Then what it adds in a sub-step is the same for all
// of a step, and the sub-steps need not look at the bodies: `pulls` get it, by index of awake body.
template <class S>
bool only_gravity_acts(WorldData<S>& world, const Mover<S>& mover) {
  if (world.model.damping || world.model.fields || world.model.second_integrator) return false;
  world.scratch.pulls.resize(world.awake.size());
  std::atomic<bool> forces{false};
  world.team->share(world.awake.size(), kBodiesPerShare, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Body<S>& body = world.bodies[world.awake[i]];
      if (body.flags & kBodyHasForce) return forces.store(true, std::memory_order_relaxed);
      world.scratch.pulls[i] = mover.pull(body);
    }
  });
  return !forces.load(std::memory_order_relaxed);
}

// Where the passes are too short to be shared out, the bodies between them are not shared out either: they would only
// wander between the processors' caches. Then this is more than there is of anything.
template <class S>
std::size_t grain_of_solve(const WorldData<S>& world, std::size_t grain) {
  std::size_t work = world.awake.size();
  for (const auto& color : world.touching.colors) work += kBodiesPerBlock * color.blocks.size();
  return work >= kBodiesToShareSolve ? grain : work;
}

// The impulses of the last sub-step once more, by body: what the pass over the contacts would do again.
template <class S>
void take_kick(Motion<S>& m, Kick<S>& kick) {
  m.vx += kick.vx;
  m.vy += kick.vy;
  m.w += kick.w;
  kick = {};
}

template <class S, bool kKick>
void pull_bodies(WorldData<S>& world, std::size_t grain) {
  world.team->share(world.awake.size(), grain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t slot = world.awake[i];
      Motion<S>& m = world.motions[slot];
      m.vx += world.scratch.pulls[i].x();
      m.vy += world.scratch.pulls[i].y();
      if (kKick) take_kick(m, world.scratch.kicks[slot]);
    }
  });
}

template <class S>
void kick_bodies(WorldData<S>& world, std::size_t grain) {
  world.team->share(world.awake.size(), grain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      take_kick(world.motions[world.awake[i]], world.scratch.kicks[world.awake[i]]);
  });
}

template <class S>
void integrate_velocities(WorldData<S>& world, const Mover<S>& mover, std::size_t grain) {
  world.team->share(world.awake.size(), grain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t slot = world.awake[i];
      if (!flies(world, slot)) mover.integrate_velocity(world.bodies[slot], world.motions[slot]);
    }
  });
}

template <class S>
void integrate_positions(WorldData<S>& world, const Mover<S>& mover, S h, std::size_t grain) {
  if (!world.model.second_integrator) {
    world.team->share(world.awake.size(), grain, [&](unsigned, std::size_t begin, std::size_t end) {
      motion_kernels<S>().integrate_positions(world.motions.data(), &world.awake[begin], end - begin, h);
    });
    return;
  }
  world.team->share(world.awake.size(), grain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t slot = world.awake[i];
      if (flies(world, slot)) {
        mover.fly(world.bodies[slot], world.motions[slot]);
      } else {
        mover.integrate_position(world.motions[slot]);
      }
    }
  });
}

template <class S>
PassSettings<S> pass_settings(WorldData<S>& world, S h, S stiffer) {
  const S hertz = stiffer * min_of(S(kContactHertz), S(kContactHertzPerSubStepRate) / h);
  const Softness<S> soft(hertz, S(kContactDampingRatio), h);
  const S preload_rate = min_of(S(1), S(world.settings.time_step / kPreloadTime));
  return {S(1) / h,
          soft.bias_rate,
          soft.compliance,
          S(1) / S(world.settings.sub_steps),
          preload_rate,
          min_of(S(1) - preload_rate, S(world.settings.time_step / kPreloadTimeFast)),
          S(world.settings.restitution_threshold),
          world.model.friction,
          world.scratch.kicks.data()};
}

// Gauss-Seidel favours what it solves last; were that always the same side, a pile would lean over to it. So the
// colours of movable bodies are taken in turn forwards and backwards.
enum class Order { kForwards, kBackwards };

std::uint32_t color_at(std::uint32_t place, Order order) {
  return order == Order::kBackwards && place < kMovableColors ? kMovableColors - 1 - place : place;
}

// The blocks with more than half their lanes in use: all but the last, or none of those that hold one lane each.
template <class S>
std::size_t full_blocks(const typename ContactSet<S>::Color& color) {
  constexpr std::uint32_t kHalf = static_cast<std::uint32_t>(kLanes<S>) / 2;
  if (color.blocks.front().count <= kHalf) return 0;
  return color.blocks.size() - (color.blocks.back().count <= kHalf ? 1 : 0);
}

// Colour after colour, those with unmovable bodies last; the blocks of one are shared out. Those that fit no colour are
// solved one after the other.
template <class S, class Work>
void for_each_color(WorldData<S>& world, Order order, std::size_t block_grain, const Work& work) {
  for (std::uint32_t place = 0; place < kColorsMax; ++place) {
    const std::uint32_t i = color_at(place, order);
    auto& color = world.touching.colors[i];
    if (color.blocks.empty()) continue;
    const std::size_t grain = takes_what_fits_nowhere(i) ? color.blocks.size() : block_grain;
    const bool ground = i >= kMovableColors;
    world.team->share(color.blocks.size(), grain,
                      [&](unsigned, std::size_t begin, std::size_t end) { work(color, ground, begin, end); });
  }
}

}  // namespace

template <class S>
void solve_soft_step(WorldData<S>& world, JointSet<S>& joint_set) {
  const std::uint32_t n = world.settings.sub_steps;
  const S h = S(world.settings.time_step / n);
  const Mover<S> mover(world, h);
  const bool pulled = only_gravity_acts(world, mover);
  const std::size_t body_grain = grain_of_solve(world, kBodiesPerShare);
  const std::size_t block_grain = grain_of_solve(world, kBlocksPerPassShare);
  world.scratch.kicks.resize(world.bodies.size());
  const PassSettings<S> between = pass_settings(world, h, S(1));
  const PassSettings<S> on_ground = pass_settings(world, h, S(kGroundStiffness));
  const ContactPasses<S>&passes = contact_passes<S>(), &half = half_passes<S>();
  const auto run = [&](typename ContactPasses<S>::Pass ContactPasses<S>::*pass, Order order) {
    for_each_color(world, order, block_grain, [&](auto& color, bool ground, std::size_t begin, std::size_t end) {
      const PassSettings<S>& settings = ground ? on_ground : between;
      const std::size_t full = std::clamp(full_blocks<S>(color), begin, end);
      if (begin < full) (passes.*pass)(world.motions.data(), &color.blocks[begin], full - begin, settings);
      if (full < end) (half.*pass)(world.motions.data(), &color.blocks[full], end - full, settings);
    });
  };
  JointPasses<S> joints(world, joint_set, h);
  const auto note = [&](typename ContactPasses<S>::Note pass) {
    if (!world.model.restitution) return;
    for_each_color(world, Order::kForwards, block_grain, [&](auto& color, bool, std::size_t begin, std::size_t end) {
      pass(world.motions.data(), &color.blocks[begin], &color.rest[begin], end - begin, between);
    });
  };
  // Nothing has to be seen between the two: no bounces, whose speed is that of falling.
  const bool kick_and_pull = pulled && !world.model.restitution;
  for (std::uint32_t i = 0; i < n; ++i) {
    note(passes.note_approach);
    if (kick_and_pull && i > 0) {
      pull_bodies<S, true>(world, body_grain);
    } else if (pulled) {
      pull_bodies<S, false>(world, body_grain);
    } else {
      integrate_velocities(world, mover, body_grain);
    }
    note(passes.note_bounce);
    if (i > 0 && !kick_and_pull) kick_bodies(world, body_grain);
    joints.warm_start();
    if (i == 0) run(&ContactPasses<S>::warm_start, Order::kForwards);
    joints.solve();
    run(i == 0 ? &ContactPasses<S>::solve_first : &ContactPasses<S>::solve,
        i % 2 == 0 ? Order::kForwards : Order::kBackwards);
    integrate_positions(world, mover, h, body_grain);
    joints.relax();
    run(i + 1 < n ? &ContactPasses<S>::relax : &ContactPasses<S>::relax_last, Order::kBackwards);
    if (world.model.restitution) {
      for_each_color(world, Order::kForwards, block_grain, [&](auto& color, bool, std::size_t begin, std::size_t end) {
        passes.restitute(world.motions.data(), &color.blocks[begin], &color.rest[begin], end - begin,
                         i + 1 < n ? between.kicks : nullptr);
      });
    }
  }
  joints.store();
}

template void solve_soft_step(WorldData<float>&, JointSet<float>&);
template void solve_soft_step(WorldData<double>&, JointSet<double>&);

}  // namespace urto

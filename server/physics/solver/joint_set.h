#pragma once

#include <vector>

#include "physics/data.h"
#include "physics/simd/lanes.h"

namespace urto {

// Points that joints hold together, ready to be solved side by side: no two lanes of a block share a body that can
// move. The point of a revolute joint; all else of joints is solved one by one (JointRows).
template <class S>
struct alignas(64) PointBlock {
  // Scalars first: each array is one cache line, and aligned.
  S ax[kLanes<S>], ay[kLanes<S>], bx[kLanes<S>], by[kLanes<S>];  // m, arms at the start of the step, world axes
  S start_x[kLanes<S>], start_y[kLanes<S>];                      // m, from a's point to b's at the start of the step
  S inv_mass_a[kLanes<S>], inv_inertia_a[kLanes<S>], inv_mass_b[kLanes<S>], inv_inertia_b[kLanes<S>];
  // Where the bodies are now.
  S arm_ax[kLanes<S>], arm_ay[kLanes<S>], arm_bx[kLanes<S>], arm_by[kLanes<S>];  // m, to one point midway in the gap
  S gap_x[kLanes<S>], gap_y[kLanes<S>];                                          // m, from a's point to b's
  S m11[kLanes<S>], m12[kLanes<S>], m22[kLanes<S>];                              // kg, effective mass
  S impulse_x[kLanes<S>], impulse_y[kLanes<S>];                                  // N·s, of this sub-step
  S total_x[kLanes<S>], total_y[kLanes<S>];                                      // N·s, of the step so far
  std::uint32_t a[kLanes<S>], b[kLanes<S>];                                      // body slots; 0 in unused lanes
  std::uint32_t joint[kLanes<S>];
  std::uint8_t movable_a[kLanes<S>], movable_b[kLanes<S>];  // 0 or 1
  std::uint32_t count;                                      // of used lanes
};

// A damped spring for one sub-step of length h: the speed v at which it is stretched becomes keep · v − pull · x, if
// nothing else acts. keep is e^(−2ζωh), which is what a damped oscillator loses, and pull is keep · hω², which makes
// the stretch under a constant load right; undamped, that is symplectic Euler and loses nothing. The usual implicit
// spring (Catto, "Soft Constraints", GDC 2011) loses as much as a damping ratio of ωh/2 more. A spring too stiff for
// the sub-step is damped more, so that it stays stable: keep ≤ 1/(ωh)².
template <class S>
struct SpringStep {
  S keep = 0;
  S pull = 0;  // 1/s
  SpringStep() = default;
  SpringStep(S hertz, S damping_ratio, S h);
};

// The usual implicit spring, for what shall be stiff: its damping is welcome there.
template <class S>
SpringStep<S> implicit_spring(S hertz, S damping_ratio, S h);

// All of a joint that is not the point of a revolute joint. Which parts it has, its kind and flags say.
template <class S>
struct JointRows {
  std::uint32_t joint, kind, flags;
  std::uint32_t a, b;  // body slots; kNone: the world
  S inv_mass_a, inv_inertia_a, inv_mass_b, inv_inertia_b;
  S ax, ay, bx, by;      // m, arms at the start of the step, world axes
  S center_x, center_y;  // m, from a's centre to b's at the start of the step; mouse: from the target
  S ux, uy;              // prismatic: the axis at the start of the step, world axes
  S angle;               // rad, at the start of the step
  S reference, lower, upper, motor_speed;
  S motor_bound;  // N·s or N·m·s in a sub-step
  SpringStep<S> spring, angular_spring;
  // N·s or N·m·s of this sub-step.
  S impulse_x, impulse_y, turn, along, motor, low, high;
  S total_x, total_y, total_turn;  // on b, of the step so far
};

// The last colour takes what fits nowhere else, one lane a block: its blocks are solved one after the other.
inline constexpr std::uint32_t kPointColors = 64;

template <class S>
struct JointSet {
  std::vector<PointBlock<S>> points;      // by colour: no two blocks of one share a body that can move
  std::uint32_t ends[kPointColors] = {};  // where each colour's blocks end
  std::vector<JointRows<S>> rows;
  std::vector<std::uint64_t> taken;     // scratch: colours by body slot
  std::vector<std::uint8_t> colors;     // scratch: by revolute joint
  std::vector<std::uint32_t> revolute;  // scratch: joint slots
  std::vector<std::uint32_t> sorted;    // scratch: joint slots by colour
  struct Range {
    std::uint32_t begin, end;
  };
  std::vector<Range> ranges;  // scratch: of the sorted joints, by block
};

template <class S>
struct JointSettings {
  S h, inv_h;           // s, 1/s
  SpringStep<S> stiff;  // what holds together what is not a spring
};

// Collects the active joints, colours the points greedily in the order of the active list, and lays them out.
template <class S>
void gather_joints(WorldData<S>& world, JointSet<S>& set, S h);

// Writes impulses back for warm start, and forces for the reader.
template <class S>
void store_joints(WorldData<S>& world, const JointSet<S>& set);

}  // namespace urto

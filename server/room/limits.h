#pragma once

#include <cstddef>
#include <cstdint>

namespace urto {

// The bounds of one room. docs/protocol.md says what happens at each.
struct Limits {
  std::uint32_t bodies_max = 20'000;
  std::uint32_t shapes_max = 100'000;  // of all bodies, as described; decomposition may make more
  std::uint32_t joints_max = 40'000;
  std::uint32_t batch_commands_max = 1024;
  std::uint32_t queue_batches_max = 256;       // waiting, per user
  std::uint32_t batches_per_tick_max = 64;     // applied, per user and tick
  std::uint32_t message_bytes_max = 1u << 20;  // of one batch on the wire
  std::uint32_t members_max = 256;             // in the roster; also: users with batches waiting
  std::uint32_t events_kept_max = 65'536;      // for recovery
  std::uint32_t step_ticks_max = 36'000;       // of one step command: ten minutes at 60 Hz
  std::uint32_t steps_waiting_max = 256;       // step commands that are not yet answered
  std::uint32_t contact_events_per_tick_max = 4096;
  std::uint32_t refusals_per_tick_max = 256;  // BatchRejected events
  std::size_t queue_bytes_max = 16u << 20;    // waiting, per user, as they came over the wire
  std::size_t queues_bytes_max = 256u << 20;  // waiting, of all users
};

// Bounds on what a command may carry, beside those of physics/definitions.h.
inline constexpr std::size_t kNameBytesMax = 64;
inline constexpr std::size_t kTagBytesMax = 32;
inline constexpr std::size_t kTagsMax = 8;
inline constexpr std::uint32_t kColorMax = 0xFFFFFF;
inline constexpr std::uint32_t kNearestCountMax = 1024;
inline constexpr double kTimeScaleMin = 0.01;
inline constexpr double kTimeScaleMax = 100;
// Far above any use, and a tenth of what the engine takes: a vector that is turned into the world's frame stays below.
inline constexpr double kImpulseMax = 1e14;  // N·s and N·m·s
inline constexpr double kForceMax = 1e14;    // N and N·m
inline constexpr double kDurationMax = 1e9;  // s: 32 years, and its ticks fit 64 bits at any time step
inline constexpr double kAngleMax = 1e6;     // rad, of a teleport: a float still tells 0.06 rad apart

}  // namespace urto

#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "physics/world.h"
#include "room/body_registry.h"
#include "room/joint_registry.h"
#include "room/limits.h"
#include "room/reply.h"

namespace urto {

// Who may pause, resume, step, reset and scale time.
enum class Control : std::uint8_t { kEveryone, kOwners, kNobody };

struct Roles {
  Control control = Control::kEveryone;
  std::set<std::string> owners;

  bool may_control(const std::string& user) const;
};

// What a batch is judged by.
struct AdmissionContext {
  const Limits& limits;
  const Roles& roles;
  const World& world;
  const BodyRegistry& bodies;
  const BodyRegistry& scene_bodies;  // those that a reset brings back
  const JointRegistry& joints;
  const JointRegistry& scene_joints;
  bool paused = false;
  std::size_t steps_waiting = 0;
};

// Everything that could keep a batch from being applied, checked before any of it is. What passes cannot fail.
std::optional<Rejection> check_batch(const AdmissionContext& context, const std::string& user,
                                     const CommandBatch& batch);

// The checks of a body's description that the engine does not make: name, tags and colour. `field` of the result is
// relative to the body.
std::optional<Rejection> check_labels(const BodySpec& spec);

// The check of a joint's name. `field` of the result is relative to the joint.
std::optional<Rejection> check_joint_name(const std::string& name);

// A reference to a body or a joint as people read it.
std::string ref_text(const BodyRef& ref);

// An engine's refusal as a rejection; its field is put behind `prefix`.
Rejection rejection_from(const Error& error, const std::string& prefix);

}  // namespace urto

#include "room/build_scene.h"

#include <string>
#include <utility>

#include "room/admission.h"

namespace urto {
namespace {

Status check_limits(const SceneDef& scene, const Limits& limits) {
  if (scene.joints.size() > limits.joints_max) {
    return failure(ErrorCode::kLimitReached, "joints", std::to_string(scene.joints.size()),
                   "The room holds at most " + std::to_string(limits.joints_max) + " joints.");
  }
  if (scene.bodies.size() > limits.bodies_max) {
    return failure(ErrorCode::kLimitReached, "bodies", std::to_string(scene.bodies.size()),
                   "The room holds at most " + std::to_string(limits.bodies_max) + " bodies.");
  }
  std::size_t shapes = 0;
  for (const BodySpec& body : scene.bodies) shapes += shape_count_of(body.def);
  if (shapes > limits.shapes_max) {
    return failure(ErrorCode::kLimitReached, "bodies", std::to_string(shapes),
                   "The room holds at most " + std::to_string(limits.shapes_max) + " shapes.");
  }
  return {};
}

// Force fields are part of the engine's settings, but stand beside them in a scene.
std::string settings_path(const std::string& field) { return field.rfind("fields", 0) == 0 ? field : "world." + field; }

Status add_body(const BodySpec& spec, BuiltScene& built) {
  if (const auto bad = check_labels(spec)) {
    return failure(ErrorCode::kInvalidValue, bad->field, bad->value, bad->message);
  }
  if (!spec.name.empty() && built.bodies.find(spec.name)) {
    return failure(ErrorCode::kInvalidValue, "name", spec.name, "Another body of the scene has this name.");
  }
  const auto id = built.world->add_body(spec.def);
  if (!id) return tl::unexpected<Error>(id.error());
  const auto mass = built.world->mass_properties(*id);
  if (!mass) return tl::unexpected<Error>(mass.error());
  built.bodies.add(std::make_shared<BodyRecord>(BodyRecord{*id, spec, "", *mass}));
  return {};
}

// The body's id into `id`; a scene knows its bodies by name.
Status find_body(const char* field, const BodyRef& ref, const BuiltScene& built, BodyId& id) {
  const auto record = built.bodies.find(ref);
  if (!record) return failure(ErrorCode::kUnknownBody, field, ref_text(ref), "No body of the scene is meant by this.");
  id = record->id;
  return {};
}

Status add_joint(JointSpec spec, BuiltScene& built) {
  if (const auto bad = check_joint_name(spec.name)) {
    return failure(ErrorCode::kInvalidValue, bad->field, bad->value, bad->message);
  }
  if (!spec.name.empty() && built.joints.find(JointRef(spec.name))) {
    return failure(ErrorCode::kInvalidValue, "name", spec.name, "Another joint of the scene has this name.");
  }
  if (spec.body_a) {
    if (Status status = find_body("body_a", *spec.body_a, built, spec.def.body_a); !status) return status;
  }
  if (Status status = find_body("body_b", spec.body_b, built, spec.def.body_b); !status) return status;
  const auto id = built.world->add_joint(spec.def);
  if (!id) return tl::unexpected<Error>(id.error());
  built.joints.add(std::make_shared<JointRecord>(JointRecord{*id, std::move(spec), ""}));
  return {};
}

Error inside(Error error, const char* list, std::size_t index) {
  error.field = list + ("[" + std::to_string(index) + "].") + error.field;
  return error;
}

}  // namespace

Expected<BuiltScene> build_scene(const SceneDef& scene, const Limits& limits, const WorldFactory& make_world) {
  if (Status status = check_limits(scene, limits); !status) return tl::unexpected<Error>(status.error());
  BuiltScene built;
  auto world = make_world(scene.world);
  if (!world) {
    Error error = world.error();
    error.field = settings_path(error.field);
    return tl::unexpected<Error>(std::move(error));
  }
  built.world = std::move(*world);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (Status status = add_body(scene.bodies[i], built); !status)
      return tl::unexpected<Error>(inside(status.error(), "bodies", i));
  }
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    if (Status status = add_joint(scene.joints[i], built); !status)
      return tl::unexpected<Error>(inside(status.error(), "joints", i));
  }
  return built;
}

}  // namespace urto

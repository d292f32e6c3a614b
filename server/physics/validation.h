#pragma once

#include "physics/definitions.h"
#include "physics/error.h"
#include "physics/joint_definitions.h"

namespace urto {

// Checks of what users hand in. Errors carry the path of the offending field.

Status check_settings(const WorldSettings& settings);
Status check_body_def(const BodyDef& def);
// All but the bodies.
Status check_joint_def(const JointDef& def);
Status check_motor(const JointMotor& motor);

// kInvalidValue unless |value| ≤ bound (and it is a number).
Status check_bounded(const char* field, double value, double bound);
Status check_vector(const char* field, const Vec2& value, double bound);

}  // namespace urto

#pragma once

#include "room/reply.h"
#include "urto/v1/snapshot.pb.h"

namespace urto::codec {

// Values from messages that check_message() let pass: nothing can fail.
BodyRef body_ref_from_proto(const v1::BodyRef& message);
JointSpec joint_from_proto(const v1::Joint& message);
JointMotor motor_from_proto(const v1::JointMotor& message);

void write_joint(const JointSpec& joint, v1::Joint* out);  // bodies by id where it has them, else as they were named
void write_joint_info(const JointInfo& info, v1::JointInfo* out);

}  // namespace urto::codec

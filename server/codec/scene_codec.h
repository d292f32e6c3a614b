#pragma once

#include "physics/query_shape.h"
#include "room/scene.h"
#include "urto/v1/command.pb.h"
#include "urto/v1/scene.pb.h"

namespace urto::codec {

// Values from messages that check_message() let pass: nothing can fail. Values keep the ranges they were sent with;
// the room and the engine judge them.
Vec2 vector_from_proto(const v1::Vector& message);
QueryShape query_shape_from_proto(const v1::QueryShape& message);
BodySpec body_from_proto(const v1::Body& message);
SceneDef scene_from_proto(const v1::Scene& message);

// Absent fields mean defaults, so what is written says every value.
void write_vector(const Vec2& vector, v1::Vector* out);
void write_body(const BodySpec& body, v1::Body* out);
void write_scene(const SceneDef& scene, v1::Scene* out);
void write_scene_without_bodies(const SceneDef& scene, v1::Scene* out);
v1::Precision precision_to_proto(Precision precision);

}  // namespace urto::codec

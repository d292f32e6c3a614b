#pragma once

#include <functional>

#include "physics/world.h"
#include "room/body_registry.h"
#include "room/reply.h"

namespace urto {

// What a query can see. Only the room knows its tick, so diagnostics are its own.
struct QueryContext {
  const World& world;
  const BodyRegistry& bodies;
  const JointRegistry& joints;
  std::function<Diagnostics()> diagnostics;
};

// The answer to a query that admission let pass.
Expected<QueryResult> answer_query(const QueryContext& context, const RoomQuery& query);

// Of a body that exists.
Expected<BodyInfo> body_info(const World& world, BodyRecordPtr record);

// Of every joint, ascending id.
Expected<std::vector<JointInfo>> joint_infos(const World& world, const JointRegistry& joints);

}  // namespace urto

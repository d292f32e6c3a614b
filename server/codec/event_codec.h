#pragma once

#include <string>

#include "room/event_log.h"

namespace urto::codec {

// An EventBatch.
std::string encode_events(const EventSlice& slice);

}  // namespace urto::codec

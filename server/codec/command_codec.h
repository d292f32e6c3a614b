#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "room/command.h"
#include "room/limits.h"
#include "room/reply.h"

namespace urto::codec {

// A refused message: its sequence, where it could be read, and why.
struct DecodeFailure {
  std::uint64_t sequence = 0;
  Rejection rejection;
};

// A CommandBatch. What is decoded has its oneofs and targets set, known enum values and finite numbers; the room judges
// the values.
tl::expected<CommandBatch, DecodeFailure> decode_batch(std::string_view bytes, const Limits& limits);

// A CommandReply.
std::string encode_reply(const BatchReply& reply);

}  // namespace urto::codec

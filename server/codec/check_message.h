#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>

namespace urto::codec {

// What a message holds that no message may.
struct FieldIssue {
  enum class Kind { kMalformed, kInvalidValue };
  Kind kind = Kind::kMalformed;
  std::string field;    // path from the message's root, e.g. "shapes[0].box.width"
  std::string value;    // as text
  std::string message;  // one sentence for people
};

// The first issue in the order of the fields: an enum value or a field that the schema does not know, a oneof of which
// nothing is set, a number that is not finite. The issue's path starts with `prefix`.
std::optional<FieldIssue> check_message(const google::protobuf::Message& message, const std::string& prefix = "");

}  // namespace urto::codec

#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>

namespace urto {

// What was wrong with an argument of the public API.
enum class ErrorCode : std::uint8_t {
  kInvalidValue,     // outside its range, or not finite
  kUnknownBody,      // no body has this id (any more)
  kUnknownJoint,     // no joint has this id (any more)
  kWrongJointKind,   // a motor of a weld, say
  kNotSupported,     // by the solver that the scene names
  kDegenerateShape,  // a polygon without area, crossing itself, or too thin
  kWrongBodyType,    // an impulse on a static body, say
  kLimitReached,     // a named bound of definitions.h
  kCorruptState,     // a saved state that is not one of this version and precision
};

// A refusal. Whatever call returns one has left the world as it was.
struct Error {
  ErrorCode code = ErrorCode::kInvalidValue;
  std::string field;    // path of the offending value, e.g. "shapes[0].box.width"
  std::string value;    // the value itself, as text
  std::string message;  // one sentence for people
};

template <class T>
using Expected = tl::expected<T, Error>;
using Status = tl::expected<void, Error>;

inline tl::unexpected<Error> failure(ErrorCode code, std::string field, std::string value, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(field), std::move(value), std::move(message)});
}

}  // namespace urto

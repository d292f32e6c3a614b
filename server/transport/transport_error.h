#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace urto {

enum class TransportErrorCode {
  kAddressInUse,       // something else listens there
  kBadEndpoint,        // not PROTOCOL/HOST:PORT, or a host that cannot be found or listened on
  kPermissionDenied,   // the system forbids this address (a port below 1024, say)
  kCannotConnect,      // nobody answered, or they refused the credentials: Zenoh shows the two alike
  kBadUserDictionary,  // unreadable, empty, or a line that is not USER:PASSWORD
  kBadOption,          // a value outside its range, or options that exclude each other
  kBadKey,             // not a key (expression), see key_expression.h
  kAlreadyAnswered,    // the second answer to one query
  kClosed,             // the transport was closed before
  kInternal,           // none of these; the message has the library's words
};

// A refusal by the transport.
struct TransportError {
  TransportErrorCode code = TransportErrorCode::kInternal;
  std::string subject;  // what it is about: an endpoint, a key expression, a file, the name of an option
  std::string message;  // one sentence for people; it names the subject
};

template <class T>
using TransportExpected = tl::expected<T, TransportError>;
using TransportStatus = tl::expected<void, TransportError>;

inline tl::unexpected<TransportError> transport_failure(TransportErrorCode code, std::string subject,
                                                        std::string message) {
  return tl::unexpected<TransportError>(TransportError{code, std::move(subject), std::move(message)});
}

std::string_view name_of(TransportErrorCode code);  // "address in use"

}  // namespace urto

#include "transport/transport_error.h"

namespace urto {

std::string_view name_of(TransportErrorCode code) {
  switch (code) {
    case TransportErrorCode::kAddressInUse:
      return "address in use";
    case TransportErrorCode::kBadEndpoint:
      return "bad endpoint";
    case TransportErrorCode::kPermissionDenied:
      return "permission denied";
    case TransportErrorCode::kCannotConnect:
      return "cannot connect";
    case TransportErrorCode::kBadUserDictionary:
      return "bad user dictionary";
    case TransportErrorCode::kBadOption:
      return "bad option";
    case TransportErrorCode::kBadKey:
      return "bad key";
    case TransportErrorCode::kAlreadyAnswered:
      return "already answered";
    case TransportErrorCode::kClosed:
      return "closed";
    case TransportErrorCode::kInternal:
      return "internal error";
  }
  return "unknown error";
}

}  // namespace urto

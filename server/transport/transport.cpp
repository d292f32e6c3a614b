#include "transport/transport.h"

#include <string>

#include "transport/key_expression.h"

namespace urto {

TransportStatus check_get(const GetRequest& request) {
  if (request.timeout.count() <= 0) {
    return transport_failure(TransportErrorCode::kBadOption, "timeout",
                             "a get() needs a timeout above 0 ms, not " + std::to_string(request.timeout.count()));
  }
  return check_key_expression(request.key);
}

}  // namespace urto

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "transport/transport.h"
#include "transport/zenoh/zenoh_options.h"

namespace urto {

// A Zenoh session. What goes over the wire is plain Zenoh: any Zenoh client of version 1 understands it.
class ZenohTransport : public Transport {
 public:
  // Listens and connects as told. A peer is open when it listens; a connection to a router that is not there yet is
  // tried again in the background. A client is open when it is connected, or fails after its timeout.
  static TransportExpected<std::unique_ptr<ZenohTransport>> open(const ZenohOptions& options);

  // Where it can be reached, with the real port where the options asked for port 0.
  virtual std::vector<std::string> endpoints() const = 0;
};

}  // namespace urto

#pragma once

#include <string>
#include <string_view>

#include "transport/transport_error.h"
#include "transport/zenoh/zenoh_options.h"

namespace urto {

// The whole Zenoh configuration that the options stand for, as JSON; the one place where a setting of Zenoh is chosen.
TransportExpected<std::string> zenoh_config_json(const ZenohOptions& options);

// What Zenoh's words for a failed open mean.
TransportError open_error(const ZenohOptions& options, std::string_view zenoh_message);

}  // namespace urto

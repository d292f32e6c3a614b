#pragma once

#include <string_view>

#include "transport/transport_error.h"

namespace urto {

// Keys are chunks joined by '/', as in "urto/v1/lab/snapshot". In a key expression a chunk may be "*" (any one chunk)
// or "**" (any number of chunks, none too). This is the part of Zenoh's key expression language that Urto uses:
// printable ASCII, and no wildcard inside a chunk ("$*").
// https://github.com/eclipse-zenoh/roadmap/blob/main/rfcs/ALL/Key%20Expressions.md
TransportStatus check_key(std::string_view key);                        // no wildcards
TransportStatus check_key_expression(std::string_view key_expression);  // in Zenoh's canonical form

bool has_wildcard(std::string_view key_expression);

// Whether some key matches both. Both are valid key expressions.
bool intersects(std::string_view a, std::string_view b);

}  // namespace urto

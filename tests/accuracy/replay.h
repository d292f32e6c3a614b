#pragma once

#include <string>

#include "accuracy/case.h"

namespace urto::accuracy {

// The first scene of a case as a scene file (docs/scenes.md), and what Urto makes of it in so many steps, as JSON:
//   {"scene": TEXT, "hash": "0123456789abcdef", "states": [[x, y, angle, velocity x, y, spin] of each body in order]}
// For the tests that want the same bits from a served room.
std::string replay(const Case& a_case, const Method& method, int steps);

}  // namespace urto::accuracy

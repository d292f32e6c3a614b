#pragma once

#include "accuracy/scene.h"

namespace urto::accuracy {

// The question of the thesis that Urto began with: how many rectangles fit in a sixtieth of a second? They fall into a
// box that grows with their count, bounce, and stay awake.
Scene rectangles(int count);

}  // namespace urto::accuracy

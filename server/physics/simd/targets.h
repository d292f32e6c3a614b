#pragma once

// Which instruction sets the files under Highway are compiled for: before <hwy/foreach_target.h>. A few are enough:
// the oldest processors, and each doubling of the width. Vectors of a length unknown to the compiler (SVE) cannot be
// members of a struct.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)

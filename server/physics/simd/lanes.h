#pragma once

namespace urto {

// Lanes of a block: one cache line of scalars, and the widest vector of any machine that Urto runs on. Narrower
// vectors take a block in pieces; as lanes do not touch each other, the bits are the same.
template <class S>
inline constexpr int kLanes = static_cast<int>(64 / sizeof(S));

}  // namespace urto

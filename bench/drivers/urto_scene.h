#pragma once

// A scene of the benchmark as Urto's definitions.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "physics/world.h"
#include "scene_file.h"

namespace bench {

// Ends the program with a message on an error.
template <class T>
T expect(urto::Expected<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "%s (%s = %s)\n", result.error().message.c_str(), result.error().field.c_str(),
               result.error().value.c_str());
  std::exit(1);
}

urto::Vec2 vec(const Point& point);
urto::BodyDef body_def(const Body& body);
urto::WorldSettings world_settings(const Scene& scene);

// Takes the instruction set of this name for all worlds from now on; empty: the best. Returns which it is.
std::string choose_simd(const std::string& name);

// The worlds' clock.
std::uint64_t nanoseconds();

}  // namespace bench

#pragma once

#include "accuracy/simulator.h"

namespace urto::accuracy {

// Urto through its public World.
std::unique_ptr<Simulator> make_urto(const WorldSettings& settings);
std::unique_ptr<Simulator> make_urto_on(unsigned threads, const WorldSettings& settings);

}  // namespace urto::accuracy

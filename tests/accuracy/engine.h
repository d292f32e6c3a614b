#pragma once

// What a program that measures is linked with: one engine.

#include "accuracy/simulator.h"

namespace urto::accuracy {

std::string engine_name();
std::string engine_version();
std::unique_ptr<Simulator> make_engine(const WorldSettings& settings);

}  // namespace urto::accuracy

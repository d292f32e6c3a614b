#pragma once

// What a program that measures is linked with: one engine.

#include "accuracy/simulator.h"

namespace urto::accuracy {

std::string engine_name();
std::string engine_version();
// Throws Lacks, also if the program's engine is not measured on several threads.
std::unique_ptr<Simulator> make_engine(const WorldSettings& settings, unsigned threads);

}  // namespace urto::accuracy

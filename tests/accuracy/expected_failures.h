#pragma once

#include <map>
#include <string>
#include <utility>

namespace urto::accuracy {

// Levels that are not met yet, with the error that was measured: case and profile → error.
using ExpectedFailures = std::map<std::pair<std::string, std::string>, double>;

// Throws std::runtime_error if a line is none.
ExpectedFailures read_expected_failures(const std::string& path);

}  // namespace urto::accuracy

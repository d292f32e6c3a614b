#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace urto {

// A JSON string with its quotes. The text is UTF-8.
std::string json_string(std::string_view text);
std::string json_strings(const std::vector<std::string>& texts);  // an array

}  // namespace urto

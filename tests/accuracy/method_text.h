#pragma once

#include <string>

#include "accuracy/method.h"

namespace urto::accuracy {

// A method from words with commas between them: a profile, then what changes it, e.g.
// "default,solver=thesis,sub_steps=60". Throws std::invalid_argument.
Method method_from(const std::string& text);

}  // namespace urto::accuracy

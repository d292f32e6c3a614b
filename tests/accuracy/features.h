#pragma once

#include <string>
#include <vector>

#include "accuracy/scene.h"

namespace urto::accuracy {

// A part of the model that a scene can do without: the same scene where it is left out, and where it is on and has
// nothing to do, because what needs it stands far away from all else. All bodies but the last, which is that bystander,
// must move alike.
struct FeatureCase {
  std::string feature, scene;
  Scene without, idle;
};

std::vector<FeatureCase> feature_cases();

}  // namespace urto::accuracy

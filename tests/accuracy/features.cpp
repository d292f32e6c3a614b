#include "accuracy/features.h"

#include <functional>

#include "accuracy/rectangles.h"

namespace urto::accuracy {
namespace {

constexpr int kCount = 300;
const Vec2 kFarAway(5000, 5000);

// Nothing rubs, nothing bounces.
Scene plain_pile() {
  Scene scene = rectangles(kCount);
  for (BodyDef& def : scene.bodies) def = with_friction(with_restitution(def, 0), 0);
  return scene;
}

Scene pyramid() {
  constexpr int kRows = 24;
  Scene scene;
  scene.add(floor_of(200));
  for (int row = 0; row < kRows; ++row)
    for (int column = row; column < kRows; ++column)
      scene.add(box_at({column - row + 0.5 * row - 0.5 * (kRows - 1), row + 0.5}, 1, 1));
  return scene;
}

using Change = std::function<void(Scene&, BodyDef& bystander)>;

// The two scenes differ by the change alone, which makes the bystander or the settings need the feature.
FeatureCase feature_case(const std::string& feature, const std::string& name, const Scene& scene,
                         const Change& change) {
  FeatureCase out{feature, name, scene, scene};
  BodyDef bystander = with_friction(with_restitution(box_at(kFarAway, 1, 1), 0), 0);
  bystander.gravity_scale = 0;
  out.without.add(bystander);
  change(out.idle, bystander);
  out.idle.add(bystander);
  return out;
}

}  // namespace

std::vector<FeatureCase> feature_cases() {
  std::vector<FeatureCase> out;
  Scene smooth = plain_pile();
  smooth.settings.friction_mixing = Mixing::kMinimum;  // two rough shapes are needed, and one is alone
  const auto rough = [](Scene& scene, BodyDef& bystander) {
    // The floor meets smooth rectangles alone.
    scene.bodies[0] = with_friction(scene.bodies[0], 0.5);
    bystander = with_friction(bystander, 0.5);
  };
  out.push_back(feature_case("friction", "pile", smooth, rough));
  const auto bouncing = [](Scene&, BodyDef& bystander) { bystander = with_restitution(bystander, 0.5); };
  out.push_back(feature_case("restitution", "pile", plain_pile(), bouncing));
  out.push_back(feature_case("restitution", "pyramid", pyramid(), bouncing));
  const auto damped = [](Scene&, BodyDef& bystander) { bystander.linear_damping = 0.1; };
  out.push_back(feature_case("damping", "pile", rectangles(kCount), damped));
  out.push_back(feature_case("damping", "pyramid", pyramid(), damped));
  const auto field = [](Scene& scene, BodyDef&) { scene.settings.fields.push_back(Drag{0, 0}); };
  out.push_back(feature_case("force fields", "pile", rectangles(kCount), field));
  const auto swept = [](Scene& scene, BodyDef&) { scene.settings.continuous = true; };
  Scene slow = pyramid();
  slow.settings.continuous = false;
  out.push_back(feature_case("continuous collision", "pyramid", slow, swept));
  const auto drowsy = [](Scene& scene, BodyDef& bystander) {
    scene.settings.sleeping = true;
    bystander.velocity = {1, 0};
  };
  out.push_back(feature_case("sleeping", "pile", rectangles(kCount), drowsy));
  const auto sensing = [](Scene&, BodyDef& bystander) {
    bystander.shapes.push_back(bystander.shapes[0]);
    bystander.shapes[1].sensor = true;
  };
  out.push_back(feature_case("sensors", "pile", rectangles(kCount), sensing));
  return out;
}

}  // namespace urto::accuracy

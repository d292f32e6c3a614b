#include "accuracy/rectangles.h"

#include <algorithm>
#include <cmath>

namespace urto::accuracy {

Scene rectangles(int count) {
  constexpr double kPitch = 1.2, kRestitution = 0.5;  // m
  const int columns = std::max(3, static_cast<int>(std::lround(std::sqrt(2.0 * count))));
  const double half = 0.5 * kPitch * columns, height = 2 * half;
  Scene scene;
  scene.add(with_restitution(box_at({0, -1}, 2 * half + 4, 2, BodyType::kStatic), kRestitution));
  for (const double side : {-1.0, 1.0})
    scene.add(with_restitution(box_at({side * (half + 1), height}, 2, 2 * height, BodyType::kStatic), kRestitution));
  Random random(60);
  for (int i = 0; i < count; ++i) {
    const double x = (i % columns + 0.5) * kPitch - half, y = 1 + (i / columns) * kPitch;
    BodyDef def = box_at({x, y}, random.between(0.4, 0.8), random.between(0.4, 0.8));
    def.angle = random.between(-kPi, kPi);
    def.velocity = {random.between(-2, 2), random.between(-2, 2)};
    scene.add(with_restitution(def, kRestitution));
  }
  return scene;
}

}  // namespace urto::accuracy

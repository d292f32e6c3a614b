#include <cmath>
#include <cstdio>

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

// Bodies that slide without friction over the joints of a floor: nothing may hold them up or turn them.
struct Slide {
  double speed_error = 0;  // greatest |v − v₀| / v₀
  double angle = 0;        // rad, greatest
};

void add_plates(World& world, double width, int count) {
  for (int i = 0; i < count; ++i) {
    BodyDef plate = box_body((i + 0.5) * width, -1, width, 2, BodyType::kStatic);
    plate.shapes[0].material.friction = 0;
    add(world, plate);
  }
}

void add_chain(World& world, double width, int count) {
  Chain chain;
  for (int i = count; i >= 0; --i) chain.vertices.push_back({i * width, 0});
  BodyDef floor = body_with(ShapeDef{chain, {}, {}, false}, {0, 0}, BodyType::kStatic);
  floor.shapes[0].material.friction = 0;
  add(world, floor);
}

Slide slide(World& world, BodyDef def, double speed, double from, double to) {
  def.position.x() = from;
  def.velocity = {speed, 0};
  def.shapes[0].material.friction = 0;
  const BodyId id = add(world, def);
  Slide worst;
  for (int i = 0; i < 100000; ++i) {
    world.step();
    const BodyState state = *world.body(id);
    worst.speed_error = std::max(worst.speed_error, std::abs(state.velocity.x() - speed) / std::abs(speed));
    worst.angle = std::max(worst.angle, std::abs(state.angle));
    if ((state.position.x() - to) * speed > 0) break;
  }
  return worst;
}

TEST(SeamTest, DISABLED_Measure) {
  for (int floor = 0; floor < 2; ++floor)
    for (int kind = 0; kind < 2; ++kind)
      for (double speed : {0.05, 0.5, 1.7, 5.0, 20.0, -0.5, -5.0})
        for (double width : {1.0, 3.0, 10.0}) {
          auto world = make_world();
          if (floor == 0)
            add_plates(*world, width, static_cast<int>(20 / width) + 1);
          else
            add_chain(*world, width, static_cast<int>(20 / width) + 1);
          const BodyDef def = kind == 0 ? box_body(0, 0.5) : ball_body(0, 0.5);
          const double from = speed > 0 ? 1.3 : 15.0, to = speed > 0 ? (speed < 0.1 ? 4 : 15.0) : 1.3;
          const Slide s = slide(*world, def, speed, from, to);
          std::printf("%s %s v=%g w=%g dv/v=%.2e angle=%.2e\n", floor ? "chain" : "plates", kind ? "ball" : "box",
                      speed, width, s.speed_error, s.angle);
        }
}

}  // namespace
}  // namespace urto

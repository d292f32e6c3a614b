#include "physics/seams.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

enum class Floor { kPlates, kChain };

// Bodies that slide without friction over the joints of a floor: nothing may hold them up or turn them.
struct Slide {
  double slowed = 0;  // greatest |v − v₀| / v₀
  double turned = 0;  // rad, greatest
};

void add_floor(World& world, Floor kind, double width, double length) {
  const int count = static_cast<int>(length / width) + 1;
  if (kind == Floor::kPlates) {
    for (int i = 0; i < count; ++i) add(world, box_body((i + 0.5) * width, -1, width, 2, BodyType::kStatic));
    return;
  }
  Chain chain;  // from right to left: its front is above
  for (int i = count; i >= 0; --i) chain.vertices.push_back({i * width, 0});
  add(world, body_with(ShapeDef{chain, {}, {}, false}, {0, 0}, BodyType::kStatic));
}

Slide slide(World& world, const Geometry& geometry, double speed, double from, double to) {
  BodyDef def = body_with({geometry, {}, {}, false}, {from, 0.5});
  def.shapes[0].material.friction = 0;  // and with it that of the pair: the geometric mean
  def.velocity = {speed, 0};
  const BodyId id = add(world, def);
  Slide worst;
  const int steps = static_cast<int>(std::abs((to - from) / speed) / world.settings().time_step);
  for (int i = 0; i < steps; ++i) {
    world.step();
    const BodyState state = *world.body(id);
    worst.slowed = std::max(worst.slowed, std::abs(state.velocity.x() - speed) / std::abs(speed));
    worst.turned = std::max(worst.turned, std::abs(state.angle));
  }
  EXPECT_NEAR(world.body(id)->position.y(), 0.5, 1e-3);
  return worst;
}

class SlideTest : public ::testing::TestWithParam<std::tuple<Precision, Floor, double>> {};
INSTANTIATE_TEST_SUITE_P(Floors, SlideTest,
                         ::testing::Combine(::testing::Values(Precision::kFloat, Precision::kDouble),
                                            ::testing::Values(Floor::kPlates, Floor::kChain),
                                            ::testing::Values(0.3, 1.0, 3.0, 10.0)));

TEST_P(SlideTest, NothingIsFeltOfTheJoints) {
  const auto [precision, floor, width] = GetParam();
  const Geometry shapes[] = {Box{1, 1, {0, 0}, 0}, Circle{0.5, {0, 0}}, Capsule{{-0.4, 0}, {0.4, 0}, 0.5},
                             Box{0.6, 0.6, {0, 0}, 0, 0.2}};
  for (const Geometry& shape : shapes) {
    for (double speed : {0.1, 0.5, 1.7, 3.3, 5.0, 20.0, -0.5, -5.0}) {
      WorldSettings settings = settings_for(precision);
      settings.sleeping = false;
      auto world = make_world(settings), smooth = make_world(settings);
      add_floor(*world, floor, width, 20);
      add_floor(*smooth, floor, 50, 20);
      const double far = std::abs(speed) < 0.2 ? 4 : (std::abs(speed) < 1 ? 6.93 : 14.93);
      const double from = speed > 0 ? 1.37 : far, to = speed > 0 ? far : 1.37;
      const Slide s = slide(*world, shape, speed, from, to), on_one = slide(*smooth, shape, speed, from, to);
      EXPECT_LE(s.slowed, 1e-6) << "shape " << shape.index() << " at " << speed;
      EXPECT_LE(s.turned, on_one.turned + 1e-6) << "shape " << shape.index() << " at " << speed;
    }
  }
}

// What is a step, a gap or a wall and no seam stays what it is.
class NoSeamTest : public ::testing::TestWithParam<Precision> {
 protected:
  double end_of_slide(const Geometry& shape, const std::vector<BodyDef>& ground, double speed = 3) {
    auto world = make_world(settings_for(GetParam()));
    for (const BodyDef& def : ground) add(*world, def);
    BodyDef def = body_with({shape, {}, {}, false}, {-3, 0.5});
    def.shapes[0].material.friction = 0;
    def.velocity = {speed, 0};
    const BodyId id = add(*world, def);
    step_for(*world, 2);
    return world->body(id)->position.x();
  }
};
INSTANTIATE_TEST_SUITE_P(Precisions, NoSeamTest, ::testing::Values(Precision::kFloat, Precision::kDouble));

TEST_P(NoSeamTest, AStepStops) {
  const BodyDef floor = box_body(-5, -1, 10, 2, BodyType::kStatic);
  for (double height : {0.02, 0.1, 0.7}) {
    const BodyDef step = box_body(5, -1 + height, 10, 2, BodyType::kStatic);
    EXPECT_LT(end_of_slide(Box{1, 1, {0, 0}, 0}, {floor, step}), -0.45) << height;
  }
  const BodyDef wall = box_body(0.5, 3, 1, 6, BodyType::kStatic);  // stands on the floor's height
  EXPECT_LT(end_of_slide(Box{1, 1, {0, 0}, 0}, {floor, wall}), -0.45);
  EXPECT_LT(end_of_slide(Circle{0.5, {0, 0}}, {floor, wall}), -0.45);
}

// A box that leans on one corner slides into a wall: the corner touches floor and wall in one point.
TEST_P(NoSeamTest, AWallStopsACornerOnTheFloor) {
  auto world = make_world(settings_for(GetParam()));
  add(*world, box_body(-5, -1, 10, 2, BodyType::kStatic));
  add(*world, box_body(5, 0, 10, 6, BodyType::kStatic));
  BodyDef def = box_body(-1, 0.70710678);
  def.angle = 0.78539816;
  def.fixed_rotation = true;
  def.shapes[0].material.friction = 0;
  def.velocity = {3, 0};
  const BodyId id = add(*world, def);
  step_for(*world, 2);
  EXPECT_LT(world->body(id)->position.x(), -0.7);
}

TEST_P(NoSeamTest, ABoxTipsOverTheEndOfAPlateAndABallFallsIntoAGap) {
  const BodyDef left = box_body(-5, -1, 10, 2, BodyType::kStatic);
  auto world = make_world(settings_for(GetParam()));
  add(*world, left);
  const BodyId box = add(*world, box_body(0.1, 0.5));  // its centre is beyond the end
  step_for(*world, 1);
  EXPECT_LT(world->body(box)->position.y(), 0.4);
  auto gap = make_world(settings_for(GetParam()));
  add(*gap, left);
  add(*gap, box_body(6.2, -1, 10, 2, BodyType::kStatic));  // 1.2 m wide
  const BodyId ball = add(*gap, ball_body(0.6, 0.6));
  step_for(*gap, 1);
  EXPECT_LT(gap->body(ball)->position.y(), -0.5);
}

// Plates keep their own surface: on ice beyond the seam a box loses its grip.
TEST_P(NoSeamTest, EachPlateKeepsItsFriction) {
  auto world = make_world(settings_for(GetParam()));
  BodyDef rough = box_body(-5, -1, 10, 2, BodyType::kStatic), ice = box_body(5, -1, 10, 2, BodyType::kStatic);
  ice.shapes[0].material.friction = 0;
  add(*world, rough);
  add(*world, ice);
  BodyDef def = box_body(0, 0.5);  // half on each
  def.velocity = {0.01, 0};
  const BodyId id = add(*world, def);
  ASSERT_TRUE(world->set_velocity(id, {3, 0}, 0));
  world->step();
  const double expected = 3 - 0.6 * 9.81 / 60 / 2;  // only half of the weight rubs
  EXPECT_NEAR(world->body(id)->velocity.x(), expected, 0.02);
}

// All plates under a body count as touched, also those whose points were left to their neighbours.
TEST_P(NoSeamTest, EveryPlateUnderABodyIsTouched) {
  auto world = make_world(settings_for(GetParam()));
  for (int i = -2; i <= 2; ++i) add(*world, box_body(0.3 * i, -1, 0.3, 2, BodyType::kStatic));
  add(*world, box_body(0, 0.51, 1.4, 1));
  std::size_t begun = 0, ended = 0;
  for (int i = 0; i < 120; ++i) {
    world->step();
    for (const ContactEvent& event : world->contact_events())
      ++(event.kind == ContactEvent::Kind::kBegin ? begun : ended);
  }
  EXPECT_EQ(begun, 5u);
  EXPECT_EQ(ended, 0u);
}

// A world that was saved while its bodies lay on seams goes on as if nothing had been.
TEST_P(NoSeamTest, SavedOnASeamItGoesOnBitForBit) {
  auto world = make_world(settings_for(GetParam())), twin = make_world(settings_for(GetParam()));
  add_floor(*world, Floor::kPlates, 0.3, 20);
  for (int i = 0; i < 4; ++i) {
    BodyDef def = i % 2 == 0 ? box_body(1.37 + 2 * i, 0.5) : ball_body(1.37 + 2 * i, 0.5);
    def.velocity = {1.7, 0};
    def.shapes[0].material.friction = 0;
    add(*world, def);
  }
  for (int i = 0; i < 60; ++i) {
    world->step();
    ASSERT_TRUE(twin->restore(world->save()));
    ASSERT_EQ(twin->state_hash(), world->state_hash());
    world->step();
    twin->step();
    ASSERT_EQ(twin->state_hash(), world->state_hash()) << "after step " << i;
  }
}

}  // namespace
}  // namespace urto

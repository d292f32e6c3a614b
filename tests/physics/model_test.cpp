#include "physics/model.h"

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

Feature feature(const World& world, const std::string& name) {
  for (const Feature& f : world.model())
    if (f.name == name) return f;
  ADD_FAILURE() << "no feature " << name;
  return {};
}

BodyDef smooth(BodyDef def) {
  for (ShapeDef& shape : def.shapes) shape.material.friction = 0;
  return def;
}

TEST(ModelTest, FrictionIsOnOnlyWhereTwoShapesHaveIt) {
  auto world = make_world();
  add(*world, smooth(floor_body()));
  add(*world, box_body(0, 1));
  EXPECT_FALSE(feature(*world, "friction").on);  // the geometric mean with 0 is 0
  const BodyId second = add(*world, box_body(3, 1));
  EXPECT_TRUE(feature(*world, "friction").on);
  ASSERT_TRUE(world->remove_body(second));
  EXPECT_FALSE(feature(*world, "friction").on);
}

TEST(ModelTest, RestitutionIsOnWhereOneShapeHasItUnderTheMaximum) {
  auto world = make_world();
  EXPECT_FALSE(feature(*world, "restitution").on);
  BodyDef def = box_body(0, 1);
  def.shapes[0].material.restitution = 0.5;
  add(*world, def);
  EXPECT_TRUE(feature(*world, "restitution").on);
  WorldSettings least;
  least.restitution_mixing = Mixing::kMinimum;
  auto other = make_world(least);
  add(*other, def);
  EXPECT_FALSE(feature(*other, "restitution").on);
}

TEST(ModelTest, BroadPhaseFollowsTheCountUnlessNamed) {
  auto world = make_world();
  add(*world, box_body(0, 0));
  EXPECT_EQ(feature(*world, "broad phase").choice, "brute force");
  for (int i = 0; i < 40; ++i) add(*world, box_body(2 * i, 0));
  EXPECT_EQ(feature(*world, "broad phase").choice, "dynamic BVH");
  WorldSettings named;
  named.broad_phase = BroadPhaseKind::kQuadtree;
  EXPECT_EQ(feature(*make_world(named), "broad phase").choice, "quadtree");
}

// A feature that is left out gives the same bits as one that is on and idle.
TEST(ModelTest, IdleFeaturesDoNotChangeABit) {
  const auto run = [](bool damped_bystander) {
    WorldSettings settings;
    auto world = make_world(settings);
    add(*world, floor_body());
    const std::vector<BodyId> ids = add_pyramid(*world, 5);
    BodyDef far = box_body(500, 0.5);
    if (damped_bystander) far.linear_damping = 1e-3, far.shapes[0].material.restitution = 0.5;
    add(*world, far);
    BodyDef ball = ball_body(-6, 1);
    ball.velocity = {8, 0};
    add(*world, ball);
    step_for(*world, 3);
    std::vector<double> out;
    for (BodyId id : ids) {
      out.push_back(world->body(id)->position.x());
      out.push_back(world->body(id)->position.y());
      out.push_back(world->body(id)->angle);
    }
    return out;
  };
  EXPECT_EQ(run(false), run(true));
}

// Every broad phase gives the same bits: candidate pairs come sorted.
TEST(ModelTest, BroadPhasesGiveTheSameMotion) {
  const auto run = [](BroadPhaseKind kind) {
    WorldSettings settings;
    settings.broad_phase = kind;
    auto world = make_world(settings);
    add(*world, floor_body());
    add_pyramid(*world, 8);
    BodyDef ball = ball_body(-9, 2);
    ball.velocity = {20, 0};
    add(*world, ball);
    step_for(*world, 3);
    BodyColumns columns;
    world->capture(columns, true);
    return std::pair(columns.x, columns.angle);
  };
  const auto brute = run(BroadPhaseKind::kBruteForce);
  EXPECT_EQ(brute, run(BroadPhaseKind::kQuadtree));
  EXPECT_EQ(brute, run(BroadPhaseKind::kBvh));
}

}  // namespace
}  // namespace urto

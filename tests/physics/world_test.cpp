#include "physics/world.h"

#include <limits>

#include "physics/support/scenes.h"

namespace urto {
namespace {

using namespace testing;

class WorldTest : public ::testing::TestWithParam<Precision> {
 protected:
  std::unique_ptr<World> world_ = make_world(settings_for(GetParam()));
};

INSTANTIATE_TEST_SUITE_P(Precisions, WorldTest, ::testing::Values(Precision::kFloat, Precision::kDouble));

TEST_P(WorldTest, RectangleHasTheInertiaOfTheThesis) {
  BodyDef def = box_body(1, 2, 3, 4);
  def.shapes[0].material.density = 2;
  const BodyId id = add(*world_, def);
  const MassProperties mass = *world_->mass_properties(id);
  EXPECT_DOUBLE_EQ(mass.mass, 24);
  EXPECT_DOUBLE_EQ(mass.inertia, 24.0 * (9 + 16) / 12);  // m (w² + h²) / 12
}

TEST_P(WorldTest, CompoundBodyTurnsAboutItsCentreOfMass) {
  BodyDef def;
  def.shapes.push_back({Box{1, 1, {-1, 0}, 0}, {}, {}, false});
  def.shapes.push_back({Box{1, 1, {2, 0}, 0}, {}, {}, false});
  const MassProperties mass = *world_->mass_properties(add(*world_, def));
  EXPECT_DOUBLE_EQ(mass.mass, 2);
  EXPECT_DOUBLE_EQ(mass.center_of_mass.x(), 0.5);
  EXPECT_NEAR(mass.inertia, 2 * (1.0 / 6) + 2 * 2.25, 1e-6);  // each about its own centre, and 1.5 m off
}

TEST_P(WorldTest, ConcavePolygonBecomesOneBodyWithItsArea) {
  BodyDef def;
  def.shapes.push_back({Polygon{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}, {}, {}, false});  // an L
  const BodyId id = add(*world_, def);
  EXPECT_NEAR(world_->mass_properties(id)->mass, 3, 1e-6);
  EXPECT_EQ(world_->query_point({1.5, 1.5})->size(), 0u);  // the notch
  EXPECT_EQ(world_->query_point({1.5, 0.5})->size(), 1u);
  EXPECT_EQ(world_->query_point({0.5, 1.5})->size(), 1u);
}

TEST_P(WorldTest, ImpulseChangesVelocityByHand) {
  WorldSettings settings = settings_for(GetParam());
  settings.gravity = {0, 0};
  auto world = make_world(settings);
  const BodyId id = add(*world, box_body(0, 0, 2, 1));  // m = 2, I = 2 · 5 / 12
  ASSERT_TRUE(world->apply_impulse(id, {4, 0}, {0, 0.5}));
  const BodyState state = *world->body(id);
  EXPECT_DOUBLE_EQ(state.velocity.x(), 2);
  EXPECT_NEAR(state.angular_velocity, -0.5 * 4 / (10.0 / 12), 1e-6);  // r × p / I
  world->step();
  EXPECT_NEAR(world->body(id)->position.x(), 2.0 / 60, 1e-7);
}

TEST_P(WorldTest, ForceActsUntilSetAnew) {
  WorldSettings settings = settings_for(GetParam());
  settings.gravity = {0, 0};
  auto world = make_world(settings);
  const BodyId id = add(*world, box_body(0, 0));
  ASSERT_TRUE(world->set_force(id, {6, 0}, 0, false));
  step_for(*world, 1);
  EXPECT_NEAR(world->body(id)->velocity.x(), 6, 1e-4);
  ASSERT_TRUE(world->set_force(id, {0, 0}, 0, false));
  step_for(*world, 1);
  EXPECT_NEAR(world->body(id)->velocity.x(), 6, 1e-4);
}

TEST_P(WorldTest, ForceInTheBodysFrameTurnsWithIt) {
  WorldSettings settings = settings_for(GetParam());
  settings.gravity = {0, 0};
  auto world = make_world(settings);
  BodyDef def = box_body(0, 0);
  def.angle = 1.5707963267948966;
  const BodyId id = add(*world, def);
  ASSERT_TRUE(world->set_force(id, {6, 0}, 0, true));
  step_for(*world, 0.5);
  EXPECT_NEAR(world->body(id)->velocity.x(), 0, 1e-5);
  EXPECT_NEAR(world->body(id)->velocity.y(), 3, 1e-4);
}

TEST_P(WorldTest, KinematicBodyMovesAsToldAndIsPushedByNothing) {
  BodyDef def = box_body(0, 0, 4, 1, BodyType::kKinematic);
  def.velocity = {1, 0};
  const BodyId platform = add(*world_, def);
  add(*world_, box_body(0, 1));
  step_for(*world_, 1);
  EXPECT_NEAR(world_->body(platform)->position.x(), 1, 1e-5);
  EXPECT_NEAR(world_->body(platform)->position.y(), 0, 1e-7);
  EXPECT_EQ(world_->apply_impulse_to_center(platform, {1, 0}).error().code, ErrorCode::kWrongBodyType);
}

TEST_P(WorldTest, CarriesABodyOnAMovingPlatform) {
  BodyDef def = box_body(0, 0, 40, 1, BodyType::kKinematic);
  def.velocity = {2, 0};
  add(*world_, def);
  const BodyId rider = add(*world_, box_body(0, 1));
  step_for(*world_, 3);
  EXPECT_NEAR(world_->body(rider)->velocity.x(), 2, 1e-2);
}

TEST_P(WorldTest, IdsAreNotGivenOutAgain) {
  const BodyId first = add(*world_, box_body(0, 0));
  ASSERT_TRUE(world_->remove_body(first));
  const BodyId second = add(*world_, box_body(0, 0));
  EXPECT_NE(first, second);
  EXPECT_FALSE(world_->contains(first));
  EXPECT_TRUE(world_->contains(second));
  EXPECT_EQ(world_->body(first).error().code, ErrorCode::kUnknownBody);
}

TEST_P(WorldTest, CaptureIsAscendingAndLeavesStaticBodiesOutUnlessAsked) {
  const BodyId a = add(*world_, box_body(0, 0));
  add(*world_, floor_body());
  const BodyId c = add(*world_, box_body(5, 0));
  ASSERT_TRUE(world_->remove_body(a));
  const BodyId d = add(*world_, box_body(9, 0));  // takes a's slot with a higher id
  BodyColumns columns;
  world_->capture(columns, false);
  EXPECT_EQ(columns.id, (std::vector<BodyId>{c, d}));
  EXPECT_DOUBLE_EQ(columns.x[1], 9);
  world_->capture(columns, true);
  EXPECT_EQ(columns.id.size(), 3u);
}

TEST_P(WorldTest, FiltersKeepShapesApart) {
  BodyDef ghost = box_body(0, 3);
  ghost.shapes[0].filter.mask = 2;
  add(*world_, floor_body());
  const BodyId falling = add(*world_, ghost);
  step_for(*world_, 2);
  EXPECT_LT(world_->body(falling)->position.y(), -5);
}

TEST_P(WorldTest, SensorReportsAndPushesNothing) {
  BodyDef coin = box_body(0, 0, 1, 1, BodyType::kStatic);
  coin.shapes[0].sensor = true;
  add(*world_, coin);
  const BodyId ball = add(*world_, ball_body(0, 3, 0.2));
  int begins = 0, ends = 0;
  for (int i = 0; i < 120; ++i) {
    world_->step();
    for (const ContactEvent& e : world_->contact_events()) {
      EXPECT_TRUE(e.sensor);
      (e.kind == ContactEvent::Kind::kBegin ? begins : ends)++;
    }
  }
  EXPECT_EQ(begins, 1);
  EXPECT_EQ(ends, 1);
  EXPECT_NEAR(world_->body(ball)->velocity.y(), -2 * 9.81, 1e-2);
}

TEST_P(WorldTest, ContactEventsComeInPairsWithPointAndSpeed) {
  add(*world_, floor_body());
  BodyDef def = ball_body(0, 2);
  def.shapes[0].material.restitution = 0.8;
  const BodyId ball = add(*world_, def);
  int begins = 0, ends = 0;
  for (int i = 0; i < 120; ++i) {
    world_->step();
    for (const ContactEvent& e : world_->contact_events()) {
      if (e.kind == ContactEvent::Kind::kEnd) {
        ++ends;
        continue;
      }
      if (begins++ > 0) continue;
      EXPECT_NEAR(e.point.y(), 0, 0.1);
      EXPECT_NEAR(e.approach_speed, std::sqrt(2 * 9.81 * 1.5), 0.4);
      EXPECT_NEAR(std::abs(e.normal.y()), 1, 1e-6);
    }
  }
  EXPECT_GE(begins, 2);
  EXPECT_LE(begins - ends, 1);
  EXPECT_GE(begins, ends);
  EXPECT_TRUE(world_->contains(ball));
}

TEST_P(WorldTest, RemovingABodyEndsItsContacts) {
  add(*world_, floor_body());
  const BodyId id = add(*world_, box_body(0, 0.5));
  step_for(*world_, 1);
  ASSERT_TRUE(world_->remove_body(id));
  world_->step();
  ASSERT_EQ(world_->contact_events().size(), 1u);
  EXPECT_EQ(world_->contact_events()[0].kind, ContactEvent::Kind::kEnd);
  EXPECT_TRUE(world_->contact_events()[0].body_a == id || world_->contact_events()[0].body_b == id);
  world_->step();
  EXPECT_TRUE(world_->contact_events().empty());
}

TEST_P(WorldTest, RemovingASupportWakesAndDropsWhatLay) {
  add(*world_, floor_body());
  const BodyId lower = add(*world_, box_body(0, 0.5));
  const BodyId upper = add(*world_, box_body(0, 1.5));
  step_for(*world_, 3);
  ASSERT_FALSE(world_->body(upper)->awake);
  ASSERT_TRUE(world_->remove_body(lower));
  EXPECT_TRUE(world_->body(upper)->awake);
  step_for(*world_, 2);
  EXPECT_NEAR(world_->body(upper)->position.y(), 0.5, 0.01);
}

TEST_P(WorldTest, ExtremePushesSaturateAndStayNumbers) {
  add(*world_, floor_body());
  const BodyId id = add(*world_, box_body(0, 2, 0.1, 0.1)), other = add(*world_, box_body(1, 2, 0.1, 0.1));
  ASSERT_TRUE(world_->apply_impulse(id, {1e15, 1e15}, {1e6, -1e6}));
  ASSERT_TRUE(world_->apply_angular_impulse(other, 1e15));
  EXPECT_EQ(world_->body(id)->velocity.x(), 1e6);
  EXPECT_EQ(world_->body(other)->angular_velocity, 1e6);
  ASSERT_TRUE(world_->set_force(other, {1e15, -1e15}, 1e15, false));
  for (int i = 0; i < 120; ++i) {
    world_->step();
    for (const BodyId body : {id, other}) {
      const BodyState state = *world_->body(body);
      ASSERT_TRUE(std::isfinite(state.position.x() + state.position.y() + state.angle + state.angular_velocity)) << i;
      ASSERT_LE(state.velocity.cwiseAbs().maxCoeff(), 1e6);
    }
  }
}

// Bad input -----------------------------------------------------------------------------------------------------

TEST_P(WorldTest, BadInputIsATypedErrorAndTheWorldIsUnchanged) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  add(*world_, floor_body());
  const BodyId id = add(*world_, box_body(0, 3));
  const BodyId floor = 1;
  world_->step();
  const std::uint64_t before = world_->state_hash();

  const auto refused_body = [&](auto change, ErrorCode code, const std::string& field) {
    BodyDef def = box_body(0, 5);
    change(def);
    const auto result = world_->add_body(def);
    ASSERT_FALSE(result.has_value()) << field;
    EXPECT_EQ(result.error().code, code) << field;
    EXPECT_EQ(result.error().field, field);
    EXPECT_FALSE(result.error().message.empty());
  };
  refused_body([&](BodyDef& d) { d.position.x() = kNan; }, ErrorCode::kInvalidValue, "position.x");
  refused_body([&](BodyDef& d) { d.position.y() = kInf; }, ErrorCode::kInvalidValue, "position.y");
  refused_body([&](BodyDef& d) { d.angle = kNan; }, ErrorCode::kInvalidValue, "angle");
  refused_body([&](BodyDef& d) { d.velocity.x() = 1e300; }, ErrorCode::kInvalidValue, "velocity.x");
  refused_body([&](BodyDef& d) { d.mass = 0; }, ErrorCode::kInvalidValue, "mass");
  refused_body([&](BodyDef& d) { d.mass = -1; }, ErrorCode::kInvalidValue, "mass");
  refused_body([&](BodyDef& d) { d.shapes.clear(); }, ErrorCode::kInvalidValue, "shapes");
  refused_body([&](BodyDef& d) { d.shapes.resize(65, d.shapes[0]); }, ErrorCode::kLimitReached, "shapes");
  refused_body([&](BodyDef& d) { d.shapes[0].sensor = true; }, ErrorCode::kInvalidValue, "shapes");
  refused_body([&](BodyDef& d) { d.shapes[0].material.density = 0; }, ErrorCode::kInvalidValue, "shapes[0].density");
  refused_body([&](BodyDef& d) { d.shapes[0].material.restitution = 1.5; }, ErrorCode::kInvalidValue,
               "shapes[0].restitution");
  refused_body([&](BodyDef& d) { d.shapes[0].material.friction = -0.1; }, ErrorCode::kInvalidValue,
               "shapes[0].friction");
  refused_body([&](BodyDef& d) { std::get<Box>(d.shapes[0].geometry).width = 0; }, ErrorCode::kInvalidValue,
               "shapes[0].box.width");
  refused_body(
      [&](BodyDef& d) {
        d.shapes[0].geometry = Circle{-1, {0, 0}};
      },
      ErrorCode::kInvalidValue, "shapes[0].circle.radius");
  refused_body(
      [&](BodyDef& d) {
        d.shapes[0].geometry = Polygon{{{0, 0}, {1, 0}}};
      },
      ErrorCode::kInvalidValue, "shapes[0].polygon.vertices");
  refused_body(
      [&](BodyDef& d) {
        d.shapes[0].geometry = Polygon{{{0, 0}, {1, 0}, {2, 0}}};
      },
      ErrorCode::kDegenerateShape, "shapes[0].polygon.vertices[2]");
  refused_body(
      [&](BodyDef& d) {
        d.type = BodyType::kStatic, d.velocity = {1, 0};
      },
      ErrorCode::kInvalidValue, "velocity");

  EXPECT_EQ(world_->apply_impulse(id, {kNan, 0}, {0, 0}).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(world_->apply_impulse(id, {0, 0}, {kInf, 0}).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(world_->apply_impulse_to_center(floor, {1, 0}).error().code, ErrorCode::kWrongBodyType);
  EXPECT_EQ(world_->apply_angular_impulse(99, 1).error().code, ErrorCode::kUnknownBody);
  EXPECT_EQ(world_->set_force(id, {0, kNan}, 0, false).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(world_->set_velocity(floor, {1, 0}, 0).error().code, ErrorCode::kWrongBodyType);
  EXPECT_EQ(world_->set_velocity(id, {1, 0}, kNan).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(world_->set_transform(id, {kNan, 0}, 0).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(world_->remove_body(0).error().code, ErrorCode::kUnknownBody);
  EXPECT_EQ(world_->query_ray({0, 0}, {kNan, 0}).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(world_->query_aabb({1, 0}, {0, 1}).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(world_->query_nearest({0, 0}, -1, 1).error().code, ErrorCode::kInvalidValue);

  EXPECT_EQ(world_->state_hash(), before);
}

TEST(WorldSettingsTest, OutOfRangeSettingsAreRefused) {
  const auto refused = [](auto change, const std::string& field) {
    WorldSettings settings;
    change(settings);
    const auto world = World::create(settings);
    ASSERT_FALSE(world.has_value()) << field;
    EXPECT_EQ(world.error().field, field);
  };
  refused([](WorldSettings& s) { s.time_step = 0; }, "time_step");
  refused([](WorldSettings& s) { s.time_step = 1; }, "time_step");
  refused([](WorldSettings& s) { s.sub_steps = 0; }, "sub_steps");
  refused([](WorldSettings& s) { s.sub_steps = 65; }, "sub_steps");
  refused([](WorldSettings& s) { s.gravity.y() = std::numeric_limits<double>::quiet_NaN(); }, "gravity.y");
  refused([](WorldSettings& s) { s.fields.push_back(Drag{-1, 0}); }, "fields[0].drag.linear");
}

TEST_P(WorldTest, RoundedShapesHaveTheirMassAndAreFoundWhereTheyAre) {
  const double pi = 3.14159265358979323846;
  const BodyId capsule = add(*world_, body_with({Capsule{{-1, 0}, {1, 0}, 0.5}, {}, {}, false}, {0, 0}));
  EXPECT_NEAR(world_->mass_properties(capsule)->mass, 2 + pi / 4, 1e-6);
  EXPECT_EQ(world_->query_point({1.4, 0})->size(), 1u);
  EXPECT_EQ(world_->query_point({1.4, 0.4})->size(), 0u);
  const auto hits = *world_->query_ray({5, 0}, {-10, 0});
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(hits[0].point.x(), 1.5, 1e-6);
  const BodyId box = add(*world_, body_with({Box{2, 1, {0, 0}, 0, 0.5}, {}, {}, false}, {10, 0}));
  EXPECT_NEAR(world_->mass_properties(box)->mass, 2 + 2 * (2 + 1) * 0.5 + pi / 4, 1e-5);
  EXPECT_EQ(world_->query_point({11.45, 0})->size(), 1u);
  EXPECT_EQ(world_->query_point({11.45, 0.95})->size(), 0u);
  EXPECT_EQ(world_->query_aabb({11.4, 0.9}, {12, 2})->size(), 1u);  // by its bounds, radius included
}

TEST_P(WorldTest, RefusesRoundedShapesThatAreNone) {
  const auto refusal = [&](Geometry geometry, BodyType type = BodyType::kDynamic) {
    const auto id = world_->add_body(body_with({std::move(geometry), {}, {}, false}, {0, 0}, type));
    return id ? std::string("accepted") : id.error().field;
  };
  EXPECT_EQ(refusal(Box{1, 1, {0, 0}, 0, -0.1}), "shapes[0].box.radius");
  EXPECT_EQ(refusal(Capsule{{0, 0}, {0, 0}, 1}), "shapes[0].capsule.b");
  EXPECT_EQ(refusal(Capsule{{0, 0}, {1, 0}, 0}), "shapes[0].capsule.radius");
  EXPECT_EQ(refusal(Polygon{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0.1}), "shapes[0].polygon.radius");
  EXPECT_EQ(refusal(Polygon{{{0, 0}, {2, 0}, {0, 2}}, 0.1}), "accepted");
  EXPECT_EQ(refusal(Chain{{{1, 0}, {0, 0}}, false}), "shapes");  // a dynamic body can have none
  EXPECT_EQ(refusal(Chain{{{1, 0}, {0, 0}}, false}, BodyType::kStatic), "accepted");
  EXPECT_EQ(refusal(Chain{{{1, 0}, {0, 0}}, true}, BodyType::kKinematic), "shapes[0].chain.vertices");
}

TEST_P(WorldTest, RoundShapesComeToRestOnAChainAndNotBelow) {
  Chain chain;
  for (int i = 20; i >= -20; --i) chain.vertices.push_back({0.5 * i, 0.02 * i * i});
  add(*world_, body_with({chain, {}, {}, false}, {0, 0}, BodyType::kStatic));
  std::vector<BodyId> ids;
  for (int i = 0; i < 12; ++i) {
    const Geometry shapes[] = {Capsule{{-0.3, 0}, {0.3, 0}, 0.2}, Box{0.4, 0.2, {0, 0}, 0, 0.1}, Circle{0.3, {0, 0}},
                               Polygon{{{-0.3, -0.2}, {0.3, -0.2}, {0, 0.3}}, 0.1}};
    ids.push_back(add(*world_, body_with({shapes[i % 4], {}, {}, false}, {0.6 * (i - 6), 4 + 0.5 * (i % 3)})));
  }
  step_for(*world_, 20);
  for (BodyId id : ids) {
    const BodyState state = *world_->body(id);
    EXPECT_FALSE(state.awake);
    EXPECT_GT(state.position.y(), 0.08 * state.position.x() * state.position.x());  // above the parabola of the chain
  }
  EXPECT_LT(world_->counters().penetration_max, 0.005);
}

}  // namespace
}  // namespace urto

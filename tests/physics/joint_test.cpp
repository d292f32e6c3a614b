#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "physics/support/joints.h"
#include "physics/world_of.h"

namespace urto {
namespace {

using namespace testing;

constexpr double kPi = 3.14159265358979323846;
constexpr double kStep = 1.0 / 60;

class JointTest : public ::testing::TestWithParam<Precision> {
 protected:
  JointTest() {
    settings_.precision = GetParam();
    settings_.gravity = {0, -10};
    settings_.sleeping = false;
  }
  World& world() {
    if (!world_) world_ = make_world(settings_);
    return *world_;
  }
  World& weightless() {
    settings_.gravity = {0, 0};
    return world();
  }
  ErrorCode code_of(const JointDef& def) {
    const Expected<JointId> id = world().add_joint(def);
    return id ? ErrorCode::kCorruptState : id.error().code;
  }
  WorldSettings settings_;
  std::unique_ptr<World> world_;
};

INSTANTIATE_TEST_SUITE_P(Precisions, JointTest, ::testing::Values(Precision::kFloat, Precision::kDouble));

// A revolute joint -----------------------------------------------------------------------------------------------

TEST_P(JointTest, PendulumSwingsWithItsPeriod) {
  // A disc of radius r on an arm L: I = m (r²/2 + L²), T = 2π √(I / (m g L)) (1 + θ²/16).
  const double r = 0.5, arm = 2, amplitude = 0.05;
  const double period = 2 * kPi * std::sqrt((r * r / 2 + arm * arm) / (10 * arm)) * (1 + amplitude * amplitude / 16);
  BodyDef def = ball_body(arm * std::sin(amplitude), -arm * std::cos(amplitude), r);
  def.angle = amplitude;
  const BodyId bob = add(world(), def);
  join(world(), joint_between(add_post(world()), bob, {0, 0}, {0, arm}, RevoluteJoint{}));
  double before = amplitude, crossing = 0;
  int crossings = 0;
  for (int i = 1; crossings < 10; ++i) {
    ASSERT_LT(i, 6000);
    world().step();
    const double now = world().body(bob)->angle;
    if ((before > 0) != (now > 0)) {
      ++crossings;
      crossing = (i - now / (now - before)) * kStep;
    }
    before = now;
  }
  // The tenth crossing comes after 4.75 periods. The sub-step advances semi-implicitly: (ωh)²/24 of the period, 1e-6.
  EXPECT_NEAR(crossing / 4.75, period, 1e-3 * period);
}

TEST_P(JointTest, ReactionIsTheWeightThatHangsFromIt) {
  const BodyId box = add(world(), box_body(0, -1));  // 1 kg
  const JointId id = join(world(), joint_between(add_post(world()), box, {0, 0}, {0, 1}, RevoluteJoint{}));
  step_for(world(), 2);
  const JointState state = *world().joint(id);
  EXPECT_NEAR(state.force.x(), 0, 1e-3);
  EXPECT_NEAR(state.force.y(), 10, 1e-3);
  EXPECT_NEAR(state.torque, 0, 1e-6);
  EXPECT_LT((state.point_b - state.point_a).norm(), 2e-4);
}

TEST_P(JointTest, MotorReachesItsSpeedWithItsTorque) {
  World& world = weightless();
  const BodyId wheel = add(world, ball_body(0, 0, 0.5));
  RevoluteJoint revolute;
  revolute.motor = JointMotor{true, 10, 0.25};
  const JointId id = join(world, joint_between(add_post(world), wheel, {0, 0}, {0, 0}, revolute));
  const double inertia = world.mass_properties(wheel)->inertia;
  const int steps = 12;
  for (int i = 0; i < steps; ++i) world.step();
  EXPECT_NEAR(world.body(wheel)->angular_velocity, 0.25 * steps * kStep / inertia, 1e-4);  // τ t / I
  EXPECT_NEAR(world.joint(id)->torque, 0.25, 1e-4);
  step_for(world, 4);
  EXPECT_NEAR(world.joint(id)->speed, 10, 1e-4);
  EXPECT_NEAR(world.joint(id)->torque, 0, 1e-4);
  ASSERT_TRUE(world.set_motor(id, {true, -3, 100}));
  step_for(world, 1);
  EXPECT_NEAR(world.joint(id)->speed, -3, 1e-4);
  ASSERT_TRUE(world.set_motor(id, {false, 5, 100}));
  step_for(world, 1);
  EXPECT_NEAR(world.joint(id)->speed, -3, 1e-4);  // it coasts
}

TEST_P(JointTest, LimitsCountWholeTurns) {
  World& world = weightless();
  const BodyId wheel = add(world, ball_body(0, 0, 0.5));
  RevoluteJoint revolute;
  revolute.motor = JointMotor{true, 5, 1};
  revolute.limits = JointLimits{-1, 15};  // more than two turns
  const JointId id = join(world, joint_between(add_post(world), wheel, {0, 0}, {0, 0}, revolute));
  step_for(world, 6);
  EXPECT_NEAR(world.joint(id)->position, 15, 2e-3);
  EXPECT_NEAR(world.joint(id)->speed, 0, 1e-3);
  ASSERT_TRUE(world.set_motor(id, {true, -5, 1}));
  step_for(world, 6);
  EXPECT_NEAR(world.joint(id)->position, -1, 2e-3);
}

TEST_P(JointTest, SpringTurnsBackToTheReference) {
  World& world = weightless();
  const BodyId wheel = add(world, ball_body(0, 0, 0.5));
  RevoluteJoint revolute;
  revolute.reference_angle = 0.5;
  revolute.spring = JointSpring{2, 1};
  const JointId id = join(world, joint_between(add_post(world), wheel, {0, 0}, {0, 0}, revolute));
  EXPECT_NEAR(world.joint(id)->position, -0.5, 1e-6);
  step_for(world, 3);
  EXPECT_NEAR(world.body(wheel)->angle, 0.5, 1e-5);
}

// A distance joint -----------------------------------------------------------------------------------------------

TEST_P(JointTest, RodKeepsItsLength) {
  const BodyId ball = add(world(), ball_body(3, 0));
  const JointId id = join(world(), joint_between(add_post(world()), ball, {0, 0}, {0, 0}, DistanceJoint{}));
  for (int i = 0; i < 600; ++i) {
    world().step();
    ASSERT_NEAR(world().joint(id)->position, 3, 2e-3);
  }
}

TEST_P(JointTest, RopeIsSlackUntilItIsTaut) {
  DistanceJoint rope;
  rope.limits = JointLimits{0, 3};
  const BodyId ball = add(world(), ball_body(0, -1));
  const JointId id = join(world(), joint_between(add_post(world()), ball, {0, 0}, {0, 0}, rope));
  step_for(world(), 0.5);
  EXPECT_EQ(world().joint(id)->force, Vec2(0, 0));
  // Free fall from rest, semi-implicitly: g h² n (n + 1) / 2 in sub-steps of h.
  const double h = kStep / 4, n = 120;
  EXPECT_NEAR(world().body(ball)->position.y(), -1 - 10 * h * h * n * (n + 1) / 2, 1e-4);
  step_for(world(), 3);
  EXPECT_NEAR(world().joint(id)->position, 3, 1e-3);
  EXPECT_NEAR(world().joint(id)->force.y(), 10 * world().mass_properties(ball)->mass, 0.05);
}

// x = x₀ cos ωt: frequency within (ωh)²/24, and the amplitude is kept: no damping of the integrator's own.
TEST_P(JointTest, SpringSwingsWithItsFrequencyAndKeepsItsEnergy) {
  World& world = weightless();
  DistanceJoint spring;
  spring.length = 2;
  spring.spring = JointSpring{1, 0};
  const BodyId ball = add(world, ball_body(2.5, 0));
  const JointId id = join(world, joint_between(add_post(world), ball, {0, 0}, {0, 0}, spring));
  double most = 0;
  for (int i = 1; i <= 600; ++i) {
    world.step();
    const double x = world.joint(id)->position - 2;
    EXPECT_NEAR(x, 0.5 * std::cos(2 * kPi * i * kStep), 0.5 * (2 * kPi * kStep / 4 + 0.01)) << i;
    if (i > 540) most = std::max(most, x);
  }
  EXPECT_NEAR(most, 0.5, 2e-3);
}

TEST_P(JointTest, SpringSagsByGravityOverOmegaSquared) {
  DistanceJoint spring;
  spring.length = 1;
  spring.spring = JointSpring{2, 0.5};
  const BodyId ball = add(world(), ball_body(0, -1));
  const JointId id = join(world(), joint_between(add_post(world()), ball, {0, 0}, {0, 0}, spring));
  step_for(world(), 10);
  EXPECT_NEAR(world().joint(id)->position, 1 + 10 / (4 * kPi * 4 * kPi), 1e-4);
}

TEST_P(JointTest, DampedSpringLosesWhatItsRatioSays) {
  World& world = weightless();
  DistanceJoint spring;
  spring.length = 2;
  spring.spring = JointSpring{1, 0.1};
  const BodyId ball = add(world, ball_body(3, 0));
  const JointId id = join(world, joint_between(add_post(world), ball, {0, 0}, {0, 0}, spring));
  double peak = 0;
  for (int i = 1; i <= 630; ++i) {
    world.step();
    if (i > 570) peak = std::max(peak, world.joint(id)->position - 2);
  }
  // The tenth peak: e^(−ζωt) at t = 10 / √(1 − ζ²).
  const double expected = std::exp(-0.1 * 2 * kPi * 10 / std::sqrt(1 - 0.01));
  EXPECT_NEAR(peak, expected, 0.03 * expected);
}

// A prismatic joint ----------------------------------------------------------------------------------------------

TEST_P(JointTest, SliderFallsAlongItsAxis) {
  PrismaticJoint slider;
  slider.axis = {3, -4};  // of any length: unit (0.6, −0.8)
  const BodyId box = add(world(), box_body(0, 0));
  const JointId id = join(world(), joint_between(add_post(world()), box, {0, 0}, {0.2, 0}, slider));
  const double start = world().joint(id)->position;
  step_for(world(), 1);
  const JointState state = *world().joint(id);
  EXPECT_NEAR(state.speed, 8, 1e-3);  // g · 0.8
  EXPECT_NEAR(state.position - start, 4, 0.03);
  EXPECT_NEAR(world().body(box)->angle, 0, 1e-3);
  const Vec2 way = state.point_b - state.point_a;
  EXPECT_NEAR(way.x() * 0.8 + way.y() * 0.6, 0, 1e-3);  // it was drawn onto the axis
}

TEST_P(JointTest, LiftHoldsItsLoadAndStopsAtItsLimit) {
  PrismaticJoint lift;
  lift.axis = {0, 1};
  lift.limits = JointLimits{0, 2};
  lift.motor = JointMotor{true, 1, 15};  // the load weighs 10 N
  const BodyId box = add(world(), box_body(0, 0));
  const JointId id = join(world(), joint_between(add_post(world()), box, {0, 0}, {0, 0}, lift));
  step_for(world(), 1);
  EXPECT_NEAR(world().joint(id)->speed, 1, 1e-3);
  EXPECT_NEAR(world().joint(id)->force.y(), 10, 1e-2);
  step_for(world(), 4);
  EXPECT_NEAR(world().joint(id)->position, 2, 1e-3);
  ASSERT_TRUE(world().set_motor(id, {true, 1, 5}));  // too weak
  step_for(world(), 4);
  EXPECT_NEAR(world().joint(id)->position, 0, 1e-3);
}

// A weld ---------------------------------------------------------------------------------------------------------

TEST_P(JointTest, CantileverCarriesForceAndTorque) {
  const BodyId beam = add(world(), box_body(1, 0, 2, 0.2));  // 0.4 kg, its centre 1 m out
  const JointId id = join(world(), joint_between(add_post(world()), beam, {0, 0}, {-1, 0}, WeldJoint{}));
  step_for(world(), 3);
  const JointState state = *world().joint(id);
  EXPECT_NEAR(state.force.y(), 4, 1e-3);
  EXPECT_NEAR(state.torque, 4, 1e-3);
  EXPECT_NEAR(state.position, 0, 2e-3);
  EXPECT_LT((state.point_b - state.point_a).norm(), 1e-3);
}

TEST_P(JointTest, SoftWeldBendsByItsSpring) {
  WeldJoint weld;
  weld.angular = JointSpring{3, 1};
  const BodyId beam = add(world(), box_body(1, 0, 2, 0.2));
  const JointId id = join(world(), joint_between(add_post(world()), beam, {0, 0}, {-1, 0}, weld));
  step_for(world(), 5);
  // The spring's stiffness is I ω² with I of the beam about its own centre, as the joint's mass sees it.
  const double stiffness = world().mass_properties(beam)->inertia * (6 * kPi) * (6 * kPi);
  const double bent = world().joint(id)->position;
  EXPECT_NEAR(stiffness * bent, -4 * std::cos(bent), 0.02);
}

// A mouse joint --------------------------------------------------------------------------------------------------

TEST_P(JointTest, DragBringsThePointToTheTarget) {
  World& world = weightless();
  BodyDef free_box = box_body(0, 0);
  free_box.angular_damping = 3;  // or it would turn about the point for ever
  const BodyId box = add(world, free_box);
  MouseJoint mouse;
  mouse.target = {2, 1};
  mouse.force_max = 100;
  JointDef def = joint_between(0, box, {0, 0}, {0.3, 0.3}, mouse);
  const JointId id = join(world, def);
  ASSERT_TRUE(world.set_velocity(box, {0, 0}, 0));
  step_for(world, 5);
  EXPECT_NEAR(world.joint(id)->position, 0, 1e-3);
  ASSERT_TRUE(world.set_target(id, {-3, 0}));
  EXPECT_GT(world.joint(id)->position, 3);
  step_for(world, 5);
  EXPECT_NEAR(world.joint(id)->position, 0, 1e-3);
}

TEST_P(JointTest, DragIsNoStrongerThanItsForce) {
  const BodyId box = add(world(), box_body(0, 0));  // 10 N
  MouseJoint mouse;
  mouse.target = {0, 5};
  mouse.force_max = 4;
  const JointId id = join(world(), joint_between(0, box, {0, 0}, {0, 0}, mouse));
  step_for(world(), 1);
  EXPECT_NEAR(world().joint(id)->force.norm(), 4, 1e-3);
  EXPECT_NEAR(world().body(box)->velocity.y(), -6, 1e-3);
}

// All of them ----------------------------------------------------------------------------------------------------

TEST_P(JointTest, MomentumIsKept) {
  World& world = weightless();
  const auto add_apart = [&](BodyDef def) {  // so that joints alone act
    def.shapes[0].filter = {2, ~2u};
    return add(world, def);
  };
  const BodyId first = add_apart(ball_body(0, 0, 0.4));
  const Links chain = add_links(world, first, 8, 0.3);
  const BodyId rod = add_apart(ball_body(0, 2)), slider = add_apart(box_body(-2, 0)),
               welded = add_apart(box_body(-2, 2));
  join(world, joint_between(first, rod, {0, 0}, {0.1, 0}, DistanceJoint{}));
  join(world, joint_between(first, slider, {0, 0}, {0.5, 0.2}, PrismaticJoint{}));
  join(world, joint_between(slider, welded, {0, 1}, {0, -1}, WeldJoint{}));
  ASSERT_TRUE(world.set_velocity(first, {1, 2}, 5));
  ASSERT_TRUE(world.set_velocity(chain.links.back(), {-3, 4}, 9));
  const Energy before = world.energy();
  step_for(world, 5);
  const Energy after = world.energy();
  // Rounding alone: 300 steps of 12 joints.
  const double bound = GetParam() == Precision::kDouble ? 1e-11 : 1e-3;
  EXPECT_NEAR(after.momentum.x(), before.momentum.x(), bound);
  EXPECT_NEAR(after.momentum.y(), before.momentum.y(), bound);
  EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 10 * bound);
  EXPECT_LE(after.kinetic, before.kinetic * (1 + 1e-3));
}

TEST_P(JointTest, BreaksUnderMoreThanItCarries) {
  const BodyId post = add_post(world()), box = add(world(), box_body(0, -1));
  JointDef def = joint_between(post, box, {0, 0}, {0, 1}, RevoluteJoint{});
  def.break_force = 15;
  const JointId id = join(world(), def);
  step_for(world(), 1);
  EXPECT_TRUE(world().contains_joint(id));
  EXPECT_TRUE(world().joint_events().empty());
  ASSERT_TRUE(world().set_force(box, {0, -6}, 0, false));  // 16 N in all
  world().step();
  ASSERT_EQ(world().joint_events().size(), 1u);
  const JointEvent event = world().joint_events()[0];
  EXPECT_EQ(event.joint, id);
  EXPECT_EQ(event.body_a, post);
  EXPECT_EQ(event.body_b, box);
  EXPECT_GT(event.force, 15);
  EXPECT_NEAR(event.point.y(), 0, 0.01);
  EXPECT_FALSE(world().contains_joint(id));
  world().step();
  EXPECT_TRUE(world().joint_events().empty());
  step_for(world(), 1);
  EXPECT_LT(world().body(box)->position.y(), -5);
}

TEST_P(JointTest, WeldBreaksByTorque) {
  const BodyId beam = add(world(), box_body(1, 0, 2, 0.2));  // 4 N·m
  JointDef def = joint_between(add_post(world()), beam, {0, 0}, {-1, 0}, WeldJoint{});
  def.break_torque = 5;
  const JointId id = join(world(), def);
  step_for(world(), 1);
  EXPECT_TRUE(world().contains_joint(id));
  ASSERT_TRUE(world().set_force(beam, {0, -2}, 0, false));
  world().step();
  EXPECT_FALSE(world().contains_joint(id));
  ASSERT_EQ(world().joint_events().size(), 1u);
  EXPECT_GT(world().joint_events()[0].torque, 5);
}

TEST_P(JointTest, JoinedBodiesDoNotTouchUnlessAskedTo) {
  World& world = weightless();
  const BodyId a = add(world, box_body(0, 0)), b = add(world, box_body(0.5, 0));
  world.step();
  EXPECT_EQ(world.counters().contacts, 1u);
  JointDef def = joint_between(a, b, {0, 0}, {-0.5, 0}, RevoluteJoint{});
  const JointId id = join(world, def);
  world.step();
  EXPECT_EQ(world.counters().contacts, 0u);
  step_for(world, 0.5);
  EXPECT_EQ(world.counters().contacts, 0u);
  ASSERT_TRUE(world.remove_joint(id));
  world.step();
  EXPECT_EQ(world.counters().contacts, 1u);
  def.collide_connected = true;
  join(world, def);
  world.step();
  EXPECT_EQ(world.counters().contacts, 1u);
}

TEST_P(JointTest, SleepsAndWakesWithWhatItIsJoinedTo) {
  settings_.sleeping = true;
  const Links chain = add_links(world(), add_post(world()), 3, -kPi / 2);
  step_for(world(), 5);
  EXPECT_EQ(world().counters().awake_bodies, 0u);
  ASSERT_TRUE(world().apply_impulse_to_center(chain.links.front(), {0.01, 0}));
  EXPECT_EQ(world().counters().awake_bodies, 3u);
  ASSERT_TRUE(world().set_awake(chain.links.back(), false));
  EXPECT_EQ(world().counters().awake_bodies, 0u);
  ASSERT_TRUE(world().set_motor(chain.joints[1], {true, 0, 1}));
  EXPECT_EQ(world().counters().awake_bodies, 3u);
  step_for(world(), 20);
  EXPECT_EQ(world().counters().awake_bodies, 0u);
  ASSERT_TRUE(world().remove_joint(chain.joints[0]));
  EXPECT_GT(world().counters().awake_bodies, 0u);
}

TEST_P(JointTest, MovingPostKeepsWhatHangsFromItAwake) {
  settings_.sleeping = true;
  const BodyId mover = add(world(), box_body(0, 0, 0.2, 0.2, BodyType::kKinematic));
  const Links chain = add_links(world(), mover, 2, -kPi / 2);
  step_for(world(), 5);
  EXPECT_EQ(world().counters().awake_bodies, 0u);
  ASSERT_TRUE(world().set_velocity(mover, {0.01, 0}, 0));
  EXPECT_EQ(world().counters().awake_bodies, 3u);
  step_for(world(), 5);
  EXPECT_EQ(world().counters().awake_bodies, 3u);
  EXPECT_NEAR(world().body(chain.links.back())->position.x(), 0.05, 0.02);
}

TEST_P(JointTest, GoesWithItsBody) {
  const Links chain = add_links(world(), add_post(world()), 4, 0);
  ASSERT_TRUE(world().remove_body(chain.links[1]));
  EXPECT_EQ(world().joints(), (std::vector<JointId>{chain.joints[0], chain.joints[3]}));
  EXPECT_EQ(world().counters().joints, 2u);
  EXPECT_EQ(world().joint(chain.joints[1]).error().code, ErrorCode::kUnknownJoint);
  step_for(world(), 1);
  const Links more = add_links(world(), chain.links[0], 2, 0);
  for (const JointId id : more.joints) EXPECT_NE(id, chain.joints[1]);  // ids are not given out again
}

TEST_P(JointTest, BadJointsAreRefused) {
  const BodyId a = add_post(world()), b = add(world(), box_body(0, 0)), c = add_post(world(), 1, 1);
  const std::uint64_t before = world().state_hash();
  const JointDef good = joint_between(a, b, {0, 0}, {0, 0}, RevoluteJoint{});
  const auto changed = [&](auto&& change) {
    JointDef def = good;
    change(def);
    return code_of(def);
  };
  EXPECT_EQ(changed([&](JointDef& d) { d.body_a = 99; }), ErrorCode::kUnknownBody);
  EXPECT_EQ(changed([&](JointDef& d) { d.body_b = 0; }), ErrorCode::kUnknownBody);
  EXPECT_EQ(changed([&](JointDef& d) { d.body_a = b; }), ErrorCode::kInvalidValue);
  EXPECT_EQ(changed([&](JointDef& d) { d.body_b = c; }), ErrorCode::kWrongBodyType);
  EXPECT_EQ(changed([&](JointDef& d) { d.anchor_a.x() = std::nan(""); }), ErrorCode::kInvalidValue);
  EXPECT_EQ(changed([&](JointDef& d) { d.break_force = 0; }), ErrorCode::kInvalidValue);
  EXPECT_EQ(changed([&](JointDef& d) { d.break_torque = std::nan(""); }), ErrorCode::kInvalidValue);
  EXPECT_EQ(changed([&](JointDef& d) {
              d.geometry = PrismaticJoint{{0, 0}, {}, {}, {}, {}};
            }),
            ErrorCode::kInvalidValue);
  EXPECT_EQ(changed([&](JointDef& d) { d.geometry = DistanceJoint{-1.0, {}, {}}; }), ErrorCode::kInvalidValue);
  EXPECT_EQ(changed([&](JointDef& d) {
              d.geometry = DistanceJoint{{}, JointLimits{2, 1}, {}};
            }),
            ErrorCode::kInvalidValue);
  EXPECT_EQ(changed([&](JointDef& d) {
              d.geometry = RevoluteJoint{{}, {}, JointMotor{true, 1, -1}, {}};
            }),
            ErrorCode::kInvalidValue);
  EXPECT_EQ(changed([&](JointDef& d) { d.geometry = WeldJoint{{}, JointSpring{0, 1}, {}}; }), ErrorCode::kInvalidValue);
  EXPECT_EQ(changed([&](JointDef& d) { d.geometry = MouseJoint{}; }), ErrorCode::kInvalidValue);  // it has a body a
  EXPECT_EQ(world().state_hash(), before);

  const JointId revolute = join(world(), good);
  EXPECT_EQ(world().set_target(revolute, {0, 0}).error().code, ErrorCode::kWrongJointKind);
  EXPECT_EQ(world().set_motor(revolute, {true, 1, -1}).error().code, ErrorCode::kInvalidValue);
  EXPECT_EQ(world().set_motor(99, {}).error().code, ErrorCode::kUnknownJoint);
  EXPECT_EQ(world().remove_joint(0).error().code, ErrorCode::kUnknownJoint);
  const JointId rod = join(world(), joint_between(a, b, {0, 0}, {0, 0}, DistanceJoint{}));
  EXPECT_EQ(world().set_motor(rod, {}).error().code, ErrorCode::kWrongJointKind);
}

TEST_P(JointTest, ThesisSolverHasNoJoints) {
  settings_.solver = SolverKind::kThesis;
  const BodyId a = add_post(world()), b = add(world(), box_body(0, 0));
  EXPECT_EQ(code_of(joint_between(a, b, {0, 0}, {0, 0}, RevoluteJoint{})), ErrorCode::kNotSupported);
}

// State ----------------------------------------------------------------------------------------------------------

// One joint of every kind, some with all that they can have.
std::vector<JointId> fill_with_joints(World& world) {
  std::vector<JointId> ids;
  const BodyId post = add_post(world, 0, 3);
  ids = add_links(world, post, 6, 0.2).joints;
  std::vector<BodyId> boxes;
  for (int i = 0; i < 6; ++i) boxes.push_back(add(world, box_body(3 * i - 9, 4)));
  RevoluteJoint revolute{0.1, JointLimits{-1, 2}, JointMotor{true, 3, 20}, JointSpring{2, 0.3}};
  ids.push_back(join(world, joint_between(boxes[0], boxes[1], {1, 0}, {-1, 0}, revolute)));
  ids.push_back(
      join(world, joint_between(boxes[1], boxes[2], {0, 0}, {0, 0.2}, DistanceJoint{2.5, {}, JointSpring{3, 0.1}})));
  ids.push_back(join(world, joint_between(boxes[2], boxes[3], {0, 0}, {0, 0},
                                          PrismaticJoint{{1, 0.2}, {}, JointLimits{2, 4}, {}, {}})));
  ids.push_back(
      join(world, joint_between(boxes[3], boxes[4], {1, 0}, {-2, 0}, WeldJoint{{}, {}, JointSpring{4, 0.5}})));
  JointDef mouse = joint_between(0, boxes[5], {0, 0}, {0.4, 0}, MouseJoint{{2, 7}, {3, 0.7}, 60});
  mouse.break_force = 1e3;
  ids.push_back(join(world, mouse));
  EXPECT_TRUE(world.remove_joint(ids[2]));
  return ids;
}

TEST_P(JointTest, SteppingOnAfterRestoreGivesTheSameBits) {
  settings_.sleeping = true;
  add(world(), floor_body());
  fill_with_joints(world());
  step_for(world(), 1);
  auto other = make_world(settings_for(GetParam()));
  ASSERT_TRUE(other->restore(world().save()));
  EXPECT_EQ(other->joints(), world().joints());
  EXPECT_EQ(other->counters().joints, world().counters().joints);
  for (int i = 0; i < 300; ++i) {
    world().step();
    other->step();
    ASSERT_EQ(world().state_hash(), other->state_hash()) << "step " << i;
  }
}

template <class S>
void expect_every_byte_hashed(World& world) {
  auto& data = dynamic_cast<WorldOf<S>&>(world).data();
  const std::uint64_t before = world.state_hash();
  WorldData<S>::for_each_optional_field(data, [&](std::uint32_t, const char* name, auto& field) {
    if (std::string_view(name) == "speed_rests") return;  // of the precise solver, which has no joints
    ASSERT_FALSE(field.empty()) << name;
    auto* bytes = reinterpret_cast<unsigned char*>(field.data());
    for (std::size_t i = 0; i < sizeof field[0]; ++i) {
      bytes[i] ^= 1;
      EXPECT_NE(world.state_hash(), before) << name << ", byte " << i;
      bytes[i] ^= 1;
    }
  });
}

TEST_P(JointTest, EveryFieldReachesTheHash) {
  fill_with_joints(world());
  step_for(world(), 1);
  GetParam() == Precision::kFloat ? expect_every_byte_hashed<float>(world())
                                  : expect_every_byte_hashed<double>(world());
}

TEST_P(JointTest, SameCallsGiveTheSameBits) {
  auto other = make_world(settings_);
  for (World* each : {&world(), other.get()}) {
    fill_with_joints(*each);
    step_for(*each, 3);
  }
  EXPECT_EQ(world().state_hash(), other->state_hash());
}

}  // namespace
}  // namespace urto

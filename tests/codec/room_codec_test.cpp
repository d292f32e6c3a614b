#include "codec/room_codec.h"

#include <gtest/gtest.h>

#include "support/proto_text.h"
#include "support/room_driver.h"
#include "urto/v1/room.pb.h"

namespace urto::codec {
namespace {

using testing::floating_scene;
using testing::from_bytes;
using testing::RoomDriver;

TEST(RoomCodec, InfoSaysWhatTheRoomIs) {
  RoomSettings settings;
  settings.roles.control = Control::kOwners;
  RoomDriver driver(settings);
  driver.room->join({"ann", "s1"});
  driver.tick();
  const HostInfo host{"lab", "9.9.9", 60, true, 12.5};
  const auto info = from_bytes<v1::RoomInfo>(
      encode_info(*driver.room->view({}), driver.room->scene(), driver.room->settings(), host));
  EXPECT_EQ(info.room(), "lab");
  EXPECT_EQ(info.server_version(), "9.9.9");
  EXPECT_EQ(info.protocol_version(), kProtocolVersion);
  EXPECT_EQ(info.scene(), "floating");
  EXPECT_EQ(info.tick(), 1u);
  EXPECT_EQ(info.epoch(), 1u);
  EXPECT_EQ(info.time_step(), 1.0 / 60.0);
  EXPECT_EQ(info.time_scale(), 1);
  EXPECT_EQ(info.snapshot_rate_hz(), 60);
  EXPECT_FALSE(info.paused());
  ASSERT_EQ(info.members_size(), 1);
  EXPECT_EQ(info.members(0).session(), "s1");
  EXPECT_GT(info.model_size(), 0);
  EXPECT_EQ(info.limits().bodies_max(), Limits{}.bodies_max);
  EXPECT_EQ(info.limits().step_ticks_max(), Limits{}.step_ticks_max);
  EXPECT_EQ(info.control(), v1::PERMISSION_OWNERS);
  EXPECT_TRUE(info.authenticated());
  EXPECT_EQ(info.uptime(), 12.5);
  EXPECT_EQ(info.state_hash(), driver.room->world().state_hash());
  EXPECT_EQ(info.precision(), v1::PRECISION_DOUBLE);
  EXPECT_EQ(info.statistics().body_count(), 2u);
}

TEST(RoomCodec, StateIsAllThatALateJoinerNeeds) {
  RoomDriver driver;
  driver.ask({Spawn{testing::box_body("crate", {3, 3})}, SetVelocity{"crate", Vec2(6, 0), {}}});
  const auto view = driver.room->view({true, true});
  const auto state =
      from_bytes<v1::RoomState>(encode_state(*view, driver.room->scene(), driver.room->settings(), HostInfo{}, true));
  EXPECT_EQ(state.scene().name(), "floating");
  EXPECT_EQ(state.scene().bodies_size(), 0);
  ASSERT_EQ(state.bodies_size(), 3);
  const auto& crate = state.bodies(2);
  EXPECT_EQ(crate.body().name(), "crate");
  EXPECT_EQ(crate.body().position().x(), 3);
  EXPECT_NEAR(crate.position().x(), 3.1, 1e-12);
  EXPECT_EQ(crate.velocity().x(), 6);
  EXPECT_EQ(crate.mass(), 1);
  EXPECT_NEAR(crate.inertia(), 1.0 / 6, 1e-12);
  EXPECT_TRUE(crate.awake());
  EXPECT_TRUE(state.snapshot().full());
  EXPECT_EQ(state.snapshot().id_size(), 3);
  EXPECT_EQ(state.saved_state().size(), driver.room->world().save().size());
  const auto lean =
      from_bytes<v1::RoomState>(encode_state(*view, driver.room->scene(), driver.room->settings(), HostInfo{}, false));
  EXPECT_TRUE(lean.saved_state().empty());
}

}  // namespace
}  // namespace urto::codec

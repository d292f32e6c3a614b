#include "codec/snapshot_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/proto_text.h"

namespace urto::codec {
namespace {

using ::testing::ElementsAre;
using testing::from_bytes;

Frame small_frame(Precision precision) {
  Frame frame;
  frame.epoch = 2;
  frame.tick = 30;
  frame.sim_time = 0.5;
  frame.layout = 4;
  frame.precision = precision;
  frame.bodies = {{7, 9}, {1.1, 2}, {3, 4}, {0.1, 0.2}, {5, 6}, {7, 8}, {9, 10}, {1, 0}};
  frame.paused = true;
  frame.event_sequence = 12;
  frame.state_hash = 0xfedcba9876543210u;
  frame.full = true;
  frame.statistics.counters = {10, 5, 12, 0, 20, 3, 0.001};
  frame.statistics.profile.step_ms = 1.5;
  frame.statistics.profile.ms[1] = 0.75;
  frame.statistics.energy.kinetic = 8;
  frame.statistics.energy.potential = -9;
  frame.statistics.overrun_count = 11;
  frame.statistics.member_count = 2;
  return frame;
}

TEST(SnapshotCodec, FloatRoomsFillTheFloatColumns) {
  SnapshotEncoder encoder;
  const auto message = from_bytes<v1::Snapshot>(encoder.encode(small_frame(Precision::kFloat)));
  EXPECT_EQ(message.epoch(), 2u);
  EXPECT_EQ(message.tick(), 30u);
  EXPECT_EQ(message.sim_time(), 0.5);
  EXPECT_EQ(message.layout(), 4u);
  EXPECT_THAT(message.id(), ElementsAre(7, 9));
  EXPECT_THAT(message.x(), ElementsAre(1.1f, 2.0f));
  EXPECT_THAT(message.y(), ElementsAre(3, 4));
  EXPECT_THAT(message.angle(), ElementsAre(0.1f, 0.2f));
  EXPECT_THAT(message.velocity_x(), ElementsAre(5, 6));
  EXPECT_THAT(message.velocity_y(), ElementsAre(7, 8));
  EXPECT_THAT(message.angular_velocity(), ElementsAre(9, 10));
  EXPECT_EQ(message.x_double_size(), 0);
  EXPECT_EQ(message.awake(), std::string("\1\0", 2));
  EXPECT_TRUE(message.paused());
  EXPECT_EQ(message.event_sequence(), 12u);
  EXPECT_EQ(message.state_hash(), 0xfedcba9876543210u);
  EXPECT_TRUE(message.full());
}

TEST(SnapshotCodec, DoubleRoomsFillTheDoubleColumns) {
  SnapshotEncoder encoder;
  const auto message = from_bytes<v1::Snapshot>(encoder.encode(small_frame(Precision::kDouble)));
  EXPECT_EQ(message.x_size(), 0);
  EXPECT_THAT(message.x_double(), ElementsAre(1.1, 2));
  EXPECT_THAT(message.y_double(), ElementsAre(3, 4));
  EXPECT_THAT(message.angle_double(), ElementsAre(0.1, 0.2));
  EXPECT_THAT(message.velocity_x_double(), ElementsAre(5, 6));
  EXPECT_THAT(message.velocity_y_double(), ElementsAre(7, 8));
  EXPECT_THAT(message.angular_velocity_double(), ElementsAre(9, 10));
}

TEST(SnapshotCodec, StatisticsAreComplete) {
  SnapshotEncoder encoder;
  const auto statistics = from_bytes<v1::Snapshot>(encoder.encode(small_frame(Precision::kFloat))).statistics();
  EXPECT_EQ(statistics.body_count(), 10u);
  EXPECT_EQ(statistics.awake_count(), 5u);
  EXPECT_EQ(statistics.contact_count(), 3u);
  EXPECT_EQ(statistics.step_ms(), 1.5);
  EXPECT_EQ(statistics.overrun_count(), 11u);
  EXPECT_EQ(statistics.member_count(), 2u);
  EXPECT_EQ(statistics.kinetic_energy(), 8);
  EXPECT_EQ(statistics.potential_energy(), -9);
  EXPECT_EQ(statistics.penetration_max(), 0.001);
  ASSERT_EQ(statistics.phases_size(), static_cast<int>(Phase::kCount));
  EXPECT_EQ(statistics.phases(1).name(), phase_name(static_cast<Phase>(1)));
  EXPECT_EQ(statistics.phases(1).ms(), 0.75);
}

TEST(SnapshotCodec, EncoderLeavesNothingOfTheFrameBefore) {
  SnapshotEncoder reused;
  reused.encode(small_frame(Precision::kDouble));
  Frame empty;
  SnapshotEncoder fresh;
  EXPECT_EQ(reused.encode(empty), fresh.encode(empty));
  const Frame frame = small_frame(Precision::kFloat);
  EXPECT_EQ(reused.encode(frame), fresh.encode(frame));
}

}  // namespace
}  // namespace urto::codec

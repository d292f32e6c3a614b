#include "codec/event_codec.h"

#include <gtest/gtest.h>

#include "support/proto_text.h"
#include "support/scenes.h"
#include "urto/v1/snapshot.pb.h"

namespace urto::codec {
namespace {

using testing::box_body;
using testing::from_bytes;

v1::Event encoded(const Event& event) {
  EventSlice slice;
  slice.events.push_back({1, 8, event});
  return from_bytes<v1::EventBatch>(encode_events(slice)).events(0);
}

TEST(EventCodec, BatchNamesItsPlaceInTheSequence) {
  EventSlice slice{3, 100, 40, {{3, 7, RoomPaused{"ann"}}, {3, 8, RoomResumed{"bob"}}}};
  const auto batch = from_bytes<v1::EventBatch>(encode_events(slice));
  EXPECT_EQ(batch.epoch(), 3u);
  EXPECT_EQ(batch.first_sequence(), 100u);
  EXPECT_EQ(batch.oldest_sequence(), 40u);
  ASSERT_EQ(batch.events_size(), 2);
  EXPECT_EQ(batch.events(0).tick(), 7u);
  EXPECT_EQ(batch.events(0).room_paused().user(), "ann");
  EXPECT_EQ(batch.events(1).room_resumed().user(), "bob");
}

TEST(EventCodec, Contacts) {
  ContactEvent contact{ContactEvent::Kind::kBegin, 1, 2, {3, 4}, {0, 1}, 5, true};
  const auto begin = encoded(contact).contact_begin();
  EXPECT_EQ(begin.body_a(), 1u);
  EXPECT_EQ(begin.body_b(), 2u);
  EXPECT_EQ(begin.point().x(), 3);
  EXPECT_EQ(begin.normal().y(), 1);
  EXPECT_EQ(begin.approach_speed(), 5);
  EXPECT_TRUE(begin.sensor());
  contact.kind = ContactEvent::Kind::kHit;
  const auto hit = encoded(contact).contact_hit();
  EXPECT_EQ(hit.body_a(), 1u);
  EXPECT_EQ(hit.body_b(), 2u);
  EXPECT_EQ(hit.point().y(), 4);
  EXPECT_EQ(hit.normal().y(), 1);
  EXPECT_EQ(hit.approach_speed(), 5);
  contact.kind = ContactEvent::Kind::kEnd;
  EXPECT_EQ(encoded(contact).contact_end().body_b(), 2u);
}

TEST(EventCodec, Bodies) {
  const auto record = std::make_shared<BodyRecord>(BodyRecord{9, box_body("crate", {1, 2}), "ann", {}});
  const auto added = encoded(BodyAdded{record, 5}).body_added();
  EXPECT_EQ(added.id(), 9u);
  EXPECT_EQ(added.body().name(), "crate");
  EXPECT_EQ(added.body().shapes(0).box().width(), 1);
  EXPECT_EQ(added.layout(), 5u);
  EXPECT_EQ(added.user(), "ann");
  const auto removed = encoded(BodyRemoved{9, 6, "bob"}).body_removed();
  EXPECT_EQ(removed.id(), 9u);
  EXPECT_EQ(removed.layout(), 6u);
  EXPECT_EQ(removed.user(), "bob");
}

TEST(EventCodec, Room) {
  EXPECT_EQ(encoded(MemberJoined{"ann", "s1"}).member_joined().session(), "s1");
  EXPECT_EQ(encoded(MemberLeft{"ann", "s1"}).member_left().user(), "ann");
  EXPECT_EQ(encoded(RoomReset{"ann", 4}).room_reset().epoch(), 4u);
  EXPECT_EQ(encoded(TimeScaleChanged{"ann", 0.5}).time_scale_changed().scale(), 0.5);
  const auto rejected = encoded(BatchRejected{"ann", 17, "why"}).batch_rejected();
  EXPECT_EQ(rejected.sequence(), 17u);
  EXPECT_EQ(rejected.reason(), "why");
  EXPECT_EQ(encoded(EventsDropped{3}).events_dropped().count(), 3u);
}

}  // namespace
}  // namespace urto::codec

#include "codec/event_codec.h"

#include <google/protobuf/arena.h>

#include <variant>

#include "codec/joint_codec.h"
#include "codec/scene_codec.h"
#include "urto/v1/snapshot.pb.h"

namespace urto::codec {
namespace {

struct EventWriter {
  v1::Event* out;

  void operator()(const ContactEvent& event) const {
    if (event.kind == ContactEvent::Kind::kEnd) {
      auto* end = out->mutable_contact_end();
      end->set_body_a(event.body_a);
      end->set_body_b(event.body_b);
      end->set_sensor(event.sensor);
      return;
    }
    if (event.kind == ContactEvent::Kind::kHit) {
      auto* hit = out->mutable_contact_hit();
      hit->set_body_a(event.body_a);
      hit->set_body_b(event.body_b);
      write_vector(event.point, hit->mutable_point());
      write_vector(event.normal, hit->mutable_normal());
      hit->set_approach_speed(event.approach_speed);
      return;
    }
    auto* begin = out->mutable_contact_begin();
    begin->set_body_a(event.body_a);
    begin->set_body_b(event.body_b);
    write_vector(event.point, begin->mutable_point());
    write_vector(event.normal, begin->mutable_normal());
    begin->set_approach_speed(event.approach_speed);
    begin->set_sensor(event.sensor);
  }
  void operator()(const BodyAdded& event) const {
    auto* added = out->mutable_body_added();
    added->set_id(event.body->id);
    write_body(event.body->spec, added->mutable_body());
    added->set_layout(event.layout);
    added->set_user(event.body->user);
  }
  void operator()(const BodyRemoved& event) const {
    auto* removed = out->mutable_body_removed();
    removed->set_id(event.id);
    removed->set_layout(event.layout);
    removed->set_user(event.user);
  }
  void operator()(const JointAdded& event) const {
    auto* added = out->mutable_joint_added();
    added->set_id(event.joint->id);
    write_joint(event.joint->spec, added->mutable_joint());
    added->set_user(event.joint->user);
  }
  void operator()(const JointRemoved& event) const {
    out->mutable_joint_removed()->set_id(event.id);
    out->mutable_joint_removed()->set_user(event.user);
  }
  void operator()(const JointEvent& event) const {
    auto* broke = out->mutable_joint_broke();
    broke->set_id(event.joint);
    broke->set_body_a(event.body_a);
    broke->set_body_b(event.body_b);
    write_vector(event.point, broke->mutable_point());
    broke->set_force(event.force);
    broke->set_torque(event.torque);
  }
  void operator()(const MemberJoined& event) const {
    out->mutable_member_joined()->set_user(event.user);
    out->mutable_member_joined()->set_session(event.session);
  }
  void operator()(const MemberLeft& event) const {
    out->mutable_member_left()->set_user(event.user);
    out->mutable_member_left()->set_session(event.session);
  }
  void operator()(const RoomPaused& event) const { out->mutable_room_paused()->set_user(event.user); }
  void operator()(const RoomResumed& event) const { out->mutable_room_resumed()->set_user(event.user); }
  void operator()(const RoomReset& event) const {
    out->mutable_room_reset()->set_user(event.user);
    out->mutable_room_reset()->set_epoch(event.epoch);
  }
  void operator()(const TimeScaleChanged& event) const {
    out->mutable_time_scale_changed()->set_user(event.user);
    out->mutable_time_scale_changed()->set_scale(event.scale);
  }
  void operator()(const BatchRejected& event) const {
    auto* rejected = out->mutable_batch_rejected();
    rejected->set_user(event.user);
    rejected->set_sequence(event.sequence);
    rejected->set_reason(event.reason);
  }
  void operator()(const EventsDropped& event) const { out->mutable_events_dropped()->set_count(event.count); }
};

}  // namespace

std::string encode_events(const EventSlice& slice) {
  google::protobuf::Arena arena;
  auto& message = *google::protobuf::Arena::CreateMessage<v1::EventBatch>(&arena);
  message.set_epoch(slice.epoch);
  message.set_first_sequence(slice.first_sequence);
  message.set_oldest_sequence(slice.oldest_sequence);
  for (const EventRecord& record : slice.events) {
    auto* event = message.add_events();
    event->set_tick(record.tick);
    std::visit(EventWriter{event}, record.event);
  }
  return message.SerializeAsString();
}

}  // namespace urto::codec

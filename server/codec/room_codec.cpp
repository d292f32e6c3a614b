#include "codec/room_codec.h"

#include <google/protobuf/arena.h>

#include "codec/joint_codec.h"
#include "codec/scene_codec.h"
#include "codec/snapshot_codec.h"
#include "urto/v1/room.pb.h"

namespace urto::codec {
namespace {

static_assert(v1::PERMISSION_EVERYONE == static_cast<int>(Control::kEveryone) + 1);
static_assert(v1::PERMISSION_OWNERS == static_cast<int>(Control::kOwners) + 1);
static_assert(v1::PERMISSION_NOBODY == static_cast<int>(Control::kNobody) + 1);

void write_limits(const Limits& limits, v1::Limits* out) {
  out->set_bodies_max(limits.bodies_max);
  out->set_shapes_max(limits.shapes_max);
  out->set_batch_commands_max(limits.batch_commands_max);
  out->set_queue_batches_max(limits.queue_batches_max);
  out->set_batches_per_tick_max(limits.batches_per_tick_max);
  out->set_message_bytes_max(limits.message_bytes_max);
  out->set_members_max(limits.members_max);
  out->set_events_kept_max(limits.events_kept_max);
  out->set_step_ticks_max(limits.step_ticks_max);
  out->set_joints_max(limits.joints_max);
}

void write_body_info(const BodyInfo& info, v1::BodyInfo* out) {
  out->set_id(info.record->id);
  write_body(info.record->spec, out->mutable_body());
  out->set_mass(info.record->mass.mass);
  out->set_inertia(info.record->mass.inertia);
  write_vector(info.record->mass.center_of_mass, out->mutable_center_of_mass());
  write_vector(info.state.position, out->mutable_position());
  out->set_angle(info.state.angle);
  write_vector(info.state.velocity, out->mutable_velocity());
  out->set_angular_velocity(info.state.angular_velocity);
  out->set_awake(info.state.awake);
}

void write_info(const RoomView& view, const SceneDef& scene, const RoomSettings& settings, const HostInfo& host,
                v1::RoomInfo* out) {
  out->set_room(host.room);
  out->set_server_version(host.server_version);
  out->set_protocol_version(kProtocolVersion);
  out->set_scene(scene.name);
  out->set_description(scene.description);
  out->set_epoch(view.epoch);
  out->set_tick(view.tick);
  out->set_time_step(scene.world.time_step);
  out->set_time_scale(view.time_scale);
  out->set_snapshot_rate_hz(host.snapshot_rate_hz);
  out->set_paused(view.paused);
  for (const Member& member : view.members) {
    auto* message = out->add_members();
    message->set_user(member.user);
    message->set_session(member.session);
  }
  for (const Feature& feature : view.model) {
    auto* message = out->add_model();
    message->set_name(feature.name);
    message->set_choice(feature.choice);
    message->set_on(feature.on);
    message->set_reason(feature.reason);
  }
  write_limits(settings.limits, out->mutable_limits());
  write_statistics(view.statistics, out->mutable_statistics());
  out->set_control(static_cast<v1::Permission>(static_cast<int>(settings.roles.control) + 1));
  out->set_authenticated(host.authenticated);
  out->set_uptime(host.uptime);
  out->set_state_hash(view.state_hash);
  out->set_precision(precision_to_proto(scene.world.precision));
}

void write_contacts(const std::vector<ContactPoint>& contacts, v1::Contacts* out) {
  for (const ContactPoint& contact : contacts) {
    out->add_body_a(contact.body_a);
    out->add_body_b(contact.body_b);
    out->add_x(contact.point.x());
    out->add_y(contact.point.y());
    out->add_normal_x(contact.normal.x());
    out->add_normal_y(contact.normal.y());
    out->add_separation(contact.separation);
    out->add_normal_impulse(contact.normal_impulse);
    out->add_tangent_impulse(contact.tangent_impulse);
  }
}

void write_diagnostics(const Diagnostics& diagnostics, v1::Diagnostics* out) {
  const Energy& energy = diagnostics.statistics.energy;
  out->set_tick(diagnostics.tick);
  out->set_sim_time(diagnostics.sim_time);
  out->set_state_hash(diagnostics.state_hash);
  out->set_kinetic_energy(energy.kinetic);
  out->set_potential_energy(energy.potential);
  write_vector(energy.momentum, out->mutable_momentum());
  out->set_angular_momentum(energy.angular_momentum);
  write_statistics(diagnostics.statistics, out->mutable_statistics());
}

void write_hit(const BodyHit& hit, v1::BodyHit* out) {
  out->set_id(hit.id);
  write_vector(hit.point, out->mutable_point());
  write_vector(hit.normal, out->mutable_normal());
  out->set_fraction(hit.fraction);
  out->set_distance(hit.distance);
  if (hit.query_point != Vec2(0, 0)) write_vector(hit.query_point, out->mutable_query_point());
}

}  // namespace

std::string encode_info(const RoomView& view, const SceneDef& scene, const RoomSettings& settings,
                        const HostInfo& host) {
  google::protobuf::Arena arena;
  auto* message = google::protobuf::Arena::CreateMessage<v1::RoomInfo>(&arena);
  write_info(view, scene, settings, host, message);
  return message->SerializeAsString();
}

std::string encode_state(const RoomView& view, const SceneDef& scene, const RoomSettings& settings,
                         const HostInfo& host, bool with_saved_state) {
  google::protobuf::Arena arena;
  auto* message = google::protobuf::Arena::CreateMessage<v1::RoomState>(&arena);
  write_info(view, scene, settings, host, message->mutable_info());
  write_scene_without_bodies(scene, message->mutable_scene());
  for (const BodyInfo& info : view.bodies) write_body_info(info, message->add_bodies());
  for (const JointInfo& info : view.joints) write_joint_info(info, message->add_joints());
  if (view.frame) write_snapshot(*view.frame, message->mutable_snapshot());
  if (with_saved_state) message->set_saved_state(view.saved_state.data(), view.saved_state.size());
  return message->SerializeAsString();
}

void write_query_result(const QueryResult& result, v1::QueryResult* out) {
  for (const BodyHit& hit : result.hits) write_hit(hit, out->add_hits());
  out->set_truncated(result.truncated);
  if (result.contacts) write_contacts(*result.contacts, out->mutable_contacts());
  if (result.diagnostics) write_diagnostics(*result.diagnostics, out->mutable_diagnostics());
  if (result.body) write_body_info(*result.body, out->mutable_body());
  if (!result.joints) return;
  out->mutable_joints();  // there, even if empty
  for (const JointInfo& info : *result.joints) write_joint_info(info, out->mutable_joints()->add_joints());
}

}  // namespace urto::codec

#include "codec/snapshot_codec.h"

#include <algorithm>

namespace urto::codec {
namespace {

template <class T, class S>
void write_column(const std::vector<T>& column, google::protobuf::RepeatedField<S>* out) {
  out->Resize(static_cast<int>(column.size()), S());
  std::transform(column.begin(), column.end(), out->mutable_data(), [](T value) { return static_cast<S>(value); });
}

void write_float_columns(const BodyColumns& bodies, v1::Snapshot* out) {
  write_column(bodies.x, out->mutable_x());
  write_column(bodies.y, out->mutable_y());
  write_column(bodies.angle, out->mutable_angle());
  write_column(bodies.velocity_x, out->mutable_velocity_x());
  write_column(bodies.velocity_y, out->mutable_velocity_y());
  write_column(bodies.angular_velocity, out->mutable_angular_velocity());
}

void write_double_columns(const BodyColumns& bodies, v1::Snapshot* out) {
  write_column(bodies.x, out->mutable_x_double());
  write_column(bodies.y, out->mutable_y_double());
  write_column(bodies.angle, out->mutable_angle_double());
  write_column(bodies.velocity_x, out->mutable_velocity_x_double());
  write_column(bodies.velocity_y, out->mutable_velocity_y_double());
  write_column(bodies.angular_velocity, out->mutable_angular_velocity_double());
}

}  // namespace

void write_statistics(const Statistics& statistics, v1::Statistics* out) {
  out->set_body_count(statistics.counters.bodies);
  out->set_awake_count(statistics.counters.awake_bodies);
  out->set_contact_count(statistics.counters.contacts);
  out->set_step_ms(statistics.profile.step_ms);
  out->set_overrun_count(statistics.overrun_count);
  out->set_member_count(statistics.member_count);
  out->set_kinetic_energy(statistics.energy.kinetic);
  out->set_potential_energy(statistics.energy.potential);
  out->set_penetration_max(statistics.counters.penetration_max);
  for (std::size_t i = 0; i < static_cast<std::size_t>(Phase::kCount); ++i) {
    auto* phase = out->add_phases();
    phase->set_name(phase_name(static_cast<Phase>(i)));
    phase->set_ms(statistics.profile.ms[i]);
  }
}

void write_snapshot(const Frame& frame, v1::Snapshot* out) {
  out->set_epoch(frame.epoch);
  out->set_tick(frame.tick);
  out->set_sim_time(frame.sim_time);
  out->set_layout(frame.layout);
  write_column(frame.bodies.id, out->mutable_id());
  if (frame.precision == Precision::kFloat) {
    write_float_columns(frame.bodies, out);
  } else {
    write_double_columns(frame.bodies, out);
  }
  out->set_awake(frame.bodies.awake.data(), frame.bodies.awake.size());
  out->set_paused(frame.paused);
  out->set_event_sequence(frame.event_sequence);
  out->set_state_hash(frame.state_hash);
  out->set_full(frame.full);
  write_statistics(frame.statistics, out->mutable_statistics());
}

const std::string& SnapshotEncoder::encode(const Frame& frame) {
  message_.Clear();
  write_snapshot(frame, &message_);
  message_.SerializeToString(&bytes_);
  return bytes_;
}

}  // namespace urto::codec

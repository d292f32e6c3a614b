#include "physics/state.h"

#include <cstring>
#include <type_traits>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "physics/body_factory.h"
#include "physics/validation.h"

namespace urto {
namespace {

constexpr std::uint32_t kMagic = 0x4f545255;  // "URTO"
constexpr std::uint32_t kVersion = 2;         // of the layout: any change of a record or of the order

struct Header {
  std::uint32_t magic, version, scalar_bytes, unused;
  std::uint64_t payload_bytes, checksum;
};

class Writer {
 public:
  Writer() : out_(sizeof(Header)) {}
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(&v, sizeof v);
  }
  template <class T>
  void array(const std::vector<T>& v) {
    // Eigen's vectors have constructors, but are nothing beyond their coefficients.
    static_assert(std::is_standard_layout_v<T> && std::is_trivially_destructible_v<T>);
    value(static_cast<std::uint64_t>(v.size()));
    bytes(v.data(), v.size() * sizeof(T));
  }
  void vector(const Vec2& v) {
    value(v.x());
    value(v.y());
  }
  std::vector<std::byte> finish(std::uint32_t scalar_bytes) {
    const std::span<const std::byte> payload = std::span<const std::byte>(out_).subspan(sizeof(Header));
    const Header header{kMagic, kVersion, scalar_bytes, 0, payload.size(), XXH3_64bits(payload.data(), payload.size())};
    std::memcpy(out_.data(), &header, sizeof header);
    return std::move(out_);
  }

 private:
  void bytes(const void* data, std::size_t size) {
    const std::size_t at = out_.size();
    out_.resize(at + size);
    if (size > 0) std::memcpy(out_.data() + at, data, size);
  }
  std::vector<std::byte> out_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> in) : in_(in) {}
  template <class T>
  void value(T& v) {
    bytes(&v, sizeof v);
  }
  template <class T>
  void array(std::vector<T>& v) {
    std::uint64_t count = 0;
    value(count);
    if (!ok_ || count > in_.size() / sizeof(T)) {
      ok_ = false;
      return;
    }
    v.resize(count);
    bytes(v.data(), count * sizeof(T));
  }
  void vector(Vec2& v) {
    value(v.x());
    value(v.y());
  }
  // Does the number stand here?
  bool next_is(std::uint32_t number) const {
    std::uint32_t found = 0;
    if (!ok_ || in_.size() < sizeof found) return false;
    std::memcpy(&found, in_.data(), sizeof found);
    return found == number;
  }
  bool complete() const { return ok_ && in_.empty(); }

 private:
  void bytes(void* data, std::size_t size) {
    if (!ok_ || size > in_.size()) {
      ok_ = false;
      return;
    }
    if (size > 0) std::memcpy(data, in_.data(), size);
    in_ = in_.subspan(size);
  }
  std::span<const std::byte> in_;
  bool ok_ = true;
};

template <class Archive, class Enum>
void enum_value(Archive& ar, Enum& e) {
  auto raw = static_cast<std::uint32_t>(e);
  ar.value(raw);
  e = static_cast<Enum>(raw);
}

template <class Archive, class Settings>
void plain_settings(Archive& ar, Settings& s) {
  ar.vector(s.gravity);
  ar.value(s.time_step);
  ar.value(s.sub_steps);
  ar.value(s.restitution_threshold);
}

// Of a setting that few worlds have: absent, it leaves no trace, as for_each_optional_field says.
constexpr std::uint32_t kHitEventsField = 4;

void write_hit_events(Writer& out, const WorldSettings& s) {
  if (!s.hit_events) return;
  out.value(kHitEventsField);
  out.value(s.hit_events->speed_min);
}

void read_hit_events(Reader& in, WorldSettings& s) {
  if (!in.next_is(kHitEventsField)) return;
  std::uint32_t ignored = 0;
  in.value(ignored);
  s.hit_events.emplace();
  in.value(s.hit_events->speed_min);
}

template <class Archive>
void enum_settings(Archive& ar, WorldSettings& s) {
  enum_value(ar, s.precision);
  enum_value(ar, s.solver);
  enum_value(ar, s.integrator);
  enum_value(ar, s.broad_phase);
  enum_value(ar, s.narrow_phase);
  enum_value(ar, s.sleeping);
  enum_value(ar, s.continuous);
  enum_value(ar, s.friction_mixing);
  enum_value(ar, s.restitution_mixing);
}

// A field as its kind and six numbers, of which each kind uses the first few.
struct FlatField {
  std::uint64_t kind = 0;
  double x = 0, y = 0, p = 0, q = 0;
};

FlatField flatten(const ForceField& field) {
  if (const auto* a = std::get_if<PointAttractor>(&field))
    return {0, a->center.x(), a->center.y(), a->strength, a->softening};
  if (const auto* d = std::get_if<Drag>(&field)) return {1, 0, 0, d->linear, d->quadratic};
  const auto& s = std::get<Spring>(field);
  return {2, s.center.x(), s.center.y(), s.stiffness, s.damping};
}

ForceField unflatten(const FlatField& f) {
  if (f.kind == 0) return PointAttractor{{f.x, f.y}, f.p, f.q};
  if (f.kind == 1) return Drag{f.p, f.q};
  return Spring{{f.x, f.y}, f.p, f.q};
}

void write_settings(Writer& out, WorldSettings s) {
  plain_settings(out, s);
  enum_settings(out, s);
  std::vector<FlatField> fields;
  for (const ForceField& field : s.fields) fields.push_back(flatten(field));
  out.array(fields);
}

void read_settings(Reader& in, WorldSettings& s) {
  plain_settings(in, s);
  enum_settings(in, s);
  std::vector<FlatField> fields;
  in.array(fields);
  s.fields.clear();
  for (const FlatField& field : fields) s.fields.push_back(unflatten(field));
}

Status corrupt(const std::string& what, const std::string& message) {
  return failure(ErrorCode::kCorruptState, "state", what, message);
}

template <class S>
Status check_header(std::span<const std::byte> block) {
  Header header;
  if (block.size() < sizeof header) return corrupt(std::to_string(block.size()), "the state is too short");
  std::memcpy(&header, block.data(), sizeof header);
  if (header.magic != kMagic) return corrupt(std::to_string(header.magic), "this is not a saved state");
  if (header.version != kVersion) return corrupt(std::to_string(header.version), "the state is of another version");
  if (header.scalar_bytes != sizeof(S))
    return corrupt(std::to_string(header.scalar_bytes), "the state is of another precision");
  if (header.unused != 0 || header.payload_bytes != block.size() - sizeof header)
    return corrupt(std::to_string(header.payload_bytes), "the state has another size than it says");
  if (header.checksum != hash_of_state(block)) return corrupt("checksum", "the state is damaged");
  return {};
}

// The records with their manifolds, wherever those are kept now.
template <class S>
std::vector<Contact<S>> settled_contacts(const WorldData<S>& world) {
  std::vector<Contact<S>> out(world.contacts.size());
  for (std::uint32_t slot = 0; slot < out.size(); ++slot) out[slot] = settled(world, slot);
  return out;
}

// What restore derives instead of reading.
template <class S>
void rebuild(WorldData<S>& world, const std::vector<std::uint32_t>& lanes) {
  world.pair_set.clear();
  for (const Contact<S>& c : world.contacts)
    if (c.alive()) world.pair_set.insert(c.shape_a, c.shape_b);
  for (const Contact<S>& c : world.contacts) world.touching_count += c.touching();
  world.needs = Needs{};
  for (std::uint32_t slot = 0; slot < world.bodies.size(); ++slot)
    if (world.bodies[slot].alive()) count_needs(world, slot, +1);
  for (const Joint<S>& j : world.joints) world.needs.joints += j.alive();
  world.outlines.clear();
  for (const Convex<S>& convex : world.convexes) world.outlines.push_back(outline_of(convex));
  world.places.clear();
  for (std::uint32_t slot = 0; slot < world.bodies.size(); ++slot) refresh_places(world, slot);
  rebuild_lanes(world, lanes);
  world.broad_phase.reset();
  update_model(world);
}

}  // namespace

std::uint64_t hash_of_state(std::span<const std::byte> block) {
  const std::span<const std::byte> payload = block.subspan(sizeof(Header));
  return XXH3_64bits(payload.data(), payload.size());
}

template <class S>
std::vector<std::byte> save_state(const WorldData<S>& world) {
  Writer out;
  write_settings(out, world.settings);
  WorldData<S>::for_each_state_field(world, [&](const char*, const auto& field) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(field)>>) {
      out.value(field);
    } else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, std::vector<Contact<S>>>) {
      out.array(settled_contacts(world));
    } else {
      out.array(field);
    }
  });
  out.array(lane_order(world));
  WorldData<S>::for_each_optional_field(world, [&](std::uint32_t number, const char*, const auto& field) {
    if (field.empty()) return;
    out.value(number);
    out.array(field);
  });
  write_hit_events(out, world.settings);
  return out.finish(sizeof(S));
}

template <class S>
Status restore_state(WorldData<S>& world, std::span<const std::byte> block) {
  if (Status status = check_header<S>(block); !status) return status;
  Reader in(block.subspan(sizeof(Header)));
  WorldData<S> fresh;
  read_settings(in, fresh.settings);
  WorldData<S>::for_each_state_field(fresh, [&](const char*, auto& field) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(field)>>) {
      in.value(field);
    } else {
      in.array(field);
    }
  });
  std::vector<std::uint32_t> lanes;
  in.array(lanes);
  WorldData<S>::for_each_optional_field(fresh, [&](std::uint32_t number, const char*, auto& field) {
    if (!in.next_is(number)) return;
    std::uint32_t ignored = 0;
    in.value(ignored);
    in.array(field);
  });
  read_hit_events(in, fresh.settings);
  if (!in.complete()) return corrupt("payload", "the state does not hold what its version should");
  fresh.team = world.team;
  rebuild(fresh, lanes);
  world = std::move(fresh);
  return {};
}

#define URTO_INSTANTIATE(S)                                        \
  template std::vector<std::byte> save_state(const WorldData<S>&); \
  template Status restore_state(WorldData<S>&, std::span<const std::byte>);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

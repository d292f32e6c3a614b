#include "physics/contact_set.h"

#include "physics/data.h"

namespace urto {
namespace {

// A colour that neither body has yet; the last of its kind when all are taken.
std::uint32_t first_free(std::uint64_t taken, std::uint32_t begin, std::uint32_t end) {
  const std::uint64_t kind = (end < 64 ? (1ull << end) : 0ull) - (1ull << begin);
  const std::uint64_t free = ~taken & kind;
  return free == 0 ? end - 1 : static_cast<std::uint32_t>(__builtin_ctzll(free));
}

template <class S>
bool movable(const Body<S>& body) {
  return body.inv_mass > S(0);
}

template <class S>
std::uint32_t color_for(WorldData<S>& world, const Contact<S>& c) {
  std::vector<std::uint64_t>& taken = world.touching.taken;
  taken.resize(world.bodies.size());
  const bool movable_a = movable(world.bodies[c.body_a]), movable_b = movable(world.bodies[c.body_b]);
  const std::uint64_t both = (movable_a ? taken[c.body_a] : 0) | (movable_b ? taken[c.body_b] : 0);
  return movable_a && movable_b ? first_free(both, 0, kMovableColors) : first_free(both, kMovableColors, kColorsMax);
}

// The colour that takes what fits nowhere is never taken.
template <class S>
void mark_taken(WorldData<S>& world, const Contact<S>& c, std::uint32_t color, bool take) {
  if (takes_what_fits_nowhere(color)) return;
  for (std::uint32_t body : {c.body_a, c.body_b}) {
    if (!movable(world.bodies[body])) continue;
    std::uint64_t& taken = world.touching.taken[body];
    taken = take ? taken | (1ull << color) : taken & ~(1ull << color);
  }
}

template <class S>
struct Lane {
  std::uint32_t block, lane;
  Lane(std::uint32_t color, std::uint32_t index)
      : block(index / lanes_used<S>(color)), lane(index % lanes_used<S>(color)) {}
};

template <class S>
void clear_lane(ContactBlock<S>& block, ContactBlockRest<S>& rest, std::uint32_t lane) {
  // Unused lanes compute on zeros and a mass of one, and are not written back.
  for (S* array : {block.nx, block.ny, block.between_along, block.between_lever, block.inv_mass_a, block.inv_inertia_a,
                   block.inv_mass_b, block.inv_inertia_b, block.friction, block.round_a, block.round_b, block.share_a,
                   block.drift2_max, block.coupling})
    array[lane] = S(0);
  block.inv_mass_a[lane] = S(1);
  block.a[lane] = block.b[lane] = 0;
  block.movable_a &= ~(1u << lane);
  block.movable_b &= ~(1u << lane);
  for (int i = 0; i < 2; ++i) {
    PointLanes<S>& p = block.points[i];
    for (S* array : {p.along, p.lever, p.separation, p.normal_impulse, p.tangent_impulse, p.preload, p.inverse_mass,
                     p.tangent_mass, p.total_normal_impulse, p.total_tangent_impulse})
      array[lane] = S(0);
    rest.approach[i][lane] = rest.bounce[i][lane] = S(0);
    rest.id[i][lane] = S(kNoPoint);
  }
  rest.restitution[lane] = S(0);
  rest.shape_a[lane] = rest.shape_b[lane] = rest.contact[lane] = 0;
  rest.boxes &= ~(1u << lane);
  rest.polygons &= ~(1u << lane);
  rest.rounded &= ~(1u << lane);
  rest.begun &= ~(1u << lane);
}

template <class S>
void write_points(const Contact<S>& c, ContactBlock<S>& block, ContactBlockRest<S>& rest, std::uint32_t lane) {
  const auto along = [&](S x, S y) { return x * c.nx + y * c.ny; };
  const auto lever = [&](S x, S y) { return x * c.ny - y * c.nx; };
  block.nx[lane] = c.nx;
  block.ny[lane] = c.ny;
  const ManifoldPoint<S>& first = c.points[0];
  block.between_along[lane] = along(first.ax - first.bx, first.ay - first.by);
  block.between_lever[lane] = lever(first.ax - first.bx, first.ay - first.by);
  for (std::uint32_t i = 0; i < 2; ++i) {
    const ManifoldPoint<S>& point = c.points[i];
    PointLanes<S>& p = block.points[i];
    const bool there = i < c.count;
    p.along[lane] = along(point.ax, point.ay);
    p.lever[lane] = lever(point.ax, point.ay);
    p.separation[lane] = there ? point.separation : S(kFarSeparation);
    p.normal_impulse[lane] = point.normal_impulse;
    p.tangent_impulse[lane] = point.tangent_impulse;
    p.preload[lane] = point.preload;
    p.total_normal_impulse[lane] = point.total_normal_impulse;
    p.total_tangent_impulse[lane] = point.total_tangent_impulse;
    rest.id[i][lane] = there ? S(point.id) : S(kNoPoint);
  }
}

template <class S>
void write_contact(const WorldData<S>& world, std::uint32_t slot, ContactBlock<S>& block, ContactBlockRest<S>& rest,
                   std::uint32_t lane) {
  const Contact<S>& c = world.contacts[slot];
  const Body<S>&a = world.bodies[c.body_a], &b = world.bodies[c.body_b];
  block.a[lane] = c.body_a;
  block.b[lane] = c.body_b;
  block.movable_a |= static_cast<std::uint32_t>(movable(a)) << lane;
  block.movable_b |= static_cast<std::uint32_t>(movable(b)) << lane;
  block.inv_mass_a[lane] = a.inv_mass;
  block.inv_inertia_a[lane] = a.inv_inertia;
  block.inv_mass_b[lane] = b.inv_mass;
  block.inv_inertia_b[lane] = b.inv_inertia;
  block.share_a[lane] = b.inv_mass / (a.inv_mass + b.inv_mass);
  block.friction[lane] = c.friction;
  block.round_a[lane] = world.convexes[c.shape_a].radius;
  block.round_b[lane] = world.convexes[c.shape_b].radius;
  rest.restitution[lane] = c.restitution;
  rest.shape_a[lane] = c.shape_a;
  rest.shape_b[lane] = c.shape_b;
  rest.contact[lane] = slot;
  const PairKind kind = pair_kind(world.places[c.shape_a], world.places[c.shape_b]);
  rest.boxes |= static_cast<std::uint32_t>(kind == PairKind::kBoxes) << lane;
  rest.polygons |= static_cast<std::uint32_t>(kind == PairKind::kPolygons) << lane;
  rest.rounded |= static_cast<std::uint32_t>(kind == PairKind::kRounded) << lane;
  rest.begun |= static_cast<std::uint32_t>(c.touching()) << lane;
  write_points(c, block, rest, lane);
}

template <class S>
void read_points(const ContactBlock<S>& block, const ContactBlockRest<S>& rest, std::uint32_t lane, Contact<S>& c) {
  const S nx = block.nx[lane], ny = block.ny[lane];
  const S dx = block.between_along[lane] * nx + block.between_lever[lane] * ny;
  const S dy = block.between_along[lane] * ny - block.between_lever[lane] * nx;
  c.nx = nx;
  c.ny = ny;
  c.count = 0;
  for (int i = 0; i < 2; ++i) {
    const PointLanes<S>& p = block.points[i];
    ManifoldPoint<S>& point = c.points[i];
    point = ManifoldPoint<S>{};
    const S id = rest.id[i][lane];
    if (id < S(0) || id == S(kIdlePoint) || id == S(kGhostPoint)) continue;
    ++c.count;
    point.ax = p.along[lane] * nx + p.lever[lane] * ny;
    point.ay = p.along[lane] * ny - p.lever[lane] * nx;
    point.bx = point.ax - dx;
    point.by = point.ay - dy;
    point.separation = p.separation[lane];
    point.normal_impulse = p.normal_impulse[lane];
    point.tangent_impulse = p.tangent_impulse[lane];
    point.preload = p.preload[lane];
    point.total_normal_impulse = p.total_normal_impulse[lane];
    point.total_tangent_impulse = p.total_tangent_impulse[lane];
    point.id = static_cast<std::uint32_t>(rest.id[i][lane]);
  }
}

// All lanes of a block are arrays of four-byte or scalar values side by side: copies lane `from` of the last block to
// lane `to` of another.
template <class S>
void move_lane(const ContactBlock<S>& from, const ContactBlockRest<S>& from_rest, std::uint32_t i, ContactBlock<S>& to,
               ContactBlockRest<S>& to_rest, std::uint32_t k) {
  const auto copy = [i, k](const auto& source, auto& target) { target[k] = source[i]; };
  const auto copy_bit = [i, k](std::uint32_t source, std::uint32_t& target) {
    target = (target & ~(1u << k)) | (((source >> i) & 1u) << k);
  };
  copy(from.nx, to.nx);
  copy(from.ny, to.ny);
  copy(from.between_along, to.between_along);
  copy(from.between_lever, to.between_lever);
  copy(from.inv_mass_a, to.inv_mass_a);
  copy(from.inv_inertia_a, to.inv_inertia_a);
  copy(from.inv_mass_b, to.inv_mass_b);
  copy(from.inv_inertia_b, to.inv_inertia_b);
  copy(from.friction, to.friction);
  copy(from.round_a, to.round_a);
  copy(from.round_b, to.round_b);
  copy(from.share_a, to.share_a);
  copy(from.drift2_max, to.drift2_max);
  copy(from.coupling, to.coupling);
  copy(from.a, to.a);
  copy(from.b, to.b);
  copy_bit(from.movable_a, to.movable_a);
  copy_bit(from.movable_b, to.movable_b);
  for (int p = 0; p < 2; ++p) {
    const PointLanes<S>& source = from.points[p];
    PointLanes<S>& target = to.points[p];
    copy(source.along, target.along);
    copy(source.lever, target.lever);
    copy(source.separation, target.separation);
    copy(source.normal_impulse, target.normal_impulse);
    copy(source.tangent_impulse, target.tangent_impulse);
    copy(source.preload, target.preload);
    copy(source.inverse_mass, target.inverse_mass);
    copy(source.tangent_mass, target.tangent_mass);
    copy(source.total_normal_impulse, target.total_normal_impulse);
    copy(source.total_tangent_impulse, target.total_tangent_impulse);
    copy(from_rest.approach[p], to_rest.approach[p]);
    copy(from_rest.bounce[p], to_rest.bounce[p]);
    copy(from_rest.id[p], to_rest.id[p]);
  }
  copy(from_rest.restitution, to_rest.restitution);
  copy(from_rest.shape_a, to_rest.shape_a);
  copy(from_rest.shape_b, to_rest.shape_b);
  copy(from_rest.contact, to_rest.contact);
  copy_bit(from_rest.boxes, to_rest.boxes);
  copy_bit(from_rest.polygons, to_rest.polygons);
  copy_bit(from_rest.rounded, to_rest.rounded);
  copy_bit(from_rest.begun, to_rest.begun);
}

template <class S>
void append_block(typename ContactSet<S>::Color& color) {
  ContactBlock<S>& block = color.blocks.emplace_back();
  ContactBlockRest<S>& rest = color.rest.emplace_back();
  block.movable_a = block.movable_b = block.count = 0;
  rest.boxes = rest.polygons = rest.rounded = rest.begun = 0;
  for (std::uint32_t lane = 0; lane < static_cast<std::uint32_t>(kLanes<S>); ++lane) clear_lane(block, rest, lane);
}

}  // namespace

template <class S>
void insert_lane(WorldData<S>& world, std::uint32_t contact) {
  insert_lane(world, contact, color_for(world, world.contacts[contact]));
}

template <class S>
void insert_lane(WorldData<S>& world, std::uint32_t contact, std::uint32_t color) {
  Contact<S>& c = world.contacts[contact];
  typename ContactSet<S>::Color& lanes = world.touching.colors[color];
  const Lane<S> at(color, lanes.size);
  if (at.block == lanes.blocks.size()) append_block<S>(lanes);
  write_contact(world, contact, lanes.blocks[at.block], lanes.rest[at.block], at.lane);
  ++lanes.blocks[at.block].count;
  c.color = color;
  c.index = lanes.size++;
  mark_taken(world, c, color, true);
}

template <class S>
void remove_lane(WorldData<S>& world, std::uint32_t contact) {
  Contact<S>& c = world.contacts[contact];
  typename ContactSet<S>::Color& lanes = world.touching.colors[c.color];
  const Lane<S> hole(c.color, c.index), last(c.color, lanes.size - 1);
  if (world.touching.current) read_points(lanes.blocks[hole.block], lanes.rest[hole.block], hole.lane, c);
  if (c.index != lanes.size - 1) {
    move_lane(lanes.blocks[last.block], lanes.rest[last.block], last.lane, lanes.blocks[hole.block],
              lanes.rest[hole.block], hole.lane);
    world.contacts[lanes.rest[hole.block].contact[hole.lane]].index = c.index;
  }
  clear_lane(lanes.blocks[last.block], lanes.rest[last.block], last.lane);
  --lanes.size;
  if (--lanes.blocks[last.block].count == 0) {
    lanes.blocks.pop_back();
    lanes.rest.pop_back();
  }
  mark_taken(world, c, c.color, false);
  c.color = c.index = kNone;
}

template <class S>
Contact<S> settled(const WorldData<S>& world, std::uint32_t contact) {
  Contact<S> c = world.contacts[contact];
  if (c.color >= kColorsMax || !world.touching.current) return c;
  const Lane<S> at(c.color, c.index);
  const typename ContactSet<S>::Color& lanes = world.touching.colors[c.color];
  read_points(lanes.blocks[at.block], lanes.rest[at.block], at.lane, c);
  return c;
}

template <class S>
std::vector<std::uint32_t> lane_order(const WorldData<S>& world) {
  std::vector<std::uint32_t> order;
  for (const auto& color : world.touching.colors)
    for (std::size_t block = 0; block < color.blocks.size(); ++block)
      order.insert(order.end(), color.rest[block].contact, color.rest[block].contact + color.blocks[block].count);
  return order;
}

template <class S>
void rebuild_lanes(WorldData<S>& world, const std::vector<std::uint32_t>& order) {
  world.touching = ContactSet<S>{};
  world.touching.taken.resize(world.bodies.size());
  for (std::uint32_t contact : order) insert_lane(world, contact, world.contacts[contact].color);
}

#define URTO_INSTANTIATE(S)                                               \
  template void insert_lane(WorldData<S>&, std::uint32_t);                \
  template void insert_lane(WorldData<S>&, std::uint32_t, std::uint32_t); \
  template void remove_lane(WorldData<S>&, std::uint32_t);                \
  template Contact<S> settled(const WorldData<S>&, std::uint32_t);        \
  template std::vector<std::uint32_t> lane_order(const WorldData<S>&);    \
  template void rebuild_lanes(WorldData<S>&, const std::vector<std::uint32_t>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

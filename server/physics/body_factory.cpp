#include "physics/body_factory.h"

#include "physics/bounds.h"
#include "physics/constants.h"
#include "physics/contact_graph.h"
#include "physics/geometry/polygon.h"
#include "physics/joint_graph.h"

namespace urto {
namespace {

struct Part {
  Geometry geometry;  // a convex polygon, a box, a circle, a capsule, or one segment of a chain as one of 4 vertices
  const ShapeDef* def;
  AreaProperties area;
  std::uint32_t flags = 0;  // ConvexFlag
};

// The vertex before the first or after the last of an open chain: straight down behind it, so that the end is a corner
// of a right angle around which bodies can roll.
Vec2 beyond_end(const Vec2& end, const Vec2& edge) { return end + Vec2(-edge.y(), edge.x()); }

void add_chain(const Chain& chain, const ShapeDef& shape, std::vector<Part>& parts) {
  const std::vector<Vec2>& v = chain.vertices;
  const std::size_t n = v.size(), segments = chain.loop ? n : n - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Vec2 a = v[i], b = v[(i + 1) % n];
    const bool first = !chain.loop && i == 0, last = !chain.loop && i + 1 == segments;
    const Vec2 before = first ? beyond_end(a, b - a) : v[(i + n - 1) % n];
    const Vec2 after = last ? beyond_end(b, b - a) : v[(i + 2) % n];
    parts.push_back({Chain{{a, b, before, after}, false}, &shape, AreaProperties{0, 0.5 * (a + b), 0},
                     kConvexChainSegment | (last ? kConvexChainEnd : 0u)});
  }
}

std::vector<Vec2> box_corners(const Box& box) {
  const Rotation<double> q = Rotation<double>::from_angle(box.angle);
  const double hw = 0.5 * box.width, hh = 0.5 * box.height;
  std::vector<Vec2> corners = {{-hw, -hh}, {hw, -hh}, {hw, hh}, {-hw, hh}};
  for (Vec2& corner : corners) corner = box.center + q.apply(corner);
  return corners;
}

AreaProperties area_of(const Box& box) {
  return box.radius == 0 ? box_area_properties(box.width, box.height, box.center)
                         : rounded_area_properties(box_corners(box), box.radius);
}

// A body's shapes with concave polygons taken apart.
std::vector<Part> convex_parts(const BodyDef& def) {
  std::vector<Part> parts;
  for (const ShapeDef& shape : def.shapes) {
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      parts.push_back({*box, &shape, area_of(*box)});
    } else if (const auto* circle = std::get_if<Circle>(&shape.geometry)) {
      parts.push_back({*circle, &shape, circle_area_properties(circle->radius, circle->center)});
    } else if (const auto* capsule = std::get_if<Capsule>(&shape.geometry)) {
      parts.push_back({*capsule, &shape, rounded_area_properties({capsule->a, capsule->b}, capsule->radius)});
    } else if (const auto* chain = std::get_if<Chain>(&shape.geometry)) {
      add_chain(*chain, shape, parts);
    } else {
      const auto& polygon = std::get<Polygon>(shape.geometry);
      auto convex = decompose_polygon(polygon.vertices);
      for (std::vector<Vec2>& vertices : *convex) {
        const AreaProperties area =
            polygon.radius == 0 ? polygon_area_properties(vertices) : rounded_area_properties(vertices, polygon.radius);
        parts.push_back({Polygon{std::move(vertices), polygon.radius}, &shape, area});
      }
    }
  }
  return parts;
}

MassProperties mass_of(const BodyDef& def, const std::vector<Part>& parts) {
  MassProperties out;
  Vec2 moment(0, 0);
  for (const Part& part : parts) {
    if (part.def->sensor) continue;
    const double mass = part.area.area * part.def->material.density;
    out.mass += mass;
    moment += mass * part.area.centroid;
  }
  if (out.mass > 0) out.center_of_mass = moment / out.mass;
  for (const Part& part : parts) {  // parallel axes (Huygens–Steiner)
    if (part.def->sensor) continue;
    const Vec2 r = part.area.centroid - out.center_of_mass;
    out.inertia += part.def->material.density * (part.area.second_moment + part.area.area * dot<double>(r, r));
  }
  if (def.mass) {
    out.inertia *= *def.mass / out.mass;
    out.mass = *def.mass;
  }
  return out;
}

// Two vertices make a segment, seen from both sides.
template <class S>
void set_polygon(Convex<S>& convex, const std::vector<Vec2>& vertices, const Vec2& centroid) {
  convex.count = static_cast<std::uint32_t>(vertices.size());
  convex.centroid = centroid.cast<S>();
  for (std::uint32_t i = 0; i < convex.count; ++i) {
    const Vec2 edge = vertices[i + 1 < convex.count ? i + 1 : 0] - vertices[i];
    convex.vertices[i] = vertices[i].cast<S>();
    convex.normals[i] = (cross<double>(edge, 1.0) / length<double>(edge)).cast<S>();
  }
}

template <class S>
void set_box(Convex<S>& convex, const Box& box) {
  const Rotation<double> q = Rotation<double>::from_angle(box.angle);
  const double hw = 0.5 * box.width, hh = 0.5 * box.height;
  // normals[0] is down, normals[1] right, as the tight bounds of boxes expect.
  const Vec2 corners[4] = {{-hw, -hh}, {hw, -hh}, {hw, hh}, {-hw, hh}};
  const Vec2 normals[4] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  convex.count = 4;
  convex.centroid = box.center.cast<S>();
  for (int i = 0; i < 4; ++i) {
    convex.vertices[i] = (box.center + q.apply(corners[i])).cast<S>();
    convex.normals[i] = q.apply(normals[i]).cast<S>();
  }
}

// Distance from the centroid to the nearest face: how far the shape may move before its centroid is through.
template <class S>
S inner_radius(const Convex<S>& convex) {
  if (convex.count == 1) return convex.radius;
  S least = dot<S>(convex.normals[0], convex.vertices[0] - convex.centroid);
  for (std::uint32_t i = 1; i < convex.count; ++i)
    least = min_of(least, dot<S>(convex.normals[i], convex.vertices[i] - convex.centroid));
  return least + convex.radius;
}

template <class S>
S outer_radius(const Convex<S>& convex, const Vec<S>& center) {
  S most = S(0);
  for (std::uint32_t i = 0; i < convex.count; ++i) most = max_of(most, length<S>(convex.vertices[i] - center));
  return most + convex.radius;
}

// Fills in the outline of a part, and says what kind of shape it is.
template <class S>
ShapeKind set_outline(Convex<S>& convex, Shape<S>& shape, const Part& part) {
  if (const auto* box = std::get_if<Box>(&part.geometry)) {
    set_box(convex, *box);
    convex.radius = S(box->radius);
    if (box->radius != 0) return ShapeKind::kPolygon;
    shape.half_width = S(0.5 * box->width);
    shape.half_height = S(0.5 * box->height);
    return ShapeKind::kBox;
  }
  if (const auto* circle = std::get_if<Circle>(&part.geometry)) {
    convex.count = 1;
    convex.centroid = convex.vertices[0] = circle->center.cast<S>();
    convex.radius = S(circle->radius);
    return ShapeKind::kCircle;
  }
  if (const auto* capsule = std::get_if<Capsule>(&part.geometry)) {
    set_polygon(convex, {capsule->a, capsule->b}, part.area.centroid);
    convex.radius = S(capsule->radius);
    return ShapeKind::kCapsule;
  }
  if (const auto* chain = std::get_if<Chain>(&part.geometry)) {
    set_polygon(convex, {chain->vertices[0], chain->vertices[1]}, part.area.centroid);
    convex.vertices[Convex<S>::kGhostBefore] = chain->vertices[2].template cast<S>();
    convex.vertices[Convex<S>::kGhostAfter] = chain->vertices[3].template cast<S>();
    convex.flags = part.flags;
    return ShapeKind::kChainSegment;
  }
  const auto& polygon = std::get<Polygon>(part.geometry);
  set_polygon(convex, polygon.vertices, part.area.centroid);
  convex.radius = S(polygon.radius);
  return ShapeKind::kPolygon;
}

template <class S>
std::uint32_t take_shape_slot(WorldData<S>& world) {
  if (!world.free_shapes.empty()) {
    const std::uint32_t slot = world.free_shapes.back();
    world.free_shapes.pop_back();
    return slot;
  }
  world.shapes.emplace_back();
  world.convexes.emplace_back();
  world.outlines.emplace_back();
  return static_cast<std::uint32_t>(world.shapes.size() - 1);
}

template <class S>
void create_shape(WorldData<S>& world, std::uint32_t body_slot, const Part& part) {
  const Proxy proxy = take_shape_slot(world);
  Shape<S>& shape = world.shapes[proxy];
  Convex<S>& convex = world.convexes[proxy];
  shape = Shape<S>{};
  convex = Convex<S>{};
  shape.kind = static_cast<std::uint32_t>(set_outline(convex, shape, part));
  world.outlines[proxy] = outline_of(convex);
  Body<S>& body = world.bodies[body_slot];
  shape.body = body_slot;
  shape.next = body.first_shape;
  shape.flags = kShapeAlive | (part.def->sensor ? kShapeSensor : 0u);
  shape.category = part.def->filter.category;
  shape.mask = part.def->filter.mask;
  shape.friction = S(part.def->material.friction);
  shape.restitution = S(part.def->material.restitution);
  const S inner = inner_radius(convex);
  // A chain has no thickness of its own, but all the ground behind it.
  shape.reach = convex.chain_segment() ? S(kSpeculativeDistanceMax)
                                       : min_of(S(kSpeculativeDistanceMax), S(kSpeculativeFraction) * inner);
  // What never moves needs no room to move in.
  shape.margin = body.body_type() == BodyType::kStatic
                     ? S(0)
                     : clamp_to(S(kFatMarginFraction) * outer_radius<S>(convex, convex.centroid), S(kFatMarginMin),
                                S(kFatMarginMax));
  body.first_shape = proxy;
  ++body.shape_count;
  if (!part.def->sensor || body.extent_min == S(0))
    body.extent_min = body.extent_min == S(0) ? inner : min_of(body.extent_min, inner);
  body.extent_max = max_of(body.extent_max, outer_radius(convex, body.local_center()));
}

template <class S>
void set_mass(Body<S>& body, const BodyDef& def, const MassProperties& mass) {
  body.local_x = S(mass.center_of_mass.x());
  body.local_y = S(mass.center_of_mass.y());
  if (def.type != BodyType::kDynamic) return;
  body.mass = S(mass.mass);
  body.inv_mass = S(1.0 / mass.mass);
  body.inertia = S(mass.inertia);
  body.inv_inertia = def.fixed_rotation ? S(0) : S(1.0 / mass.inertia);
}

template <class S>
void set_pose(Body<S>& body, const BodyDef& def) {
  body.angle = wrap_angle(S(def.angle));
  sin_cos(body.angle, body.s, body.c);
  const Vec<S> center = def.position.cast<S>() + body.rotation().apply(body.local_center());
  body.x = center.x();
  body.y = center.y();
}

template <class S>
std::uint32_t take_body_slot(WorldData<S>& world) {
  if (!world.free_bodies.empty()) {
    const std::uint32_t slot = world.free_bodies.back();
    world.free_bodies.pop_back();
    return slot;
  }
  world.bodies.emplace_back();
  world.motions.emplace_back();
  return static_cast<std::uint32_t>(world.bodies.size() - 1);
}

void add(std::uint32_t& count, bool condition, int sign) {
  if (condition) count += static_cast<std::uint32_t>(sign);
}

}  // namespace

template <class S>
void count_needs(WorldData<S>& world, std::uint32_t slot, int sign) {
  Needs& needs = world.needs;
  const Body<S>& body = world.bodies[slot];
  add(needs.bodies, true, sign);
  add(needs.dynamic_bodies, body.dynamic(), sign);
  add(needs.rotating_bodies, body.dynamic() && body.inv_inertia > S(0), sign);
  add(needs.damped_bodies, body.linear_damping > S(0) || body.angular_damping > S(0), sign);
  for (Proxy p = body.first_shape; p != kNone; p = world.shapes[p].next) {
    const Shape<S>& shape = world.shapes[p];
    add(needs.shapes, true, sign);
    add(needs.circles, shape.shape_kind() == ShapeKind::kCircle, sign);
    add(needs.boxes, shape.shape_kind() == ShapeKind::kBox, sign);
    add(needs.polygons, shape.shape_kind() == ShapeKind::kPolygon, sign);
    add(needs.capsules, shape.shape_kind() == ShapeKind::kCapsule, sign);
    add(needs.chain_segments, shape.shape_kind() == ShapeKind::kChainSegment, sign);
    add(needs.sensors, shape.sensor(), sign);
    add(needs.rough_shapes, shape.friction > S(0), sign);
    add(needs.bouncing_shapes, shape.restitution > S(0), sign);
  }
}

template <class S>
void insert_proxy(WorldData<S>& world, Proxy p) {
  const Body<S>& body = world.bodies[world.shapes[p].body];
  world.broad_phase->insert(p, world.shapes[p].fat, body.body_type() == BodyType::kStatic);
  world.broad_phase->set_resting(p, !body.awake());
}

template <class S>
void update_model(WorldData<S>& world) {
  const BroadPhaseKind before = world.model.broad_phase;
  world.model = choose_model(world.settings, world.needs);
  if (world.broad_phase && before == world.model.broad_phase) return;
  world.broad_phase = BroadPhase<S>::create(world.model.broad_phase);
  world.broad_phase->use(world.team.get());
  for (Proxy p = 0; p < world.shapes.size(); ++p) {
    const Shape<S>& shape = world.shapes[p];
    if (shape.alive()) insert_proxy(world, p);
  }
}

// Once the centre of mass is known.
template <class S>
void note_shortcuts(WorldData<S>& world, std::uint32_t slot) {
  const Body<S>& body = world.bodies[slot];
  for (Proxy p = body.first_shape; p != kNone; p = world.shapes[p].next) {
    Shape<S>& shape = world.shapes[p];
    const Convex<S>& convex = world.convexes[p];
    if (convex.centroid == body.local_center()) shape.flags |= kShapeCentred;
    const Vec<S>& right = convex.normals[1];
    if (shape.shape_kind() == ShapeKind::kBox && right.x() == S(1) && right.y() == S(0)) shape.flags |= kShapeUpright;
  }
}

template <class S>
std::uint32_t create_body(WorldData<S>& world, const BodyDef& def) {
  const std::vector<Part> parts = convex_parts(def);
  const std::uint32_t slot = take_body_slot(world);
  Body<S>& body = world.bodies[slot];
  const std::uint32_t generation = body.generation;
  body = Body<S>{};
  world.motions[slot] = Motion<S>{};
  body.generation = generation;
  body.type = static_cast<std::uint32_t>(def.type);
  body.flags = kBodyAlive | (def.fixed_rotation ? kBodyFixedRotation : 0u);
  body.linear_damping = S(def.linear_damping);
  body.angular_damping = S(def.angular_damping);
  body.gravity_scale = S(def.gravity_scale);
  set_mass(body, def, mass_of(def, parts));
  set_pose(body, def);
  if (def.type != BodyType::kStatic) {
    world.motions[slot].vx = S(def.velocity.x());
    world.motions[slot].vy = S(def.velocity.y());
    world.motions[slot].w = def.fixed_rotation ? S(0) : S(def.angular_velocity);
  }
  for (const Part& part : parts) create_shape(world, slot, part);
  count_needs(world, slot, +1);
  const bool moving = def.velocity != Vec2(0, 0) || def.angular_velocity != 0;
  if (def.type == BodyType::kKinematic ? moving : def.awake) wake_body(world, slot);
  note_shortcuts(world, slot);
  refresh_places(world, slot);
  for (Proxy p = body.first_shape; p != kNone; p = world.shapes[p].next) {
    Shape<S>& shape = world.shapes[p];
    shape.fat = swept_bounds(world, p).expanded(shape.reach + shape.margin);
    if (world.broad_phase) insert_proxy(world, p);
    mark_moved(world, p);
  }
  update_model(world);
  return slot;
}

template <class S>
void destroy_body(WorldData<S>& world, std::uint32_t slot) {
  Body<S>& body = world.bodies[slot];
  wake_neighbours(world, slot);
  while (body.first_joint != kNoJoint) destroy_joint(world, (body.first_joint - 1) >> 1);
  while (body.first_contact != kNone) destroy_contact(world, body.first_contact >> 1);
  put_to_sleep(world, slot);
  count_needs(world, slot, -1);
  std::vector<Proxy>& moved = world.moved;
  for (Proxy p = body.first_shape; p != kNone;) {
    Shape<S>& shape = world.shapes[p];
    const Proxy next = shape.next;
    if (shape.flags & kShapeMoved) std::erase(moved, p);
    world.broad_phase->remove(p);
    shape = Shape<S>{};
    world.convexes[p] = Convex<S>{};
    world.free_shapes.push_back(p);
    p = next;
  }
  const std::uint32_t generation = body.generation + 1;
  body = Body<S>{};
  body.generation = generation;
  world.motions[slot] = Motion<S>{};
  world.free_bodies.push_back(slot);
  update_model(world);
}

#define URTO_INSTANTIATE(S)                                          \
  template std::uint32_t create_body(WorldData<S>&, const BodyDef&); \
  template void destroy_body(WorldData<S>&, std::uint32_t);          \
  template void count_needs(WorldData<S>&, std::uint32_t, int);      \
  template void update_model(WorldData<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

#include "physics/solver/constraint.h"

#include "physics/constants.h"

namespace urto {
namespace {

constexpr std::uint32_t kMovableColors = kColorsMax / 2;  // the other half is for contacts with unmovable bodies

// A colour that neither body has yet; the last of its kind when all are taken.
std::uint32_t first_free(std::uint64_t taken, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t c = begin; c + 1 < end; ++c)
    if (!(taken >> c & 1u)) return c;
  return end - 1;
}

template <class S>
std::uint32_t color_of(WorldData<S>& world, const Contact<S>& c) {
  std::vector<std::uint64_t>& taken = world.scratch.colors;
  const bool movable_a = world.bodies[c.body_a].inv_mass > S(0), movable_b = world.bodies[c.body_b].inv_mass > S(0);
  const std::uint64_t both = (movable_a ? taken[c.body_a] : 0) | (movable_b ? taken[c.body_b] : 0);
  const std::uint32_t color =
      movable_a && movable_b ? first_free(both, 0, kMovableColors) : first_free(both, kMovableColors, kColorsMax);
  if (movable_a) taken[c.body_a] |= 1ull << color;
  if (movable_b) taken[c.body_b] |= 1ull << color;
  return color;
}

// Counting sort by colour: stable, so that within a colour the order of the active list stays.
template <class S>
void sort_by_color(WorldData<S>& world, ConstraintSet<S>& set) {
  world.scratch.colors.assign(world.bodies.size(), 0);
  set.touching.clear();
  set.colors.clear();
  set.color_begin.assign(kColorsMax + 1, 0);
  for (std::uint32_t slot : world.active) {
    const Contact<S>& c = world.contacts[slot];
    if (c.count == 0 || c.sensor()) continue;
    const std::uint32_t color = color_of(world, c);
    set.touching.push_back(slot);
    set.colors.push_back(static_cast<std::uint8_t>(color));
    ++set.color_begin[color + 1];
  }
  for (std::uint32_t c = 0; c < kColorsMax; ++c) set.color_begin[c + 1] += set.color_begin[c];
  set.contacts.resize(set.touching.size());
  std::uint32_t next[kColorsMax];
  for (std::uint32_t c = 0; c < kColorsMax; ++c) next[c] = set.color_begin[c];
  for (std::size_t i = 0; i < set.touching.size(); ++i) set.contacts[next[set.colors[i]]++].contact = set.touching[i];
}

// A damped spring of frequency f and damping ratio ζ as a soft constraint, integrated implicitly (Catto, "Soft
// Constraints", GDC 2011). Ours differs: the spring answers to what the point carries beyond its preload P, a slow
// average of its impulse,  v + bias_rate · s = −compliance · k · (λ − P).  A plain spring has to be compressed to carry
// what lies on it, and a stack of N boxes sinks by N² of that; with the preload it carries its load uncompressed in the
// end, and still yields to sudden change. (The multiplier of an augmented Lagrangian, updated slowly enough that the
// update does not race the solver's own convergence up the stack: kPreloadTime.)
template <class S>
struct Softness {
  S bias_rate;   // ω / (2ζ + hω)
  S compliance;  // 1 / (hω (2ζ + hω))
  Softness(S hertz, S damping_ratio, S h) {
    const S omega = S(2 * 3.14159265358979323846) * hertz;
    bias_rate = omega / (S(2) * damping_ratio + h * omega);
    compliance = S(1) / (h * omega * (S(2) * damping_ratio + h * omega));
  }
};

template <class S>
void prepare_point(ConstraintPoint<S>& p, const ManifoldPoint<S>& mp, const ContactConstraint<S>& k,
                   const Motion<S>& ma, const Motion<S>& mb) {
  p.ax = mp.ax;
  p.ay = mp.ay;
  p.bx = mp.bx;
  p.by = mp.by;
  p.separation = mp.separation;
  p.normal_impulse = mp.normal_impulse;
  p.tangent_impulse = mp.tangent_impulse;
  p.preload = mp.preload;
  p.total_normal_impulse = p.total_tangent_impulse = S(0);
  const S tx = k.ny, ty = -k.nx;
  const S rna = p.ax * k.ny - p.ay * k.nx, rnb = p.bx * k.ny - p.by * k.nx;
  const S rta = p.ax * ty - p.ay * tx, rtb = p.bx * ty - p.by * tx;
  const S kn = k.inv_mass_a + k.inv_mass_b + k.inv_inertia_a * rna * rna + k.inv_inertia_b * rnb * rnb;
  const S kt = k.inv_mass_a + k.inv_mass_b + k.inv_inertia_a * rta * rta + k.inv_inertia_b * rtb * rtb;
  p.inverse_mass = kn;
  p.tangent_mass = kt > S(0) ? S(1) / kt : S(0);
  const S dvx = (mb.vx - mb.w * p.by) - (ma.vx - ma.w * p.ay);
  const S dvy = (mb.vy + mb.w * p.bx) - (ma.vy + ma.w * p.ax);
  p.approach = dvx * k.nx + dvy * k.ny;
}

template <class S>
void prepare_contact(const WorldData<S>& world, ContactConstraint<S>& k, const Softness<S>& soft) {
  const Contact<S>& c = world.contacts[k.contact];
  const Body<S>&a = world.bodies[c.body_a], &b = world.bodies[c.body_b];
  k.a = c.body_a;
  k.b = c.body_b;
  k.count = static_cast<int>(c.count);
  k.nx = c.nx;
  k.ny = c.ny;
  k.friction = c.friction;
  k.restitution = c.restitution;
  k.inv_mass_a = a.inv_mass;
  k.inv_mass_b = b.inv_mass;
  k.inv_inertia_a = a.inv_inertia;
  k.inv_inertia_b = b.inv_inertia;
  const S inv_masses = a.inv_mass + b.inv_mass;
  k.share_a = inv_masses > S(0) ? b.inv_mass / inv_masses : S(0);
  k.bias_rate = soft.bias_rate;
  k.compliance = soft.compliance;
  for (int i = 0; i < k.count; ++i) prepare_point(k.points[i], c.points[i], k, world.motions[k.a], world.motions[k.b]);
  if (k.count < 2) return;
  const ConstraintPoint<S>&p = k.points[0], &q = k.points[1];
  const S pa = p.ax * k.ny - p.ay * k.nx, pb = p.bx * k.ny - p.by * k.nx;
  const S qa = q.ax * k.ny - q.ay * k.nx, qb = q.bx * k.ny - q.by * k.nx;
  k.coupling = inv_masses + k.inv_inertia_a * pa * qa + k.inv_inertia_b * pb * qb;
}

}  // namespace

template <class S>
void prepare_contacts(WorldData<S>& world, ConstraintSet<S>& set, S h) {
  sort_by_color(world, set);
  const S hertz = min_of(S(kContactHertz), S(kContactHertzPerSubStepRate) / h);
  const Softness<S> soft(hertz, S(kContactDampingRatio), h);
  for (ContactConstraint<S>& k : set.contacts) prepare_contact(world, k, soft);
}

template <class S>
void store_impulses(WorldData<S>& world, const ConstraintSet<S>& set) {
  for (const ContactConstraint<S>& k : set.contacts) {
    Contact<S>& c = world.contacts[k.contact];
    for (int i = 0; i < k.count; ++i) {
      c.points[i].normal_impulse = k.points[i].normal_impulse;
      c.points[i].tangent_impulse = k.points[i].tangent_impulse;
      c.points[i].preload = k.points[i].preload;
      c.points[i].total_normal_impulse = k.points[i].total_normal_impulse;
      c.points[i].total_tangent_impulse = k.points[i].total_tangent_impulse;
    }
  }
}

#define URTO_INSTANTIATE(S)                                            \
  template void prepare_contacts(WorldData<S>&, ConstraintSet<S>&, S); \
  template void store_impulses(WorldData<S>&, const ConstraintSet<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

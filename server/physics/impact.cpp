#include "physics/impact.h"

namespace urto {
namespace {

// Two points of a face affect each other: rounds of pushing one after the other, enough for faces that turn easily.
constexpr int kRounds = 40;

template <class S>
class Point {
 public:
  Point(const Touch<S>& touch, int i, S restitution, const Twist<S>& a, const Twist<S>& b)
      : arm_a_(touch.arms_a[i]),
        arm_b_(touch.arms_b[i]),
        normal_(touch.normal),
        tangent_(touch.normal.y(), -touch.normal.x()) {
    inverse_mass_ = inverse_mass(normal_, a, b);
    inverse_tangent_mass_ = inverse_mass(tangent_, a, b);
    leaving_ = restitution * max_of(S(0), -normal_velocity(a, b));
  }

  S normal_velocity(const Twist<S>& a, const Twist<S>& b) const { return dot<S>(b.at(arm_b_) - a.at(arm_a_), normal_); }

  void push(S friction, Twist<S>& a, Twist<S>& b) {
    const S most = friction * normal_impulse_;
    const S sliding = dot<S>(b.at(arm_b_) - a.at(arm_a_), tangent_);
    const S tangential = clamp_to(tangent_impulse_ - sliding / inverse_tangent_mass_, -most, most);
    apply(tangent_ * (tangential - tangent_impulse_), a, b);
    tangent_impulse_ = tangential;
    const S normal = max_of(S(0), normal_impulse_ + (leaving_ - normal_velocity(a, b)) / inverse_mass_);
    apply(normal_ * (normal - normal_impulse_), a, b);
    normal_impulse_ = normal;
  }

 private:
  // 1/kg, by how much an impulse along the direction changes the velocity between the points.
  S inverse_mass(const Vec<S>& direction, const Twist<S>& a, const Twist<S>& b) const {
    const S lever_a = cross<S>(arm_a_, direction), lever_b = cross<S>(arm_b_, direction);
    return (a.inv_mass + b.inv_mass) + (a.inv_inertia * lever_a * lever_a + b.inv_inertia * lever_b * lever_b);
  }

  void apply(const Vec<S>& impulse, Twist<S>& a, Twist<S>& b) const {
    a.push(arm_a_, -impulse);
    b.push(arm_b_, impulse);
  }

  Vec<S> arm_a_, arm_b_, normal_, tangent_;
  S inverse_mass_, inverse_tangent_mass_, leaving_;
  S normal_impulse_ = 0, tangent_impulse_ = 0;
};

}  // namespace

template <class S>
S normal_velocity(const Touch<S>& touch, const Twist<S>& a, const Twist<S>& b) {
  S least = 0;
  for (int i = 0; i < touch.count; ++i) {
    const S v = dot<S>(b.at(touch.arms_b[i]) - a.at(touch.arms_a[i]), touch.normal);
    least = i == 0 ? v : min_of(least, v);
  }
  return least;
}

template <class S>
S collide_at(const Touch<S>& touch, S restitution, S friction, Twist<S>& a, Twist<S>& b) {
  const S closing = max_of(S(0), -normal_velocity(touch, a, b));
  Point<S> first(touch, 0, restitution, a, b), second(touch, touch.count - 1, restitution, a, b);
  for (int round = 0; round < kRounds; ++round) {
    first.push(friction, a, b);
    if (touch.count == 2) second.push(friction, a, b);
  }
  return closing;
}

#define URTO_INSTANTIATE(S)                                                      \
  template S normal_velocity(const Touch<S>&, const Twist<S>&, const Twist<S>&); \
  template S collide_at(const Touch<S>&, S restitution, S friction, Twist<S>&, Twist<S>&);
URTO_INSTANTIATE(float)
URTO_INSTANTIATE(double)
#undef URTO_INSTANTIATE

}  // namespace urto

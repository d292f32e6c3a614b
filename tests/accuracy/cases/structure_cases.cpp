// Structures that stand by friction and thrust alone: arches and houses of cards.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "accuracy/case.h"

namespace urto::accuracy {
namespace {

// ---- The arch ----

constexpr int kVoussoirs = 11;
constexpr double kRadius = 5;        // m, of the middle line
constexpr double kArchFriction = 5;  // so that it hinges and never slides

// A semicircle of equal wedges on a floor. `thickness` is a share of the radius.
//
//        ___
//      /  _  \       t: from inner to outer edge
//     / /   \ \      R: to the middle line
//    |_|     |_|
Scene arch_of(double thickness) {
  Scene scene;
  scene.add(with_friction(floor_of(100), kArchFriction));
  const double inner = kRadius * (1 - thickness / 2), outer = kRadius * (1 + thickness / 2);
  const auto at = [](double radius, int joint) {
    const double angle = kPi * joint / kVoussoirs;
    // The joints of the springings lie on the floor exactly.
    const double y = joint == 0 || joint == kVoussoirs ? 0 : std::sin(angle);
    return Vec2(radius * std::cos(angle), radius * y);
  };
  for (int i = 0; i < kVoussoirs; ++i) {
    const Vec2 corners[] = {at(inner, i), at(outer, i), at(outer, i + 1), at(inner, i + 1)};
    const Vec2 middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
    std::vector<Vec2> vertices;
    for (const Vec2& corner : corners) vertices.push_back(corner - middle);
    scene.add(with_friction(polygon_at(middle, vertices), kArchFriction));
  }
  return scene;
}

double moved_max(const Run& run) {
  double worst = 0;
  for (std::size_t i = 1; i < run.bodies().size(); ++i)
    worst = std::max(worst, (run.body(i).position - run.bodies()[i].position).norm());
  return worst;
}

double arch_moves(Lab& lab, double thickness) {
  Run run(lab, arch_of(thickness));
  run.seconds(60);
  return moved_max(run) / kRadius;
}

// It must fall: 0 if a block has come down by a tenth of the radius or more, 1 if it stands.
double arch_stands(Lab& lab, double thickness) { return arch_moves(lab, thickness) > 0.1 ? 0 : 1; }

// ---- Cards ----

constexpr double kCard = 0.4, kCardThickness = 0.002;  // m

// A card that leans by `lean` from the vertical to the right (negative: to the left); its lowest corner lies at y =
// base and its highest inner corner at x = apex.
BodyDef leaning(double lean, double apex, double base, double friction) {
  BodyDef card = with_friction(box_at({0, 0}, kCardThickness, kCard), friction);
  card.angle = -lean;
  const double side = lean > 0 ? 1 : -1;
  const Vec2 lowest = turned({side * kCardThickness / 2, -kCard / 2}, -lean);
  const Vec2 inner = turned({side * kCardThickness / 2, kCard / 2}, -lean);
  card.position = {apex - inner.x(), base - lowest.y()};
  return card;
}

double height_of_pair(double lean) {
  const double low = turned({kCardThickness / 2, -kCard / 2}, -lean).y();
  const double high = turned({-kCardThickness / 2, kCard / 2}, -lean).y();
  return high - low;
}

constexpr double kLean = 25;  // degrees

// Two cards of weight w lean on each other at φ: each foot carries w and holds ½ w tan φ. Where they meet is corner on
// corner, whose normal may be any between the two cards' own; rough cards hold the thrust whichever it is, and
// `friction` is that of the feet (mixed by the geometric mean).
bool pair_stands(Lab& lab, double friction) {
  Scene scene;
  constexpr double kCardFriction = 1;
  scene.add(with_friction(floor_of(10), friction * friction / kCardFriction));
  scene.add(leaning(degrees(kLean), 0, 0, kCardFriction));
  scene.add(leaning(-degrees(kLean), 0, 0, kCardFriction));
  Run run(lab, scene);
  run.seconds(10);
  return run.body(1).position.y() > 0.9 * scene.bodies[1].position.y();
}

double pair_threshold(Lab& lab) {
  const double exact = 0.5 * std::tan(degrees(kLean));
  double low = 0.5 * exact, high = 2 * exact;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    (pair_stands(lab, middle) ? high : low) = middle;
  }
  return std::abs(0.5 * (low + high) / exact - 1);
}

// Where cards stand: a point of a surface, and the way that leads to the right.
struct Base {
  Vec2 at, right;
  Vec2 up() const { return {-right.y(), right.x()}; }
  Vec2 along(double way) const { return at + right * way; }
  double angle() const { return std::atan2(right.y(), right.x()); }
};

// Two cards that lean on each other. Where they meet.
Vec2 add_pair(Scene& scene, const Base& base, double friction) {
  for (const double lean : {degrees(kLean), -degrees(kLean)}) {
    BodyDef card = leaning(lean, 0, 0, friction);
    card.position = base.at + turned(card.position, base.angle());
    card.angle += base.angle();
    scene.add(card);
  }
  return base.at + base.up() * height_of_pair(degrees(kLean));
}

// A card that lies on two points and reaches beyond the right one by `overhang`. Its upper side, seen from its middle.
Base add_flat(Scene& scene, const Vec2& left, const Vec2& right, double overhang, double friction) {
  Base under{right, (right - left).normalized()};
  under.at = under.along(overhang - kCard / 2);
  BodyDef card = with_friction(box_at(under.at + under.up() * (kCardThickness / 2), kCard, kCardThickness), friction);
  card.angle = under.angle();
  scene.add(card);
  return {under.at + under.up() * kCardThickness, under.right};
}

// Three pairs below, two in the middle, one on top, and a card across the tips of two pairs each. Cards that share a
// tip lie one on the other's end, so the pairs above stand beside that end. All touch, and none overlap.
Scene house_of_cards(double friction) {
  constexpr double kPitch = 0.35;  // m, between tips
  constexpr double kOverhang = (kCard - kPitch) / 2;
  Scene scene;
  scene.add(with_friction(floor_of(10), friction));
  std::vector<Base> bases;
  for (int i = -1; i <= 1; ++i) bases.push_back({{i * kPitch, 0}, {1, 0}});
  while (!bases.empty()) {
    std::vector<Vec2> tips;
    for (const Base& base : bases) tips.push_back(add_pair(scene, base, friction));
    bases.clear();
    for (std::size_t i = 0; i + 1 < tips.size(); ++i) {
      const Vec2 left = i == 0 ? tips[0] : bases.back().along(kOverhang + kCard / 2);
      bases.push_back(add_flat(scene, left, tips[i + 1], kOverhang, friction));
      bases.back().at = bases.back().along(-kOverhang);
    }
  }
  return scene;
}

double house_moves(Lab& lab) {
  Run run(lab, house_of_cards(0.7));
  run.seconds(60);
  return moved_max(run);
}

}  // namespace

void add_structure_cases(std::vector<Case>& cases) {
  cases.push_back({27,
                   "arch_stands_150",
                   "an arch of 11 voussoirs, t/R = 0.15, 60 s",
                   "farthest that a block moves, /R",
                   "",
                   {{Profile::kDefault, 0.02}},
                   [](Lab& lab) { return arch_moves(lab, 0.15); }});
  cases.push_back({27,
                   "arch_stands_115",
                   "the same with t/R = 0.115; it falls below 0.1075",
                   "farthest that a block moves, /R",
                   "",
                   {{Profile::kPrecise, 0.02}},
                   [](Lab& lab) { return arch_moves(lab, 0.115); }});
  cases.push_back({27,
                   "arch_falls_100",
                   "the same with t/R = 0.100: it must fall",
                   "1 if it stands",
                   "",
                   {{Profile::kPrecise, 0}},
                   [](Lab& lab) { return arch_stands(lab, 0.100); }});
  cases.push_back({28,
                   "card_pair",
                   "two cards lean at 25°: they stand iff μ ≥ ½ tan φ",
                   "error of the least μ",
                   "relative",
                   {{Profile::kPrecise, 0.02}},
                   pair_threshold});
  cases.push_back({28,
                   "card_house",
                   "a house of cards of 3 levels, μ = 0.7, 60 s",
                   "farthest that a card moves",
                   "m",
                   {{Profile::kDefault, 0.02}, {Profile::kPrecise, 0.02}},
                   house_moves});
}

}  // namespace urto::accuracy

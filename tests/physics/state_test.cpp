#include "physics/state.h"

#include <random>
#include <set>

#include "physics/support/scenes.h"
#include "physics/world_of.h"

namespace urto {
namespace {

using namespace testing;

// A bit of everything: stacks, circles, polygons, a kinematic body, a sensor, removed bodies, forces.
template <class S>
void fill(World& world) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-5, 5);
  add(world, floor_body());
  add_stack(world, 4);
  for (int i = 0; i < 20; ++i) {
    BodyDef def = i % 3 == 0 ? ball_body(place(random), 5 + i, 0.3) : box_body(place(random), 5 + i, 0.6, 0.4);
    if (i % 5 == 0) def.shapes[0].geometry = Polygon{{{-0.5, -0.3}, {0.5, -0.3}, {0, 0.6}}};
    def.angle = place(random);
    def.shapes[0].material.restitution = 0.3;
    add(world, def);
  }
  BodyDef mover = box_body(-8, 1, 1, 1, BodyType::kKinematic);
  mover.velocity = {0.5, 0};
  add(world, mover);
  const BodyId gone = add(world, box_body(0, 40));
  const BodyId pushed = add(world, box_body(3, 30));
  EXPECT_TRUE(world.set_force(pushed, {1, 2}, 0.1, true));
  EXPECT_TRUE(world.remove_body(gone));
}

template <class S>
class StateTest : public ::testing::Test {
 protected:
  StateTest() {
    settings_.precision = sizeof(S) == 4 ? Precision::kFloat : Precision::kDouble;
    settings_.fields.push_back(Drag{0.01, 0});
    world_ = make_world(settings_);
    fill<S>(*world_);
    for (int i = 0; i < 90; ++i) world_->step();
  }
  WorldSettings settings_;
  std::unique_ptr<World> world_;
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(StateTest, Scalars);

TYPED_TEST(StateTest, SteppingOnAfterRestoreGivesTheSameBits) {
  const auto saved = this->world_->save();
  auto other = make_world(settings_for(this->settings_.precision));
  ASSERT_TRUE(other->restore(saved));
  EXPECT_EQ(other->save(), saved);
  for (int i = 0; i < 400; ++i) {
    this->world_->step();
    other->step();
    ASSERT_EQ(this->world_->state_hash(), other->state_hash()) << "step " << i;
  }
}

TYPED_TEST(StateTest, CommandsAfterRestoreGiveTheSameBits) {
  auto other = make_world(settings_for(this->settings_.precision));
  ASSERT_TRUE(other->restore(this->world_->save()));
  for (World* world : {this->world_.get(), other.get()}) {
    const BodyId id = add(*world, ball_body(0, 20));
    ASSERT_TRUE(world->remove_body(3));
    ASSERT_TRUE(world->apply_impulse(id, {1, 2}, {0.1, 20}));
    for (int i = 0; i < 100; ++i) world->step();
  }
  EXPECT_EQ(this->world_->state_hash(), other->state_hash());
}

// Changes one byte of each field in turn.
TYPED_TEST(StateTest, EveryFieldReachesTheHash) {
  using S = TypeParam;
  auto& data = dynamic_cast<WorldOf<S>&>(*this->world_).data();
  const std::uint64_t before = this->world_->state_hash();
  // As after a restore: the records hold the manifolds, and the lanes do not yet.
  std::vector<Contact<S>> contacts;
  for (std::uint32_t slot = 0; slot < data.contacts.size(); ++slot) contacts.push_back(settled(data, slot));
  data.contacts = contacts;
  data.touching.current = false;
  ASSERT_EQ(this->world_->state_hash(), before);
  std::set<std::string> empty;
  WorldData<S>::for_each_state_field(data, [&](const char* name, auto& field) {
    unsigned char* bytes;
    std::size_t count;
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(field)>>) {
      bytes = reinterpret_cast<unsigned char*>(&field);
      count = sizeof field;
    } else {
      bytes = reinterpret_cast<unsigned char*>(field.data());
      // Every byte of the first record, so that each of its members is met; other records are alike.
      count = field.empty() ? 0 : sizeof field[0];
    }
    if (count == 0) empty.insert(name);
    for (std::size_t i = 0; i < count; ++i) {
      bytes[i] ^= 1;
      EXPECT_NE(this->world_->state_hash(), before) << name << ", byte " << i;
      bytes[i] ^= 1;
    }
  });
  EXPECT_EQ(this->world_->state_hash(), before);
  // Whatever list is empty in this scene is still counted: growing it moves the hash.
  for (const std::string& name : empty)
    EXPECT_TRUE(name == "free_contacts" || name == "moved" || name == "free_shapes" || name == "active") << name;
}

TYPED_TEST(StateTest, SettingsReachTheHash) {
  auto& data = dynamic_cast<WorldOf<TypeParam>&>(*this->world_).data();
  const std::uint64_t before = this->world_->state_hash();
  data.settings.gravity.x() += 1;
  EXPECT_NE(this->world_->state_hash(), before);
  data.settings.gravity.x() -= 1;
  data.settings.restitution_mixing = Mixing::kMinimum;
  EXPECT_NE(this->world_->state_hash(), before);
  data.settings.restitution_mixing = Mixing::kMaximum;
  data.settings.fields.clear();
  EXPECT_NE(this->world_->state_hash(), before);
}

TYPED_TEST(StateTest, DamageIsFoundAndTheWorldIsUnchanged) {
  const auto saved = this->world_->save();
  const std::uint64_t before = this->world_->state_hash();
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    auto damaged = saved;
    damaged[random() % damaged.size()] ^= std::byte(1u << (random() % 8));
    const Status status = this->world_->restore(damaged);
    ASSERT_FALSE(status.has_value());
    EXPECT_EQ(status.error().code, ErrorCode::kCorruptState);
  }
  for (std::size_t size : {std::size_t{0}, std::size_t{8}, saved.size() - 1}) {
    EXPECT_FALSE(this->world_->restore(std::span(saved).first(size)));
  }
  EXPECT_EQ(this->world_->state_hash(), before);
}

TEST(StateTest, OtherPrecisionIsRefused) {
  auto single = make_world(settings_for(Precision::kFloat)), twice = make_world(settings_for(Precision::kDouble));
  EXPECT_EQ(twice->restore(single->save()).error().code, ErrorCode::kCorruptState);
}

TEST(StateTest, EmptyWorldSavesAndRestores) {
  auto a = make_world(), b = make_world();
  a->step();
  ASSERT_TRUE(b->restore(a->save()));
  EXPECT_EQ(a->state_hash(), b->state_hash());
  EXPECT_EQ(b->step_count(), 1u);
}

}  // namespace
}  // namespace urto

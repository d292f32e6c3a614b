// Batches of random commands with values from the middle, the edges and beyond of every range, against the real engine.
// Whatever is rejected has changed nothing, and what admission lets pass the engine accepts.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/room_driver.h"

namespace urto {
namespace {

using testing::RoomDriver;

class RandomCommands {
 public:
  explicit RandomCommands(std::uint64_t seed) : random_(seed) {}

  std::vector<Command> batch() {
    std::vector<Command> commands(1 + pick(4), Command{});
    for (Command& each : commands) each = command();
    return commands;
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }

  // Mostly harmless, so that most batches get far before something is wrong with them.
  double number() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    static const std::vector<double> kOdd{0,   -0.0, 1e-300, 1e-5,      1e5,  1e6,       -1e6,
                                          1e7, -1e7, 1e9,    kForceMax, 1e16, kInfinity, std::nan("")};
    if (pick(12) == 0) return kOdd[pick(kOdd.size())];
    return std::uniform_real_distribution<double>(-20, 20)(random_);
  }

  Vec2 vector() {
    const double x = number();
    return {x, number()};
  }

  template <class T>
  std::optional<T> maybe(T value) {
    if (pick(2) == 0) return std::nullopt;
    return value;
  }

  BodyRef body() {
    static const std::vector<std::string> kNames{"box", "floor", "a", "b", "c", "nobody"};
    if (pick(4) == 0) return BodyId{1 + pick(6)};
    return kNames[pick(pick(8) == 0 ? 6 : 5)];
  }

  BodySpec spec() {
    static const std::vector<std::string> kNames{"", "a", "b", "c"};
    BodySpec spec = testing::box_body(kNames[pick(4)], vector(), static_cast<BodyType>(pick(3)),
                                      std::abs(number()) + 1e-3, std::abs(number()) + 1e-3);
    if (pick(3) == 0) spec.def.shapes[0].geometry = Circle{std::abs(number()), {0, 0}};
    if (pick(3) == 0) spec.def.shapes[0].geometry = Polygon{{vector(), vector(), vector(), vector()}};
    if (pick(6) == 0) spec.def.mass = number();
    if (spec.def.type != BodyType::kStatic) spec.def.velocity = vector();
    return spec;
  }

  QueryShape shape() {
    QueryShape shape{PointGeometry{}, vector(), number()};
    if (pick(3) == 0) shape.geometry = Circle{std::abs(number()), {0, 0}};
    if (pick(3) == 0) shape.geometry = Box{std::abs(number()), std::abs(number()), vector(), number()};
    if (pick(3) == 0) shape.geometry = Polygon{{vector(), vector(), vector()}, 0};
    return shape;
  }

  QueryOptions options() {
    QueryOptions options;
    if (pick(2) == 0) options.filter = Filter{static_cast<std::uint32_t>(pick(4)), static_cast<std::uint32_t>(pick(4))};
    options.count_max = static_cast<std::uint32_t>(pick(4));
    return options;
  }

  Command command() {
    switch (pick(16)) {
      case 0:
      case 1:
        return Spawn{spec()};
      case 2:
        return Despawn{body()};
      case 3:
      case 4:
        return Impulse{body(), vector(), maybe(vector()), pick(2) == 0, number()};
      case 5:
        return Force{body(), vector(), number(), pick(2) == 0, maybe(std::abs(number()))};
      case 6:
        return SetVelocity{body(), maybe(vector()), maybe(number())};
      case 7:
        return SetTransform{body(), maybe(vector()), maybe(number())};
      case 8:
        return RoomQuery(PointQuery{vector()});
      case 9:
        return RoomQuery(RegionQuery{vector(), vector()});
      case 10:
        return RoomQuery(RayQuery{vector(), vector()});
      case 11:
        return RoomQuery(NearestQuery{vector(), std::abs(number()), static_cast<std::uint32_t>(pick(3))});
      case 12:
        return RoomQuery(BodyQuery{body()});
      case 13:
        return RoomQuery(CastQuery{shape(), vector(), options()});
      case 14:
        return pick(2) == 0 ? RoomQuery(OverlapQuery{shape(), options()})
                            : RoomQuery(ClosestQuery{shape(), std::abs(number()), options()});
      default:
        return pick(20) == 0 ? Command(Reset{}) : Command(RoomQuery(ContactsQuery{}));
    }
  }

  std::mt19937_64 random_;
};

TEST(RandomBatches, AreDoneWhollyOrNotAtAll) {
  const std::uint64_t seed = 20261122;
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomCommands commands(seed);
  RoomDriver driver(testing::paused_settings());
  int done = 0, rejected = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::uint64_t hash = driver.room->world().state_hash();
    const std::vector<Command> batch = commands.batch();
    const BatchReply reply = driver.ask(batch);
    if (!reply.rejection) {
      ++done;
      ASSERT_EQ(reply.results.size(), batch.size());
    } else {
      ++rejected;
      ASSERT_EQ(reply.rejection->message.find("The engine refused"), std::string::npos)
          << "batch " << i << ", command " << reply.rejection->index << ": " << reply.rejection->field << " = "
          << reply.rejection->value << ": " << reply.rejection->message;
      ASSERT_EQ(driver.room->world().state_hash(), hash) << "batch " << i;
    }
    if (i % 10 == 0) {
      driver.send({Step{1}});
      driver.tick();
    }
    driver.answers.clear();
    driver.events.clear();
  }
  EXPECT_GT(done, 500);
  EXPECT_GT(rejected, 500);
}

}  // namespace
}  // namespace urto

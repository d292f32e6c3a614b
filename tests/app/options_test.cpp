#include "app/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace urto::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

tl::expected<Options, Exit> parsed(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "urtod");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

TEST(Options, DefaultsAreThisMachineAlone) {
  const auto options = parsed({"--scene", "a.txtpb"});
  ASSERT_TRUE(options) << options.error().text;
  EXPECT_EQ(options->scene_file, "a.txtpb");
  EXPECT_THAT(options->listen, ElementsAre("tcp/127.0.0.1:7447"));
  EXPECT_THAT(options->connect, IsEmpty());
  EXPECT_EQ(options->control, Control::kEveryone);
  EXPECT_EQ(options->snapshot_rate_hz, 60);
  EXPECT_FALSE(options->paused);
}

TEST(Options, AllOfThem) {
  const auto options = parsed({"--scene",      "a",       "--room",          "lab",    "--listen", "0.0.0.0:1",
                               "--listen",     "tls/h:2", "--control",       "owners", "--owner",  "ann",
                               "--owner",      "bob",     "--snapshot-rate", "20",     "--paused", "--publish-hash",
                               "--time-scale", "0.5",     "--log-level",     "debug",  "--users",  "u.txt",
                               "--threads",    "2"});
  ASSERT_TRUE(options) << options.error().text;
  EXPECT_EQ(options->room, "lab");
  EXPECT_THAT(options->listen, ElementsAre("tcp/0.0.0.0:1", "tls/h:2"));
  EXPECT_EQ(options->control, Control::kOwners);
  EXPECT_THAT(options->owners, ElementsAre("ann", "bob"));
  EXPECT_EQ(options->snapshot_rate_hz, 20);
  EXPECT_TRUE(options->paused);
  EXPECT_TRUE(options->publish_hash);
  EXPECT_EQ(options->time_scale, 0.5);
  EXPECT_EQ(options->threads, 2u);
  EXPECT_EQ(options->log_level, "debug");
  EXPECT_EQ(options->users_file, "u.txt");
}

TEST(Options, RouterTakesThePlaceOfTheEndpoint) {
  EXPECT_THAT(parsed({"--scene", "a", "--connect", "router:7447"})->listen, IsEmpty());
}

TEST(Options, WrongOnesExitWithTwo) {
  const std::vector<std::pair<std::vector<const char*>, std::string>> cases{
      {{}, "--scene"},
      {{"--scene", "a", "--room", "my room"}, "my room"},
      {{"--scene", "a", "--listen", "nowhere"}, "nowhere"},
      {{"--scene", "a", "--control", "some"}, "some"},
      {{"--scene", "a", "--control", "owners"}, "--owner"},
      {{"--scene", "a", "--owner", "ann"}, "--control"},
      {{"--scene", "a", "--snapshot-rate", "0"}, "--snapshot-rate"},
      {{"--scene", "a", "--time-scale", "1000"}, "--time-scale"},
      {{"--scene", "a", "--threads", "0"}, "--threads"},
      {{"--scene", "a", "--threads", "65"}, "--threads"},
      {{"--scene", "a", "--users", "f", "--connect", "h:1"}, "exclude"},
      {{"--scene", "a", "--magic"}, "--magic"},
  };
  for (const auto& [arguments, said] : cases) {
    const auto options = parsed(arguments);
    ASSERT_FALSE(options) << said;
    EXPECT_EQ(options.error().code, kExitUsage);
    EXPECT_THAT(options.error().text, HasSubstr(said));
  }
}

TEST(Options, HelpAndVersionExitWithZero) {
  EXPECT_EQ(parsed({"--help"}).error().code, 0);
  EXPECT_THAT(parsed({"--help"}).error().text, HasSubstr("--snapshot-rate"));
  EXPECT_THAT(parsed({"--version"}).error().text, HasSubstr("urtod 0."));
}

}  // namespace
}  // namespace urto::app

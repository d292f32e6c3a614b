#include "app/keys.h"

#include <gtest/gtest.h>

namespace urto::app {
namespace {

TEST(Keys, AreThoseOfTheProtocol) {
  const Keys keys("lab");
  EXPECT_EQ(keys.alive, "urto/v1/lab/alive");
  EXPECT_EQ(keys.info, "urto/v1/lab/info");
  EXPECT_EQ(keys.state, "urto/v1/lab/state");
  EXPECT_EQ(keys.snapshot, "urto/v1/lab/snapshot");
  EXPECT_EQ(keys.event, "urto/v1/lab/event");
  EXPECT_EQ(keys.all_commands, "urto/v1/lab/cmd/*");
  EXPECT_EQ(keys.all_members, "urto/v1/lab/member/*/*");
}

TEST(Keys, UserOfACommandIsTheLastPart) {
  EXPECT_EQ(user_of_command_key("urto/v1/lab/cmd/ann_1"), "ann_1");
  EXPECT_FALSE(user_of_command_key("urto/v1/lab/cmd/*"));
  EXPECT_FALSE(user_of_command_key("urto/v1/lab/cmd/" + std::string(65, 'a')));
  EXPECT_FALSE(user_of_command_key("urto/v1/lab/cmd/a b"));
}

TEST(Keys, MemberIsUserAndSession) {
  EXPECT_EQ(member_of_key("urto/v1/lab/member/ann/0af3"), (Member{"ann", "0af3"}));
  EXPECT_FALSE(member_of_key("urto/v1/lab/member/ann/*"));
  EXPECT_FALSE(member_of_key("ann"));
}

TEST(Keys, ParametersAreFoundByName) {
  EXPECT_EQ(parameter("from=12", "from"), "12");
  EXPECT_EQ(parameter("a=b;from=12;c", "from"), "12");
  EXPECT_EQ(parameter("c;from", "from"), "");
  EXPECT_FALSE(parameter("from_here=1", "from"));
  EXPECT_FALSE(parameter("", "from"));
}

}  // namespace
}  // namespace urto::app

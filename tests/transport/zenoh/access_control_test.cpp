#include "transport/zenoh/access_control.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace urto {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class UserDictionary : public testing::Test {
 protected:
  ~UserDictionary() override { std::remove(path_.c_str()); }

  TransportExpected<std::vector<std::string>> read(const std::string& text) {
    std::ofstream(path_) << text;
    return read_users(path_);
  }

  std::string path_ = testing::TempDir() + "urto_dictionary_" + std::to_string(getpid()) + ".txt";
};

TEST_F(UserDictionary, NamesItsUsers) {
  const auto users = read("alice:a\n\n  bob_2 : b:c \r\nCarol-3:d");
  ASSERT_TRUE(users) << users.error().message;
  EXPECT_THAT(*users, ElementsAre("alice", "bob_2", "Carol-3"));
}

TEST_F(UserDictionary, FaultsNameFileAndLineButNoPassword) {
  struct Case {
    const char* text;
    const char* message;
  };
  for (const Case& each : {
           Case{"alice:a\nhunter2\n", ": line 2 is not USER:PASSWORD"},
           Case{":hunter2\n", ": line 1 needs a user name"},
           Case{"al/ice:hunter2\n", ": line 1 needs a user name"},
           Case{"*:hunter2\n", ": line 1 needs a user name"},
           Case{"alice:  \n", ": line 1 has no password"},
           Case{"alice:a\nalice:hunter2\n", ": line 2 names alice again"},
           Case{"\n\n", " names no user"},
       }) {
    const auto users = read(each.text);
    ASSERT_FALSE(users) << each.text;
    EXPECT_EQ(users.error().code, TransportErrorCode::kBadUserDictionary);
    EXPECT_EQ(users.error().subject, path_);
    EXPECT_THAT(users.error().message, HasSubstr(path_ + each.message));
    EXPECT_THAT(users.error().message, Not(HasSubstr("hunter2")));
  }
  EXPECT_TRUE(read(std::string(64, 'a') + ":x"));
  EXPECT_FALSE(read(std::string(65, 'a') + ":x"));
}

TEST_F(UserDictionary, AMissingFileIsNamed) {
  const auto users = read_users(path_ + ".missing");
  ASSERT_FALSE(users);
  EXPECT_EQ(users.error().code, TransportErrorCode::kBadUserDictionary);
  EXPECT_THAT(users.error().message, HasSubstr("cannot be read: No such file"));
}

// A directory opens like a file and fails only when it is read.
TEST_F(UserDictionary, ADirectoryIsRefused) {
  const auto users = read_users(testing::TempDir());
  ASSERT_FALSE(users);
  EXPECT_EQ(users.error().code, TransportErrorCode::kBadUserDictionary);
}

}  // namespace
}  // namespace urto

#include "transport/zenoh/json.h"

#include <gtest/gtest.h>

#include <string>

namespace urto {
namespace {

TEST(Json, StringsAreQuotedAndEscaped) {
  EXPECT_EQ(json_string(""), "\"\"");
  EXPECT_EQ(json_string("a/b é"), "\"a/b é\"");
  EXPECT_EQ(json_string("say \"hi\" \\"), R"("say \"hi\" \\")");
  EXPECT_EQ(json_string(std::string("\n\t\0", 3)), R"("\u000a\u0009\u0000")");
}

TEST(Json, ArraysOfStrings) {
  EXPECT_EQ(json_strings({}), "[]");
  EXPECT_EQ(json_strings({"a"}), "[\"a\"]");
  EXPECT_EQ(json_strings({"a", "\"", "c"}), R"(["a", "\"", "c"])");
}

}  // namespace
}  // namespace urto

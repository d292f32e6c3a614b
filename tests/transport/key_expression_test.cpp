#include "transport/key_expression.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <string_view>

namespace urto {
namespace {

struct IntersectionCase {
  std::string_view a;
  std::string_view b;
  bool expected;
  friend std::ostream& operator<<(std::ostream& out, const IntersectionCase& each) {
    return out << each.a << (each.expected ? " meets " : " misses ") << each.b;
  }
};

class Intersection : public testing::TestWithParam<IntersectionCase> {};

TEST_P(Intersection, IsTheSameBothWays) {
  const auto& [a, b, expected] = GetParam();
  EXPECT_EQ(intersects(a, b), expected) << a << " and " << b;
  EXPECT_EQ(intersects(b, a), expected) << b << " and " << a;
}

INSTANTIATE_TEST_SUITE_P(KeyExpression, Intersection,
                         testing::Values(IntersectionCase{"a/b", "a/b", true}, IntersectionCase{"a/b", "a/c", false},
                                         IntersectionCase{"a/b", "a/b/c", false}, IntersectionCase{"a/*", "a/b", true},
                                         IntersectionCase{"a/*", "a", false}, IntersectionCase{"a/*", "a/b/c", false},
                                         IntersectionCase{"a/*/c", "a/b/*", true},
                                         IntersectionCase{"a/*/c", "a/b/d", false}, IntersectionCase{"a/**", "a", true},
                                         IntersectionCase{"a/**", "a/b/c", true}, IntersectionCase{"a/**", "b", false},
                                         IntersectionCase{"**", "x/y/z", true}, IntersectionCase{"a/**/d", "a/d", true},
                                         IntersectionCase{"a/**/d", "a/b/c/d", true},
                                         IntersectionCase{"a/**/d", "a/b/c", false},
                                         IntersectionCase{"a/**", "**/z", true},
                                         IntersectionCase{"a/**/x", "b/**/x", false},
                                         IntersectionCase{"*/**", "**/b", true}, IntersectionCase{"ab", "a", false}));

TEST(KeyExpression, KeysAndExpressionsAreToldApart) {
  EXPECT_TRUE(check_key("urto/v1/lab/snapshot"));
  EXPECT_TRUE(check_key_expression("urto/v1/*/cmd/*"));
  EXPECT_TRUE(check_key_expression("*/**"));
  ASSERT_FALSE(check_key("urto/v1/*/cmd"));
  EXPECT_EQ(check_key("urto/v1/*/cmd").error().code, TransportErrorCode::kBadKey);
}

TEST(KeyExpression, BadOnesAreNamed) {
  for (const std::string_view bad :
       {"", "/a", "a/", "a//b", "a*/b", "a/$*", "a/**/**", "**/*", "a#b", "a?b", "a b", "a\tb", "\xff"}) {
    const TransportStatus status = check_key_expression(bad);
    ASSERT_FALSE(status) << bad;
    EXPECT_EQ(status.error().code, TransportErrorCode::kBadKey);
    EXPECT_EQ(status.error().subject, bad);
    EXPECT_NE(status.error().message.find('"' + std::string(bad) + '"'), std::string::npos);
  }
}

// Without a bound on the work this takes longer than anybody waits.
TEST(KeyExpression, ManyWildcardsStayCheap) {
  std::string many = "**";
  std::string key = "b";
  for (int i = 0; i < 200; ++i) {
    many += "/a/**";
    key += "/a";
  }
  EXPECT_TRUE(intersects(many, key));
  EXPECT_FALSE(intersects(many, key.substr(0, key.size() - 2) + "/b"));
}

}  // namespace
}  // namespace urto

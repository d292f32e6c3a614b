#include "app/endpoint.h"

#include <gtest/gtest.h>

namespace urto::app {
namespace {

TEST(Endpoint, HostAndPortAreTcp) {
  EXPECT_EQ(to_endpoint("0.0.0.0:7447"), "tcp/0.0.0.0:7447");
  EXPECT_EQ(to_endpoint("localhost:0"), "tcp/localhost:0");
  EXPECT_EQ(to_endpoint("[::1]:7447"), "tcp/[::1]:7447");
  EXPECT_EQ(to_endpoint("tls/example.org:443"), "tls/example.org:443");
  EXPECT_EQ(to_endpoint("tcp/1.2.3.4:5#so_sndbuf=65536"), "tcp/1.2.3.4:5#so_sndbuf=65536");
}

TEST(Endpoint, WhatIsNoneIsNamed) {
  for (const char* text : {"", "7447", "host", "host:", ":7447", "host:99999", "host:-1", "host:7x", "::1:7447"}) {
    const auto endpoint = to_endpoint(text);
    ASSERT_FALSE(endpoint) << text;
    EXPECT_NE(endpoint.error().find(text), std::string::npos);
  }
}

TEST(Endpoint, LoopbackIsThisMachineAlone) {
  for (const char* text : {"tcp/127.0.0.1:7447", "tcp/localhost:1", "tls/[::1]:7447", "tcp/127.8.9.10:1"}) {
    EXPECT_TRUE(is_loopback(text)) << text;
  }
  for (const char* text : {"tcp/0.0.0.0:7447", "tcp/[::]:7447", "tcp/192.168.0.1:1", "tcp/1270.example.org:1"}) {
    EXPECT_FALSE(is_loopback(text)) << text;
  }
}

}  // namespace
}  // namespace urto::app

// What only Zenoh has: endpoints, limits, credentials and access control.
#include "transport/zenoh/zenoh_transport.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "transport/test_client.h"

namespace urto {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr std::chrono::milliseconds kSoon{500};  // a timeout that a test waits for in full

ZenohOptions server_options() {
  ZenohOptions options;
  options.listen = {"tcp/127.0.0.1:0"};
  return options;
}

ZenohOptions client_options(const ZenohTransport& server) {
  ZenohOptions options;
  options.mode = ZenohMode::kClient;
  options.listen.clear();
  options.connect = server.endpoints();
  return options;
}

TransportError open_failure(const ZenohOptions& options) {
  const auto transport = ZenohTransport::open(options);
  if (transport) {
    ADD_FAILURE() << "it opened";
    return {};
  }
  return transport.error();
}

TEST(ZenohTransport, SaysWhereItListens) {
  const auto server = expect_ok(ZenohTransport::open(server_options()));
  ASSERT_EQ(server->endpoints().size(), 1u);
  EXPECT_THAT(server->endpoints()[0], StartsWith("tcp/127.0.0.1:"));
  EXPECT_NE(server->endpoints()[0], "tcp/127.0.0.1:0");
}

TEST(ZenohTransport, ABusyAddressIsNamed) {
  const auto server = expect_ok(ZenohTransport::open(server_options()));
  ZenohOptions second;
  second.listen = server->endpoints();
  const TransportError error = open_failure(second);
  EXPECT_EQ(error.code, TransportErrorCode::kAddressInUse) << error.message;
  EXPECT_EQ(error.subject, server->endpoints()[0]);
  EXPECT_THAT(error.message, HasSubstr(error.subject));
}

TEST(ZenohTransport, AClosedAddressCanBeUsedAgain) {
  auto server = expect_ok(ZenohTransport::open(server_options()));
  ZenohOptions again;
  again.listen = server->endpoints();
  server->close();
  EXPECT_TRUE(ZenohTransport::open(again));
}

TEST(ZenohTransport, BadEndpointsAreNamed) {
  for (const char* endpoint : {"", "127.0.0.1:7447", "udp/127.0.0.1:7447", "tcp/127.0.0.1", "tcp/:7447",
                               "tcp/127.0.0.1:70000", "tcp/127.0.0.1:x", "tcp/a b:7447", "tcp/127.0.0.1:"}) {
    ZenohOptions options;
    options.listen = {"tcp/127.0.0.1:0", endpoint};
    const TransportError error = open_failure(options);
    EXPECT_EQ(error.code, TransportErrorCode::kBadEndpoint) << endpoint << ": " << error.message;
    EXPECT_EQ(error.subject, endpoint);
  }
}

TEST(ZenohTransport, AnAddressOfAnotherMachineIsABadEndpoint) {
  ZenohOptions options;
  options.listen = {"tcp/192.0.2.1:7447"};  // RFC 5737: for documentation, nobody has it
  const TransportError error = open_failure(options);
  EXPECT_EQ(error.code, TransportErrorCode::kBadEndpoint) << error.message;
  EXPECT_EQ(error.subject, "tcp/192.0.2.1:7447");
}

TEST(ZenohTransport, BadOptionsAreNamed) {
  const auto expect_bad = [](const ZenohOptions& options, const char* name) {
    const TransportError error = open_failure(options);
    EXPECT_EQ(error.code, TransportErrorCode::kBadOption) << error.message;
    EXPECT_EQ(error.subject, name);
    EXPECT_THAT(error.message, StartsWith(name));
  };
  ZenohOptions options = server_options();
  options.listen.clear();
  expect_bad(options, "listen");
  options.mode = ZenohMode::kClient;
  expect_bad(options, "connect");
  options.listen = {"tcp/127.0.0.1:0"};
  expect_bad(options, "listen");
  options = server_options();
  options.message_bytes_max = 1023;
  expect_bad(options, "message_bytes_max");
  options = server_options();
  options.sessions_max = 0;
  expect_bad(options, "sessions_max");
  options = server_options();
  options.connect_timeout = std::chrono::milliseconds(0);
  expect_bad(options, "connect_timeout");
  options = server_options();
  options.user_dictionary = "users.txt";
  options.connect = {"tcp/127.0.0.1:7447"};
  expect_bad(options, "user_dictionary");
}

TEST(ZenohTransport, NobodyListeningIsToldWithTheAddress) {
  auto server = expect_ok(ZenohTransport::open(server_options()));
  ZenohOptions options = client_options(*server);
  options.connect_timeout = kSoon;
  server.reset();
  const TransportError error = open_failure(options);
  EXPECT_EQ(error.code, TransportErrorCode::kCannotConnect) << error.message;
  EXPECT_EQ(error.subject, options.connect[0]);
}

TEST(ZenohTransport, OversizedPayloadsAreDropped) {
  ZenohOptions options = server_options();
  options.message_bytes_max = 4096;
  const auto server = expect_ok(ZenohTransport::open(options));
  Inbox<Message> inbox;
  const auto subscriber = subscribe(*server, "test/size", inbox);
  const auto client = expect_ok(ZenohTransport::open(client_options(*server)));
  ASSERT_TRUE(client->put("test/size", std::string(4097, 'x'), {}));     // one packet, the filter drops it
  ASSERT_TRUE(client->put("test/size", std::string(400'000, 'x'), {}));  // fragments, which are not put together
  ASSERT_TRUE(client->put("test/size", std::string(4096, 'y'), {}));
  EXPECT_THAT(inbox.wait(1), ElementsAre(Message{"test/size", std::string(4096, 'y')}));
}

TEST(ZenohTransport, MoreSessionsThanAllowedAreRefused) {
  ZenohOptions options = server_options();
  options.sessions_max = 1;
  const auto server = expect_ok(ZenohTransport::open(options));
  const auto first = expect_ok(ZenohTransport::open(client_options(*server)));
  ZenohOptions second = client_options(*server);
  second.connect_timeout = kSoon;
  EXPECT_EQ(open_failure(second).code, TransportErrorCode::kCannotConnect);
}

TEST(ZenohTransport, AQueryTimesOut) {
  const auto server = expect_ok(ZenohTransport::open(server_options()));
  Inbox<Query> queries;
  const auto queryable = serve(*server, "test/slow", queries);
  const auto client = expect_ok(ZenohTransport::open(client_options(*server)));
  GetRequest impatient = request("test/slow");
  impatient.timeout = kSoon;
  for (const Answer& answer : ask(*client, impatient)) EXPECT_TRUE(answer.is_error) << answer.payload;
  std::vector<Query> asked = queries.take(1);
  EXPECT_TRUE(asked[0].reply("too late")) << "an answer that nobody waits for is no fault of the answerer";
}

// A peer that is to connect to a router opens although there is none yet.
TEST(ZenohTransport, APeerDoesNotWaitForItsRouter) {
  auto absent = expect_ok(ZenohTransport::open(server_options()));
  ZenohOptions options = server_options();
  options.connect = absent->endpoints();
  absent.reset();
  const auto server = expect_ok(ZenohTransport::open(options));
  EXPECT_THAT(server->endpoints(), Not(IsEmpty()));
}

// A server with the users alice and bob, whose rooms are urto/v1/lab and urto/v1/yard.
class ZenohAccess : public testing::Test {
 protected:
  ZenohAccess() : dictionary_(testing::TempDir() + "urto_users_" + std::to_string(getpid()) + ".txt") {
    std::ofstream(dictionary_) << "alice:secret \"1\"\n\nbob:secret2\n";
    ZenohOptions options = server_options();
    options.user_dictionary = dictionary_;
    server_ = expect_ok(ZenohTransport::open(options));
    for (const char* key : {"urto/v1/lab/cmd/*", "urto/v1/lab/info", "urto/v1/lab/state", "urto/v1/lab/event"}) {
      declarations_.push_back(
          expect_ok(server_->declare_queryable(key, [](Query query) { query.reply(query.key()); })));
    }
    declarations_.push_back(subscribe(*server_, "urto/v1/**", heard_));
    declarations_.push_back(watch(*server_, "urto/v1/**", changes_));
  }
  ~ZenohAccess() override { std::remove(dictionary_.c_str()); }

  std::unique_ptr<ZenohTransport> open(const std::string& user) {
    ZenohOptions options = client_options(*server_);
    options.credentials = {user, user == "alice" ? "secret \"1\"" : "secret2"};
    return expect_ok(ZenohTransport::open(options));
  }

  TransportErrorCode refusal(std::optional<ZenohCredentials> credentials) {
    ZenohOptions options = client_options(*server_);
    options.credentials = std::move(credentials);
    options.connect_timeout = kSoon;
    return open_failure(options).code;
  }

  // Returns when the server has seen all that this user sent and declared before.
  void settle(Transport& client, const std::string& user) {
    ASSERT_EQ(ask(client, request("urto/v1/lab/cmd/" + user)).size(), 1u);
  }

  std::string dictionary_;
  Inbox<Message> heard_;
  Inbox<Change> changes_;
  std::unique_ptr<ZenohTransport> server_;
  std::vector<DeclarationPtr> declarations_;
};

TEST_F(ZenohAccess, WithoutTheRightPasswordNobodyGetsIn) {
  EXPECT_EQ(refusal(std::nullopt), TransportErrorCode::kCannotConnect);
  EXPECT_EQ(refusal(ZenohCredentials{"alice", "wrong"}), TransportErrorCode::kCannotConnect);
  EXPECT_EQ(refusal(ZenohCredentials{"carol", "secret2"}), TransportErrorCode::kCannotConnect);
  EXPECT_TRUE(open("alice"));
}

TEST_F(ZenohAccess, AUserReadsAndCommands) {
  const auto alice = open("alice");
  for (const char* key :
       {"urto/v1/lab/info", "urto/v1/lab/state", "urto/v1/lab/event", "urto/v1/lab/cmd/alice", "urto/v1/*/info"}) {
    EXPECT_EQ(ask(*alice, request(key)).size(), 1u) << key;
  }
  ASSERT_TRUE(alice->put("urto/v1/lab/cmd/alice", "jump", {}));
  EXPECT_THAT(heard_.wait(1), ElementsAre(Message{"urto/v1/lab/cmd/alice", "jump"}));

  Inbox<Message> inbox;
  const auto subscriber = subscribe(*alice, "urto/v1/lab/*", inbox);
  settle(*alice, "alice");
  ASSERT_TRUE(server_->put("urto/v1/lab/snapshot", "frame", {}));
  ASSERT_TRUE(server_->put("urto/v1/lab/event", "bump", {}));
  EXPECT_THAT(inbox.wait(2),
              ElementsAre(Message{"urto/v1/lab/snapshot", "frame"}, Message{"urto/v1/lab/event", "bump"}));
}

TEST_F(ZenohAccess, MembersSeeEachOther) {
  const auto alice = open("alice");
  const auto bob = open("bob");
  const auto alive = expect_ok(server_->declare_liveliness_token("urto/v1/lab/alive"));
  const auto token = expect_ok(alice->declare_liveliness_token("urto/v1/lab/member/alice/a1"));
  EXPECT_EQ(changes_.wait(2).back(), (Change{"urto/v1/lab/member/alice/a1", true}));
  Inbox<Change> inbox;
  const auto watcher = watch(*bob, "urto/v1/lab/**", inbox);
  EXPECT_THAT(inbox.wait(2), testing::UnorderedElementsAre(Change{"urto/v1/lab/alive", true},
                                                           Change{"urto/v1/lab/member/alice/a1", true}));
}

TEST_F(ZenohAccess, NobodyCommandsInAnothersName) {
  const auto alice = open("alice");
  EXPECT_THAT(ask(*alice, request("urto/v1/lab/cmd/bob")), IsEmpty());
  EXPECT_THAT(ask(*alice, request("urto/v1/lab/cmd/*")), IsEmpty());
  ASSERT_TRUE(alice->put("urto/v1/lab/cmd/bob", "forged", {}));
  ASSERT_TRUE(alice->put("urto/v1/lab/cmd/alice/x", "forged", {}));
  ASSERT_TRUE(alice->put("urto/v1/lab/cmd/alice", "mine", {}));
  EXPECT_THAT(heard_.wait(1), ElementsAre(Message{"urto/v1/lab/cmd/alice", "mine"}));
}

TEST_F(ZenohAccess, NobodyForgesWhatTheServerSays) {
  const auto alice = open("alice");
  const auto bob = open("bob");
  Inbox<Message> inbox;
  const auto subscriber = subscribe(*bob, "urto/v1/**", inbox);
  settle(*bob, "bob");
  const std::vector<std::string> keys{"urto/v1/lab/snapshot", "urto/v1/lab/event", "urto/v1/lab/info",
                                      "urto/v1/lab/state", "urto/v1/yard/snapshot"};
  for (const std::string& key : keys) ASSERT_TRUE(alice->put(key, "forged", {}));
  Inbox<Query> asked;
  const auto false_info = serve(*alice, "urto/v1/yard/info", asked);
  settle(*alice, "alice");
  EXPECT_THAT(ask(*bob, request("urto/v1/yard/info")), IsEmpty());
  EXPECT_THAT(asked.take(0), IsEmpty());
  ASSERT_TRUE(server_->put("urto/v1/lab/snapshot", "true", {}));
  EXPECT_THAT(inbox.wait(1), ElementsAre(Message{"urto/v1/lab/snapshot", "true"}));
  EXPECT_THAT(heard_.now(), Not(Contains(testing::Field(&Message::payload, "forged"))));
}

TEST_F(ZenohAccess, NobodyForgesPresence) {
  const auto alice = open("alice");
  const auto as_bob = expect_ok(alice->declare_liveliness_token("urto/v1/lab/member/bob/b1"));
  const auto as_server = expect_ok(alice->declare_liveliness_token("urto/v1/yard/alive"));
  const auto own = expect_ok(alice->declare_liveliness_token("urto/v1/lab/member/alice/a1"));
  EXPECT_THAT(changes_.wait(1), ElementsAre(Change{"urto/v1/lab/member/alice/a1", true}));
}

TEST_F(ZenohAccess, NobodySeesAnothersCommands) {
  const auto alice = open("alice");
  const auto bob = open("bob");
  Inbox<Message> inbox;
  const auto spy = subscribe(*alice, "urto/v1/**", inbox);
  Inbox<Query> asked;
  const auto false_server = serve(*alice, "urto/v1/lab/cmd/bob", asked);
  settle(*alice, "alice");
  ASSERT_TRUE(bob->put("urto/v1/lab/cmd/bob", "private", {}));
  EXPECT_EQ(ask(*bob, request("urto/v1/lab/cmd/bob", "private")).size(), 1u);
  heard_.wait(1);
  ASSERT_TRUE(server_->put("urto/v1/lab/snapshot", "frame", {}));
  EXPECT_THAT(inbox.wait(1), ElementsAre(Message{"urto/v1/lab/snapshot", "frame"}));
  EXPECT_THAT(asked.take(0), IsEmpty());
}

}  // namespace
}  // namespace urto

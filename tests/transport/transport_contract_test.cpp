// What transport.h promises, asked of every implementation.
#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "transport/loopback_transport.h"
#include "transport/test_client.h"
#include "transport/transport.h"
#include "transport/zenoh/zenoh_transport.h"

namespace urto {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr char kSettleKey[] = "test/settle";

// A server, and clients that come to it.
class Network {
 public:
  virtual ~Network() = default;
  virtual std::unique_ptr<Transport> open_server() = 0;
  virtual std::unique_ptr<Transport> open_client() = 0;
};

class Loopback final : public Network {
 public:
  std::unique_ptr<Transport> open_server() override { return network_.connect(); }
  std::unique_ptr<Transport> open_client() override { return network_.connect(); }

 private:
  LoopbackNetwork network_;
};

class Zenoh final : public Network {
 public:
  std::unique_ptr<Transport> open_server() override {
    ZenohOptions options;
    options.listen = {"tcp/127.0.0.1:0"};
    auto server = expect_ok(ZenohTransport::open(options));
    endpoints_ = server->endpoints();
    return server;
  }
  std::unique_ptr<Transport> open_client() override {
    ZenohOptions options;
    options.mode = ZenohMode::kClient;
    options.listen.clear();
    options.connect = endpoints_;
    return expect_ok(ZenohTransport::open(options));
  }

 private:
  std::vector<std::string> endpoints_;
};

template <class Implementation>
class TransportContract : public testing::Test {
 protected:
  TransportContract()
      : server_(network_.open_server()),
        settle_(expect_ok(server_->declare_queryable(kSettleKey, [](Query query) { query.reply("settled"); }))),
        client_(network_.open_client()),
        other_(network_.open_client()) {}

  // Returns when the server has seen all that this client declared and sent before: it all takes the same way.
  static void settle(Transport& client) { ASSERT_EQ(ask(client, request(kSettleKey)).size(), 1u); }

  Implementation network_;
  std::unique_ptr<Transport> server_;
  DeclarationPtr settle_;
  std::unique_ptr<Transport> client_;
  std::unique_ptr<Transport> other_;
};

using Implementations = testing::Types<Loopback, Zenoh>;
TYPED_TEST_SUITE(TransportContract, Implementations);

TYPED_TEST(TransportContract, PublishesBytesToSubscribers) {
  Inbox<Message> client_inbox;
  Inbox<Message> other_inbox;
  const auto one = subscribe(*this->client_, "test/room/snapshot", client_inbox);
  const auto two = subscribe(*this->other_, "test/*/snapshot", other_inbox);
  this->settle(*this->client_);
  this->settle(*this->other_);
  const auto publisher = expect_ok(this->server_->declare_publisher("test/room/snapshot", {"text/plain", {}, {}}));
  const std::string bytes("a\0\xff", 3);
  ASSERT_TRUE(publisher->put(bytes));
  ASSERT_TRUE(publisher->put(""));
  const auto expected = ElementsAre(Message{"test/room/snapshot", bytes}, Message{"test/room/snapshot", ""});
  EXPECT_THAT(client_inbox.wait(2), expected);
  EXPECT_THAT(other_inbox.wait(2), expected);
}

TYPED_TEST(TransportContract, PublishesInOrder) {
  constexpr int kMessages = 100;  // fit into one batch of Zenoh's queue, so none is dropped
  Inbox<Message> inbox;
  const auto subscriber = subscribe(*this->server_, "test/count", inbox);
  const auto publisher = expect_ok(this->client_->declare_publisher("test/count", {}));
  std::vector<Message> expected;
  for (int i = 0; i < kMessages; ++i) {
    expected.push_back({"test/count", std::to_string(i)});
    ASSERT_TRUE(publisher->put(std::to_string(i)));
  }
  EXPECT_EQ(inbox.wait(kMessages), expected);
}

TYPED_TEST(TransportContract, PutsWithoutAPublisher) {
  Inbox<Message> inbox;
  const auto subscriber = subscribe(*this->server_, "test/*/cmd/*", inbox);
  PublisherOptions options;
  options.reliability = Reliability::kBestEffort;
  options.priority = Priority::kHigh;
  ASSERT_TRUE(this->client_->put("test/room/cmd/alice", "go", options));
  EXPECT_THAT(inbox.wait(1), ElementsAre(Message{"test/room/cmd/alice", "go"}));
}

TYPED_TEST(TransportContract, AClientHearsItself) {
  Inbox<Message> inbox;
  const auto subscriber = subscribe(*this->client_, "test/echo", inbox);
  ASSERT_TRUE(this->client_->put("test/echo", "hello", {}));
  EXPECT_THAT(inbox.wait(1), ElementsAre(Message{"test/echo", "hello"}));
}

TYPED_TEST(TransportContract, CarriesLargePayloads) {
  const std::string large(1 << 20, 'x');  // many fragments
  Inbox<Query> queries;
  const auto queryable = serve(*this->server_, "test/large", queries);
  auto answers = std::async(std::launch::async, [&] { return ask(*this->client_, request("test/large", large)); });
  std::vector<Query> asked = queries.take(1);
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(asked[0].payload(), large);
  ASSERT_TRUE(asked[0].reply(large + large));
  const std::vector<Answer> got = answers.get();
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0].payload, large + large);
}

TYPED_TEST(TransportContract, AnswersLaterFromAnotherThread) {
  Inbox<Query> queries;
  const auto queryable = serve(*this->server_, "test/room/cmd/*", queries);
  std::thread answerer([&] {
    std::vector<Query> asked = queries.take(1);
    ASSERT_EQ(asked.size(), 1u);
    EXPECT_EQ(asked[0].key(), "test/room/cmd/alice");
    EXPECT_EQ(asked[0].parameters(), "saved_state=true");
    EXPECT_EQ(asked[0].payload(), "spawn");
    EXPECT_FALSE(asked[0].is_answered());
    EXPECT_TRUE(asked[0].reply("done", "text/plain"));
    EXPECT_TRUE(asked[0].is_answered());
    EXPECT_EQ(asked[0].reply("again").error().code, TransportErrorCode::kAlreadyAnswered);
    EXPECT_EQ(asked[0].reply_error("again").error().code, TransportErrorCode::kAlreadyAnswered);
  });
  const std::vector<Answer> answers = ask(*this->client_, request("test/room/cmd/alice", "spawn", "saved_state=true"));
  answerer.join();
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_FALSE(answers[0].is_error);
  EXPECT_EQ(answers[0].key, "test/room/cmd/alice");
  EXPECT_EQ(answers[0].payload, "done");
}

TYPED_TEST(TransportContract, AnswersWithAnError) {
  const auto queryable =
      expect_ok(this->server_->declare_queryable("test/refuse", [](Query query) { query.reply_error("not today"); }));
  const std::vector<Answer> answers = ask(*this->client_, request("test/refuse"));
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_TRUE(answers[0].is_error);
  EXPECT_EQ(answers[0].payload, "not today");
}

TYPED_TEST(TransportContract, ADroppedQueryEndsWithoutAnAnswer) {
  const auto queryable = expect_ok(this->server_->declare_queryable("test/ignore", [](Query) {}));
  EXPECT_THAT(ask(*this->client_, request("test/ignore")), IsEmpty());
}

TYPED_TEST(TransportContract, NobodyToAskEndsWithoutAnAnswer) {
  EXPECT_THAT(ask(*this->client_, request("test/nobody")), IsEmpty());
}

TYPED_TEST(TransportContract, AsksEveryQueryableThatMatches) {
  const auto answer = [](std::string text) { return [text](Query query) { query.reply(text); }; };
  const auto one = expect_ok(this->server_->declare_queryable("test/a/info", answer("a")));
  const auto two = expect_ok(this->server_->declare_queryable("test/b/info", answer("b")));
  std::vector<Message> got;
  for (const Answer& each : ask(*this->client_, request("test/*/info"))) got.push_back({each.key, each.payload});
  EXPECT_THAT(got, UnorderedElementsAre(Message{"test/a/info", "a"}, Message{"test/b/info", "b"}));
}

TYPED_TEST(TransportContract, LivelinessTellsWhoIsThereAndWhoGoes) {
  const auto early = expect_ok(this->client_->declare_liveliness_token("test/room/member/alice/1"));
  this->settle(*this->client_);
  Inbox<Change> inbox;
  const auto watcher = watch(*this->server_, "test/room/member/**", inbox);
  EXPECT_THAT(inbox.wait(1), ElementsAre(Change{"test/room/member/alice/1", true}));
  auto late = expect_ok(this->other_->declare_liveliness_token("test/room/member/bob/2"));
  EXPECT_EQ(inbox.wait(2).back(), (Change{"test/room/member/bob/2", true}));
  late.reset();
  EXPECT_EQ(inbox.wait(3).back(), (Change{"test/room/member/bob/2", false}));
  this->client_->close();
  EXPECT_EQ(inbox.wait(4).back(), (Change{"test/room/member/alice/1", false}));
}

TYPED_TEST(TransportContract, AClientSeesTheServersToken) {
  auto token = expect_ok(this->server_->declare_liveliness_token("test/room/alive"));
  Inbox<Change> inbox;
  const auto watcher = watch(*this->client_, "test/*/alive", inbox);
  EXPECT_THAT(inbox.wait(1), ElementsAre(Change{"test/room/alive", true}));
  token.reset();
  EXPECT_EQ(inbox.wait(2).back(), (Change{"test/room/alive", false}));
}

TYPED_TEST(TransportContract, NothingComesAfterUndeclaring) {
  Inbox<Message> kept_inbox;
  Inbox<Message> gone_inbox;
  const auto kept = subscribe(*this->server_, "test/kept", kept_inbox);
  auto gone = subscribe(*this->server_, "test/**", gone_inbox);
  ASSERT_TRUE(this->client_->put("test/kept", "1", {}));
  kept_inbox.wait(1);
  gone_inbox.wait(1);
  gone.reset();
  ASSERT_TRUE(this->client_->put("test/kept", "2", {}));
  kept_inbox.wait(2);
  this->server_->close();  // every callback has run by now
  EXPECT_EQ(gone_inbox.now().size(), 1u);
}

TYPED_TEST(TransportContract, UndeclaringWaitsForARunningCallback) {
  std::promise<void> entered;
  std::promise<void> release;
  std::atomic<bool> has_left = false;
  auto subscriber = expect_ok(this->server_->declare_subscriber(
      "test/slow", [&, wait = release.get_future().share()](std::string_view, std::string_view) {
        entered.set_value();
        wait.wait();
        has_left = true;
      }));
  std::thread putter([&] { EXPECT_TRUE(this->client_->put("test/slow", "x", {})); });
  entered.get_future().wait();
  std::promise<void> undeclaring;
  std::thread undeclarer([&] {
    undeclaring.set_value();
    subscriber.reset();
    EXPECT_TRUE(has_left);
  });
  undeclaring.get_future().wait();
  release.set_value();
  undeclarer.join();
  putter.join();
}

TYPED_TEST(TransportContract, ClosingWaitsForARunningCallback) {
  std::promise<void> entered;
  std::promise<void> release;
  std::atomic<bool> has_left = false;
  const auto subscriber = expect_ok(this->server_->declare_subscriber(
      "test/slow", [&, wait = release.get_future().share()](std::string_view, std::string_view) {
        entered.set_value();
        wait.wait();
        has_left = true;
      }));
  std::thread putter([&] { EXPECT_TRUE(this->client_->put("test/slow", "x", {})); });
  entered.get_future().wait();
  std::promise<void> closing;
  std::thread closer([&] {
    closing.set_value();
    this->server_->close();
    EXPECT_TRUE(has_left);
  });
  closing.get_future().wait();
  release.set_value();
  closer.join();
  putter.join();
}

TYPED_TEST(TransportContract, ACallbackMayThrow) {
  Inbox<Message> inbox;
  const auto subscriber =
      expect_ok(this->server_->declare_subscriber("test/throw", [&](std::string_view key, std::string_view payload) {
        inbox.add({std::string(key), std::string(payload)});
        if (payload == "1") throw std::runtime_error("thrown on purpose");
        if (payload == "2") throw 2;
      }));
  for (const char* payload : {"1", "2", "3"}) ASSERT_TRUE(this->client_->put("test/throw", payload, {}));
  EXPECT_EQ(inbox.wait(3).back().payload, "3");
}

TYPED_TEST(TransportContract, AQueryWhoseCallbackThrowsEndsWithoutAnAnswer) {
  const auto queryable = expect_ok(
      this->server_->declare_queryable("test/throw", [](Query) { throw std::runtime_error("thrown on purpose"); }));
  EXPECT_THAT(ask(*this->client_, request("test/throw")), IsEmpty());
}

TYPED_TEST(TransportContract, ACallbackMayPublish) {
  Inbox<Message> inbox;
  const auto answers = subscribe(*this->server_, "test/pong", inbox);
  const auto subscriber = expect_ok(this->server_->declare_subscriber(
      "test/ping", [&](std::string_view, std::string_view payload) { this->server_->put("test/pong", payload, {}); }));
  ASSERT_TRUE(this->client_->put("test/ping", "x", {}));
  EXPECT_THAT(inbox.wait(1), ElementsAre(Message{"test/pong", "x"}));
}

TYPED_TEST(TransportContract, RefusesBadKeys) {
  const auto code = [](const auto& result) {
    return result ? std::optional<TransportErrorCode>() : std::optional(result.error().code);
  };
  const auto bad_key = std::optional(TransportErrorCode::kBadKey);
  EXPECT_EQ(code(this->client_->put("test/*", "", {})), bad_key);
  EXPECT_EQ(code(this->client_->declare_publisher("test/**", {})), bad_key);
  EXPECT_EQ(code(this->client_->declare_subscriber("test//x", [](std::string_view, std::string_view) {})), bad_key);
  EXPECT_EQ(code(this->client_->declare_queryable("", [](Query) {})), bad_key);
  EXPECT_EQ(code(this->client_->declare_liveliness_token("test/*")), bad_key);
  EXPECT_EQ(code(this->client_->declare_liveliness_subscriber("/test", [](std::string_view, bool) {})), bad_key);
  EXPECT_EQ(code(this->client_->get(request("test?x"), {})), bad_key);
}

TYPED_TEST(TransportContract, RefusesATimeoutThatIsNone) {
  GetRequest never = request("test/x");
  never.timeout = std::chrono::milliseconds(0);
  const TransportStatus status = this->client_->get(never, {});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, TransportErrorCode::kBadOption);
}

TYPED_TEST(TransportContract, AfterCloseEverythingIsRefused) {
  Inbox<Query> queries;
  const auto queryable = serve(*this->server_, "test/late", queries);
  const auto publisher = expect_ok(this->server_->declare_publisher("test/room/snapshot", {}));
  const auto token = expect_ok(this->server_->declare_liveliness_token("test/room/alive"));
  ASSERT_TRUE(this->client_->get(request("test/late"), {}));
  std::vector<Query> asked = queries.take(1);
  ASSERT_EQ(asked.size(), 1u);
  this->server_->close();
  this->server_->close();
  const auto closed = TransportErrorCode::kClosed;
  EXPECT_EQ(asked[0].reply("too late").error().code, closed);
  EXPECT_EQ(publisher->put("x").error().code, closed);
  EXPECT_EQ(this->server_->put("test/x", "", {}).error().code, closed);
  EXPECT_EQ(this->server_->declare_publisher("test/x", {}).error().code, closed);
  EXPECT_EQ(this->server_->declare_queryable("test/x", [](Query) {}).error().code, closed);
  EXPECT_EQ(this->server_->declare_liveliness_token("test/x").error().code, closed);
  EXPECT_EQ(this->server_->get(request("test/x"), {}).error().code, closed);
}

TYPED_TEST(TransportContract, DeclarationsAndQueriesMayOutliveTheirTransport) {
  Inbox<Query> queries;
  Inbox<Message> inbox;
  const auto queryable = serve(*this->server_, "test/late", queries);
  const auto subscriber = subscribe(*this->server_, "test/x", inbox);
  const auto publisher = expect_ok(this->server_->declare_publisher("test/x", {}));
  ASSERT_TRUE(this->client_->get(request("test/late"), {}));
  const std::vector<Query> asked = queries.take(1);
  this->settle_.reset();
  this->server_.reset();
  EXPECT_EQ(publisher->put("x").error().code, TransportErrorCode::kClosed);
  EXPECT_THAT(inbox.now(), IsEmpty());
}

}  // namespace
}  // namespace urto

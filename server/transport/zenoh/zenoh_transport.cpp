#include "transport/zenoh/zenoh_transport.h"

#include <atomic>
#include <optional>
#include <utility>

#include "transport/callback_gate.h"
#include "transport/key_expression.h"
#include "transport/zenoh/handlers.h"
#include "transport/zenoh/zenoh_config.h"
#include "urto_zenoh/src/lib.rs.h"

namespace urto {
namespace zenoh {

void QueryHandler::on_query(rust::Box<IncomingQuery> query) const { function_(std::move(query)); }

}  // namespace zenoh

namespace {

rust::Str rust_str(std::string_view text) { return {text.data(), text.size()}; }
rust::Slice<const std::uint8_t> rust_bytes(std::string_view bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

// What a transport shares with its declarations and queries, which may outlive it.
struct Shared {
  explicit Shared(rust::Box<zenoh::Session> opened) : session(std::move(opened)) {}

  rust::Box<zenoh::Session> session;
  CallbackGates gates;
  std::atomic<bool> is_closed = false;
};
using SharedPtr = std::shared_ptr<Shared>;

// Calls Rust unless the transport is closed. What Rust refuses arrives as an exception and leaves as an error.
template <class Function>
auto call_rust(const Shared& shared, std::string_view subject, Function&& function)
    -> TransportExpected<decltype(function())> {
  if (shared.is_closed) {
    return transport_failure(TransportErrorCode::kClosed, std::string(subject), "the transport was closed");
  }
  try {
    if constexpr (std::is_void_v<decltype(function())>) {
      function();
      return {};
    } else {
      return function();
    }
  } catch (const std::exception& error) {
    return transport_failure(shared.is_closed ? TransportErrorCode::kClosed : TransportErrorCode::kInternal,
                             std::string(subject), std::string(subject) + ": " + error.what());
  }
}

class ZenohResponder final : public QueryResponder {
 public:
  ZenohResponder(SharedPtr shared, rust::Box<zenoh::IncomingQuery> query, std::string key)
      : shared_(std::move(shared)), query_(std::move(query)), key_(std::move(key)) {}

  TransportStatus reply(std::string_view payload, std::string_view encoding) override {
    return call_rust(*shared_, key_, [&] { query_->reply(rust_str(key_), rust_bytes(payload), rust_str(encoding)); });
  }
  TransportStatus reply_error(std::string_view payload) override {
    return call_rust(*shared_, key_, [&] { query_->reply_error(rust_bytes(payload)); });
  }

 private:
  SharedPtr shared_;
  rust::Box<zenoh::IncomingQuery> query_;
  std::string key_;
};

class ZenohPublisher final : public Publisher {
 public:
  ZenohPublisher(SharedPtr shared, rust::Box<zenoh::Publisher> publisher, std::string_view key)
      : shared_(std::move(shared)), publisher_(std::move(publisher)), key_(key) {}
  TransportStatus put(std::string_view payload) override {
    return call_rust(*shared_, key_, [&] { publisher_->put(rust_bytes(payload)); });
  }

 private:
  SharedPtr shared_;
  rust::Box<zenoh::Publisher> publisher_;
  std::string key_;
};

// Inner is rust::Box of a Subscriber, a Queryable or a Token; dropping it undeclares it.
template <class Inner>
class ZenohDeclaration final : public Declaration {
 public:
  ZenohDeclaration(SharedPtr shared, Inner inner, std::shared_ptr<CallbackGate> gate)
      : shared_(std::move(shared)), inner_(std::move(inner)), gate_(std::move(gate)) {}
  ~ZenohDeclaration() override {
    inner_.reset();
    if (gate_ != nullptr) gate_->close();
  }

 private:
  SharedPtr shared_;
  std::optional<Inner> inner_;
  std::shared_ptr<CallbackGate> gate_;
};

template <class Inner>
TransportExpected<DeclarationPtr> declaration(const SharedPtr& shared, TransportExpected<Inner> inner,
                                              std::shared_ptr<CallbackGate> gate) {
  if (!inner) return tl::make_unexpected(std::move(inner.error()));
  return std::make_unique<ZenohDeclaration<Inner>>(shared, std::move(*inner), std::move(gate));
}

class ZenohTransportImpl final : public ZenohTransport {
 public:
  explicit ZenohTransportImpl(rust::Box<zenoh::Session> session)
      : shared_(std::make_shared<Shared>(std::move(session))) {}
  ~ZenohTransportImpl() override { close(); }

  std::vector<std::string> endpoints() const override {
    std::vector<std::string> texts;
    const auto endpoints = call_rust(*shared_, "endpoints", [&] { return shared_->session->endpoints(); });
    if (endpoints) {
      for (const rust::String& endpoint : *endpoints) texts.emplace_back(endpoint);
    }
    return texts;
  }

  TransportExpected<std::unique_ptr<Publisher>> declare_publisher(std::string_view key,
                                                                  const PublisherOptions& options) override {
    return declare(check_key(key), key, [&] { return new_publisher(key, options); })
        .map([&](rust::Box<zenoh::Publisher> publisher) -> std::unique_ptr<Publisher> {
          return std::make_unique<ZenohPublisher>(shared_, std::move(publisher), key);
        });
  }

  TransportStatus put(std::string_view key, std::string_view payload, const PublisherOptions& options) override {
    return declare(check_key(key), key, [&] { new_publisher(key, options)->put(rust_bytes(payload)); });
  }

  TransportExpected<DeclarationPtr> declare_queryable(std::string_view key_expression,
                                                      QueryCallback callback) override {
    const auto gate = shared_->gates.add();
    // The transport owns the session, which owns this handler: a weak pointer, or they keep each other alive.
    auto handler = std::make_unique<zenoh::QueryHandler>(
        [gate, weak = std::weak_ptr<Shared>(shared_), own = std::string(key_expression),
         callback = std::move(callback)](rust::Box<zenoh::IncomingQuery> incoming) {
          const SharedPtr shared = weak.lock();
          if (shared == nullptr) return;
          gate->call(callback, make_query(shared, own, std::move(incoming)));
        });
    return declaration(
        shared_,
        declare(check_key_expression(key_expression), key_expression,
                [&] { return shared_->session->queryable(rust_str(key_expression), std::move(handler)); }),
        gate);
  }

  TransportExpected<DeclarationPtr> declare_subscriber(std::string_view key_expression,
                                                       SampleCallback callback) override {
    const auto gate = shared_->gates.add();
    auto handler = std::make_unique<zenoh::SampleHandler>(
        [gate, callback = std::move(callback)](std::string_view key, std::string_view payload) {
          gate->call(callback, key, payload);
        });
    return declaration(
        shared_,
        declare(check_key_expression(key_expression), key_expression,
                [&] { return shared_->session->subscriber(rust_str(key_expression), std::move(handler)); }),
        gate);
  }

  TransportExpected<DeclarationPtr> declare_liveliness_token(std::string_view key) override {
    return declaration(shared_, declare(check_key(key), key, [&] { return shared_->session->token(rust_str(key)); }),
                       nullptr);
  }

  TransportExpected<DeclarationPtr> declare_liveliness_subscriber(std::string_view key_expression,
                                                                  LivelinessCallback callback) override {
    const auto gate = shared_->gates.add();
    auto handler = std::make_unique<zenoh::LivelinessHandler>(
        [gate, callback = std::move(callback)](std::string_view key, bool alive) { gate->call(callback, key, alive); });
    return declaration(
        shared_,
        declare(check_key_expression(key_expression), key_expression,
                [&] { return shared_->session->liveliness_subscriber(rust_str(key_expression), std::move(handler)); }),
        gate);
  }

  TransportStatus get(const GetRequest& request, GetCallbacks callbacks) override {
    zenoh::GetSettings settings;
    settings.selector = request.key + (request.parameters.empty() ? "" : "?" + request.parameters);
    settings.encoding = request.encoding;
    settings.timeout_ms = static_cast<std::uint64_t>(request.timeout.count());
    const auto gate = shared_->gates.add();
    auto handler = std::make_unique<zenoh::ReplyHandler>(
        [gate, on_reply = std::move(callbacks.on_reply)](bool is_error, std::string_view key,
                                                         std::string_view payload) {
          if (on_reply) gate->call(on_reply, Reply{is_error, key, payload});
        },
        [gate, on_done = std::move(callbacks.on_done)] {
          if (on_done) gate->call(on_done);
        });
    return declare(check_get(request), request.key,
                   [&] { shared_->session->get(settings, rust_bytes(request.payload), std::move(handler)); });
  }

  void close() override {
    if (shared_->is_closed.exchange(true)) return;
    try {
      shared_->session->close();
    } catch (const std::exception&) {
      // Only that the other side did not say goodbye in time; nothing of ours is left open.
    }
    shared_->gates.close();
  }

 private:
  // Calls Rust unless the key is bad.
  template <class Function>
  auto declare(TransportStatus key_status, std::string_view key, Function&& function)
      -> TransportExpected<decltype(function())> {
    if (!key_status) return tl::make_unexpected(std::move(key_status.error()));
    return call_rust(*shared_, key, std::forward<Function>(function));
  }

  rust::Box<zenoh::Publisher> new_publisher(std::string_view key, const PublisherOptions& options) const {
    zenoh::PublisherSettings settings;
    settings.encoding = options.encoding;
    settings.best_effort = options.reliability == Reliability::kBestEffort;
    settings.high_priority = options.priority == Priority::kHigh;
    return shared_->session->publisher(rust_str(key), settings);
  }

  static Query make_query(const SharedPtr& shared, const std::string& own_key,
                          rust::Box<zenoh::IncomingQuery> incoming) {
    std::string key(zenoh::view(incoming->key()));
    std::string parameters(zenoh::view(incoming->parameters()));
    const rust::Vec<std::uint8_t> payload = incoming->payload();
    std::string bytes(reinterpret_cast<const char*>(payload.data()), payload.size());
    std::string answer_key = has_wildcard(own_key) ? key : own_key;
    auto responder = std::make_unique<ZenohResponder>(shared, std::move(incoming), std::move(answer_key));
    return Query(std::move(key), std::move(parameters), std::move(bytes), std::move(responder));
  }

  SharedPtr shared_;
};

}  // namespace

TransportExpected<std::unique_ptr<ZenohTransport>> ZenohTransport::open(const ZenohOptions& options) {
  const auto config = zenoh_config_json(options);
  if (!config) return tl::make_unexpected(config.error());
  try {
    return std::make_unique<ZenohTransportImpl>(zenoh::open(rust_str(*config)));
  } catch (const std::exception& error) {
    return tl::make_unexpected(open_error(options, error.what()));
  }
}

}  // namespace urto

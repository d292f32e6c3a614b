#include "transport/loopback_transport.h"

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "transport/callback_gate.h"
#include "transport/key_expression.h"

namespace urto {
namespace {

// One receiver: what it wants, what to call, and the gate in front of that.
template <class Callback>
struct Receiver {
  std::string key_expression;
  Callback callback;
  std::shared_ptr<CallbackGate> gate;
  std::shared_ptr<const std::atomic<bool>> is_client_closed;
};

// The receivers of one kind in the order of their declaration.
template <class Callback>
using Receivers = std::map<std::uint64_t, std::shared_ptr<const Receiver<Callback>>>;

template <class Callback>
std::vector<std::shared_ptr<const Receiver<Callback>>> matching(const Receivers<Callback>& receivers,
                                                                std::string_view key_expression) {
  std::vector<std::shared_ptr<const Receiver<Callback>>> found;
  for (const auto& [id, receiver] : receivers) {
    if (intersects(receiver->key_expression, key_expression)) found.push_back(receiver);
  }
  return found;
}

// A get() under way. The responders of its queries share it; when the last one goes, the asker hears that it is done.
struct PendingGet {
  GetCallbacks callbacks;
  std::shared_ptr<CallbackGate> gate;

  ~PendingGet() {
    if (callbacks.on_done) gate->call(callbacks.on_done);
  }
};

class LoopbackResponder final : public QueryResponder {
 public:
  LoopbackResponder(std::shared_ptr<PendingGet> pending, std::string key,
                    std::shared_ptr<const std::atomic<bool>> is_closed)
      : pending_(std::move(pending)), key_(std::move(key)), is_closed_(std::move(is_closed)) {}

  TransportStatus reply(std::string_view payload, std::string_view) override { return send({false, key_, payload}); }
  TransportStatus reply_error(std::string_view payload) override { return send({true, {}, payload}); }

 private:
  TransportStatus send(const Reply& reply) {
    if (*is_closed_) return transport_failure(TransportErrorCode::kClosed, key_, "the transport was closed");
    if (pending_->callbacks.on_reply) pending_->gate->call(pending_->callbacks.on_reply, reply);
    return {};
  }

  std::shared_ptr<PendingGet> pending_;
  std::string key_;
  std::shared_ptr<const std::atomic<bool>> is_closed_;
};

}  // namespace

// What all the clients share. Callbacks are called without its lock, so they may call into the network again.
class LoopbackNetwork::Hub {
 public:
  void put(std::string_view key, std::string_view payload) {
    for (const auto& receiver : find(subscribers_, key)) receiver->gate->call(receiver->callback, key, payload);
  }

  void get(const GetRequest& request, std::shared_ptr<PendingGet> pending) {
    for (const auto& receiver : find(queryables_, request.key)) {
      const std::string& own = receiver->key_expression;
      auto responder = std::make_unique<LoopbackResponder>(pending, has_wildcard(own) ? request.key : own,
                                                           receiver->is_client_closed);
      receiver->gate->call(receiver->callback,
                           Query(request.key, request.parameters, request.payload, std::move(responder)));
    }
  }

  std::uint64_t add(std::shared_ptr<const Receiver<SampleCallback>> receiver) {
    return insert(subscribers_, std::move(receiver));
  }
  std::uint64_t add(std::shared_ptr<const Receiver<QueryCallback>> receiver) {
    return insert(queryables_, std::move(receiver));
  }
  std::uint64_t add(std::shared_ptr<const Receiver<LivelinessCallback>> receiver) {
    std::uint64_t id = 0;
    std::set<std::string> alive;
    {
      const std::lock_guard lock(mutex_);
      id = ++last_id_;
      liveliness_subscribers_.emplace(id, receiver);
      for (const auto& [token, key] : tokens_) {
        if (intersects(receiver->key_expression, key)) alive.insert(key);
      }
    }
    for (const std::string& key : alive) receiver->gate->call(receiver->callback, std::string_view(key), true);
    return id;
  }

  std::uint64_t add_token(const std::string& key) {
    std::uint64_t id = 0;
    bool is_first = false;
    {
      const std::lock_guard lock(mutex_);
      is_first = count_tokens(key) == 0;
      id = ++last_id_;
      tokens_.emplace(id, key);
    }
    if (is_first) tell_liveliness(key, true);
    return id;
  }

  void remove(std::uint64_t id) {
    std::string gone;
    {
      const std::lock_guard lock(mutex_);
      subscribers_.erase(id);
      queryables_.erase(id);
      liveliness_subscribers_.erase(id);
      const auto token = tokens_.find(id);
      if (token == tokens_.end()) return;
      gone = token->second;
      tokens_.erase(token);
      if (count_tokens(gone) > 0) return;
    }
    tell_liveliness(gone, false);
  }

 private:
  template <class Callback>
  std::vector<std::shared_ptr<const Receiver<Callback>>> find(const Receivers<Callback>& receivers,
                                                              std::string_view key_expression) {
    const std::lock_guard lock(mutex_);
    return matching(receivers, key_expression);
  }

  template <class Callback>
  std::uint64_t insert(Receivers<Callback>& receivers, std::shared_ptr<const Receiver<Callback>> receiver) {
    const std::lock_guard lock(mutex_);
    receivers.emplace(++last_id_, std::move(receiver));
    return last_id_;
  }

  std::size_t count_tokens(const std::string& key) const {
    std::size_t count = 0;
    for (const auto& [id, other] : tokens_) count += other == key ? 1 : 0;
    return count;
  }

  void tell_liveliness(const std::string& key, bool alive) {
    for (const auto& receiver : find(liveliness_subscribers_, key)) {
      receiver->gate->call(receiver->callback, std::string_view(key), alive);
    }
  }

  std::mutex mutex_;
  std::uint64_t last_id_ = 0;
  Receivers<SampleCallback> subscribers_;
  Receivers<QueryCallback> queryables_;
  Receivers<LivelinessCallback> liveliness_subscribers_;
  std::map<std::uint64_t, std::string> tokens_;
};

namespace {

using Hub = LoopbackNetwork::Hub;

// What a client's transport and its declarations share.
struct Client {
  std::shared_ptr<Hub> hub;
  CallbackGates gates;
  std::shared_ptr<std::atomic<bool>> is_closed = std::make_shared<std::atomic<bool>>(false);
  std::mutex mutex;
  std::set<std::uint64_t> declared;  // what close() has to remove

  TransportStatus check_open() const {
    if (*is_closed) return transport_failure(TransportErrorCode::kClosed, "", "the transport was closed");
    return {};
  }

  void remember(std::uint64_t id) {
    {
      const std::lock_guard lock(mutex);
      declared.insert(id);
      if (!*is_closed) return;
    }
    remove(id);  // closed while it was being declared
  }

  void remove(std::uint64_t id) {
    {
      const std::lock_guard lock(mutex);
      if (declared.erase(id) == 0) return;
    }
    hub->remove(id);
  }
};

class LoopbackDeclaration final : public Declaration {
 public:
  LoopbackDeclaration(std::shared_ptr<Client> client, std::uint64_t id, std::shared_ptr<CallbackGate> gate)
      : client_(std::move(client)), id_(id), gate_(std::move(gate)) {
    client_->remember(id_);
  }
  ~LoopbackDeclaration() override {
    client_->remove(id_);
    if (gate_ != nullptr) gate_->close();
  }

 private:
  std::shared_ptr<Client> client_;
  std::uint64_t id_;
  std::shared_ptr<CallbackGate> gate_;
};

class LoopbackPublisher final : public Publisher {
 public:
  LoopbackPublisher(std::shared_ptr<Client> client, std::string_view key) : client_(std::move(client)), key_(key) {}
  TransportStatus put(std::string_view payload) override {
    return client_->check_open().map([&] { client_->hub->put(key_, payload); });
  }

 private:
  std::shared_ptr<Client> client_;
  std::string key_;
};

class LoopbackTransport final : public Transport {
 public:
  explicit LoopbackTransport(std::shared_ptr<Hub> hub) { client_->hub = std::move(hub); }
  ~LoopbackTransport() override { close(); }

  TransportExpected<std::unique_ptr<Publisher>> declare_publisher(std::string_view key,
                                                                  const PublisherOptions&) override {
    return check(check_key(key)).map([&]() -> std::unique_ptr<Publisher> {
      return std::make_unique<LoopbackPublisher>(client_, key);
    });
  }

  TransportStatus put(std::string_view key, std::string_view payload, const PublisherOptions&) override {
    return check(check_key(key)).map([&] { client_->hub->put(key, payload); });
  }

  TransportExpected<DeclarationPtr> declare_queryable(std::string_view key_expression,
                                                      QueryCallback callback) override {
    return declare(key_expression, std::move(callback));
  }
  TransportExpected<DeclarationPtr> declare_subscriber(std::string_view key_expression,
                                                       SampleCallback callback) override {
    return declare(key_expression, std::move(callback));
  }
  TransportExpected<DeclarationPtr> declare_liveliness_subscriber(std::string_view key_expression,
                                                                  LivelinessCallback callback) override {
    return declare(key_expression, std::move(callback));
  }

  TransportExpected<DeclarationPtr> declare_liveliness_token(std::string_view key) override {
    return check(check_key(key)).map([&]() -> DeclarationPtr {
      return std::make_unique<LoopbackDeclaration>(client_, client_->hub->add_token(std::string(key)), nullptr);
    });
  }

  TransportStatus get(const GetRequest& request, GetCallbacks callbacks) override {
    return check(check_get(request)).map([&] {
      auto pending = std::make_shared<PendingGet>();
      pending->callbacks = std::move(callbacks);
      pending->gate = client_->gates.add();
      client_->hub->get(request, std::move(pending));
    });
  }

  void close() override {
    std::set<std::uint64_t> declared;
    {
      const std::lock_guard lock(client_->mutex);
      *client_->is_closed = true;
      declared = client_->declared;
    }
    for (const std::uint64_t id : declared) client_->remove(id);
    client_->gates.close();
  }

 private:
  TransportStatus check(TransportStatus key_status) const {
    return client_->check_open().and_then([&] { return std::move(key_status); });
  }

  template <class Callback>
  TransportExpected<DeclarationPtr> declare(std::string_view key_expression, Callback callback) {
    return check(check_key_expression(key_expression)).map([&]() -> DeclarationPtr {
      auto gate = client_->gates.add();
      auto receiver = std::make_shared<const Receiver<Callback>>(
          Receiver<Callback>{std::string(key_expression), std::move(callback), gate, client_->is_closed});
      const std::uint64_t id = client_->hub->add(std::move(receiver));
      return std::make_unique<LoopbackDeclaration>(client_, id, std::move(gate));
    });
  }

  std::shared_ptr<Client> client_ = std::make_shared<Client>();
};

}  // namespace

LoopbackNetwork::LoopbackNetwork() : hub_(std::make_shared<Hub>()) {}
LoopbackNetwork::~LoopbackNetwork() = default;

std::unique_ptr<Transport> LoopbackNetwork::connect() { return std::make_unique<LoopbackTransport>(hub_); }

}  // namespace urto

#include "accuracy/urto_simulator.h"

#include <algorithm>
#include <utility>

namespace urto::accuracy {
namespace {

// A scene that the engine refuses is a mistake in the case.
template <class T>
T expect(Expected<T> result) {
  if (!result)
    throw std::invalid_argument(result.error().field + " = " + result.error().value + ": " + result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

class UrtoSimulator : public Simulator {
 public:
  UrtoSimulator(const WorldSettings& settings, unsigned threads)
      : world_(expect(World::create(settings, nullptr, threads))) {}

  void add(const BodyDef& def) override {
    const BodyId id = expect(world_->add_body(def));
    numbers_.emplace_back(id, ids_.size());
    ids_.push_back(id);
  }
  void join(std::size_t a, std::size_t b, const JointDef& def) override {
    if (world_->settings().solver != SolverKind::kSoftStep) throw Lacks("joints in this solver");
    JointDef joint = def;
    joint.body_a = ids_[a];
    joint.body_b = ids_[b];
    expect(world_->add_joint(joint));
  }
  void step() override { world_->step(); }
  BodyState body(std::size_t number) const override { return *world_->body(ids_[number]); }
  void set_velocity(std::size_t number, const Vec2& velocity, double angular_velocity) override {
    expect(world_->set_velocity(ids_[number], velocity, angular_velocity));
  }
  std::vector<Touch> touches() const override {
    std::vector<Touch> out;
    for (const ContactPoint& p : world_->contacts())
      out.push_back({number_of(p.body_a), number_of(p.body_b), p.normal, p.normal_impulse, p.tangent_impulse});
    return out;
  }

 private:
  // Ids ascend with the order of adding, because nothing is ever removed.
  std::size_t number_of(BodyId id) const {
    return std::lower_bound(numbers_.begin(), numbers_.end(), std::pair<BodyId, std::size_t>(id, 0))->second;
  }

  std::unique_ptr<World> world_;
  std::vector<BodyId> ids_;
  std::vector<std::pair<BodyId, std::size_t>> numbers_;
};

}  // namespace

std::unique_ptr<Simulator> make_urto(const WorldSettings& settings) { return make_urto_on(1, settings); }

std::unique_ptr<Simulator> make_urto_on(unsigned threads, const WorldSettings& settings) {
  return std::make_unique<UrtoSimulator>(settings, threads);
}

}  // namespace urto::accuracy

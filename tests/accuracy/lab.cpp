#include "accuracy/lab.h"

#include <algorithm>
#include <cmath>

namespace urto::accuracy {

Run::Run(Lab& lab, const Scene& scene)
    : lab_(lab), settings_(lab.method_.applied_to(scene.settings)), bodies_(scene.bodies) {
  simulator_ = lab.engine_(settings_);
  for (const BodyDef& def : scene.bodies) simulator_->add(def);
  for (const Scene::Link& link : scene.links) simulator_->join(link.a, link.b, link.def);
}

void Run::steps(long count) {
  const double start = lab_.clock_ ? lab_.clock_() : 0;
  for (long i = 0; i < count; ++i) simulator_->step();
  if (lab_.clock_) lab_.cpu_seconds_ += lab_.clock_() - start;
  lab_.simulated_seconds_ += time_step() * static_cast<double>(count);
  steps_ += count;
}

void Run::seconds(double duration) { steps(std::lround(duration / time_step())); }

std::vector<BodyState> Run::states() const {
  std::vector<BodyState> out;
  for (std::size_t i = 0; i < bodies_.size(); ++i) out.push_back(body(i));
  return out;
}

double Run::kinetic_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].type == BodyType::kDynamic) sum += accuracy::kinetic_energy(bodies_[i], body(i));
  return sum;
}

double Run::energy(double gravity) const {
  double sum = kinetic_energy();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].type == BodyType::kDynamic) sum += mass_of(bodies_[i]) * gravity * body(i).position.y();
  return sum;
}

double Run::speed_max() const {
  double most = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].type == BodyType::kDynamic) most = std::max(most, body(i).velocity.norm());
  return most;
}

}  // namespace urto::accuracy

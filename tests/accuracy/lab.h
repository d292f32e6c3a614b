#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "accuracy/method.h"
#include "accuracy/scene.h"
#include "accuracy/simulator.h"

namespace urto::accuracy {

class Lab;

// A scene in an engine, computed by the lab's method.
class Run {
 public:
  Run(Lab& lab, const Scene& scene);

  void steps(long count);
  void seconds(double duration);  // to the nearest step
  BodyState body(std::size_t number) const { return simulator_->body(number); }
  std::vector<BodyState> states() const;
  std::vector<Touch> touches() const { return simulator_->touches(); }
  void set_velocity(std::size_t number, const Vec2& velocity, double angular_velocity) {
    simulator_->set_velocity(number, velocity, angular_velocity);
  }

  double time_step() const { return settings_.time_step; }               // s
  double sub_step() const { return time_step() / settings_.sub_steps; }  // s
  double time() const { return time_step() * static_cast<double>(steps_); }
  Integrator integrator() const { return settings_.integrator; }
  double kinetic_energy() const;        // J
  double energy(double gravity) const;  // J, with the height above y = 0 of every dynamic body
  double speed_max() const;             // m/s, of centres
  double overlap_max() const { return accuracy::overlap_max(bodies_, states()); }  // m
  const std::vector<BodyDef>& bodies() const { return bodies_; }

 private:
  Lab& lab_;
  WorldSettings settings_;
  std::vector<BodyDef> bodies_;
  std::unique_ptr<Simulator> simulator_;
  long steps_ = 0;
};

// What a case is measured in: an engine, a method, and what the steps took.
class Lab {
 public:
  using CpuSeconds = double (*)();

  // Without a clock nothing is timed.
  Lab(Engine engine, Method method, CpuSeconds clock = nullptr)
      : engine_(std::move(engine)), method_(std::move(method)), clock_(clock) {}

  const Method& method() const { return method_; }
  double cpu_seconds() const { return cpu_seconds_; }
  double simulated_seconds() const { return simulated_seconds_; }
  // A lab of the same engine and clock with another method, whose costs are added to this one's.
  template <class Function>
  double with_step_scale(double scale, Function&& function);

 private:
  friend class Run;
  Engine engine_;
  Method method_;
  CpuSeconds clock_;
  double cpu_seconds_ = 0, simulated_seconds_ = 0;
};

template <class Function>
double Lab::with_step_scale(double scale, Function&& function) {
  Lab other(engine_, method_, clock_);
  other.method_.step_scale *= scale;
  const double result = function(other);
  cpu_seconds_ += other.cpu_seconds_;
  simulated_seconds_ += other.simulated_seconds_;
  return result;
}

}  // namespace urto::accuracy

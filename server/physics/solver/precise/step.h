#pragma once

#include <optional>
#include <vector>

#include "physics/solver/precise/collision.h"
#include "physics/solver/precise/newton.h"
#include "physics/solver/precise/path.h"
#include "physics/solver/precise/precise.h"
#include "physics/solver/precise/touch.h"

namespace urto {

// One step of the precise solver, and the buffers it works with.
class PreciseStep {
 public:
  void run(WorldData<double>& world);

 private:
  // What the step knows of a contact besides what the world does.
  struct Pair {
    double normal_force[2] = {0, 0}, tangent_force[2] = {0, 0};  // N, at the contact's points
    double force_x = 0, force_y = 0, torque = 0;                 // N on b, −N on a, and N·m on both together
    double since = 0;                                            // s into the step: from when on they act
    double silent_until = 0;                                     // s into the step: not looked at before
    double silence = 0;                                          // s, of the last time that it was looked at in vain
    std::uint32_t bounces = 0;                                   // impacts with restitution
    std::uint32_t stops = 0;                                     // ends of sliding
    std::uint32_t strikes = 0;                                   // all impacts
    std::uint32_t touch_id = 0;                                  // of the first point
    std::uint32_t cluster = 0;                                   // serial of the last one that saw it
    std::uint32_t held = 0;                                      // points that the last settlement held closed
    std::uint32_t scheduled = 0;  // serial of the last cluster after which it was looked at
  };
  // Two shapes that touch within the cluster.
  struct Touching {
    std::uint32_t contact;
    Touch touch;
  };
  struct Event {
    double time;
    std::uint32_t contact;
    std::uint32_t version_a, version_b;
  };
  // Order of the heap: the earliest event on top.
  static bool later(const Event& x, const Event& y) {
    return x.time != y.time ? x.time > y.time : x.contact > y.contact;
  }
  // Where a point of the problem comes from.
  struct Origin {
    std::uint32_t touching, point;
  };

  // step.cpp: the course of the step.
  void begin();
  void widen_bounds(const std::vector<std::uint32_t>& slots);
  void start_path(std::uint32_t slot, double now);
  void settle_all();
  void schedule_all();
  void take_events();
  void take(const Event& event);
  void finish();

  // schedule.cpp: when pairs will meet.
  void schedule(std::uint32_t contact, double now);
  std::optional<double> closing_time(std::uint32_t contact, double now) const;

  // cluster.cpp: bodies that touch at a moment.
  void settle(std::uint32_t seed, double now);
  void gather(std::uint32_t seed, double now);
  void look_around(std::uint32_t slot, double now);
  void join(std::uint32_t slot, double now);
  bool far_apart(const Contact<double>& c, const Path& a, const Path& b) const;
  void account(std::uint32_t contact, double now);
  void balance(std::uint32_t contact, double now);
  void turn_both(const Contact<double>& c, double angular_impulse);
  void adopt(const Touching& touching);
  void stop_cluster();

  // impacts.cpp: what happens to a cluster at once.
  void take_impacts();
  const Touching* hardest_impact() const;
  void collide(const Touching& touching);
  void stop_approach();
  Collision collision_of(const Contact<double>& c);
  void add_impulse(std::uint32_t contact, std::uint32_t point, const PointImpulse& impulse);
  double parting(const Touching& touching, int point) const;

  // forces.cpp: the forces of a cluster over the rest of the step.
  enum class Purpose : std::uint8_t { kImpact, kForces, kPlaces };
  void build_problem(Purpose purpose, double duration);
  void add_point(Purpose purpose, std::uint32_t index, std::uint32_t point, double duration);
  void part_overlaps();
  void find_forces(double now);
  double until_stop(std::uint32_t& contact) const;
  void take_forces(double duration);

  WorldData<double>* world_ = nullptr;
  std::optional<Thrust> thrust_;
  double h_ = 0;
  std::vector<Path> paths_;              // by body slot
  std::vector<std::uint32_t> versions_;  // by body slot: counts changes of the path
  std::vector<std::uint32_t> serials_;   // by body slot: the last cluster it was in
  std::vector<std::uint32_t> locals_;    // by body slot: its number in the problem
  std::vector<Pair> pairs_;              // by contact slot
  std::vector<Event> events_;            // a heap
  std::uint32_t serial_ = 0;
  std::uint64_t work_done_ = 0, work_most_ = 0;

  std::vector<std::uint32_t> cluster_;  // body slots
  std::vector<std::uint32_t> changed_;  // body slots with new paths
  std::vector<Touching> touching_;
  std::vector<Origin> origins_;  // by point of the problem
  ContactProblem problem_;
  ProblemWorkspace workspace_;
};

}  // namespace urto

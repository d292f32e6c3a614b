#include "app/scene_cost.h"

#include <algorithm>
#include <cstdio>

namespace urto::app {
namespace {

constexpr std::size_t kPhases = static_cast<std::size_t>(Phase::kCount);

void add(Profile& sum, const Profile& profile) {
  for (std::size_t phase = 0; phase < kPhases; ++phase) sum.ms[phase] += profile.ms[phase];
  sum.step_ms += profile.step_ms;
}

Profile mean(Profile sum, std::uint32_t count) {
  for (double& ms : sum.ms) ms /= count;
  sum.step_ms /= count;
  return sum;
}

std::string line(const char* name, double mean_ms, double longest_ms, double step_ms) {
  char text[96];
  const double percent = step_ms > 0 ? 100 * mean_ms / step_ms : 0;
  std::snprintf(text, sizeof(text), "  %-22s %9.4f %9.4f %5.0f %%\n", name, mean_ms, longest_ms, percent);
  return text;
}

}  // namespace

SceneCost measure_cost(Room& room) {
  SceneCost cost;
  Profile awake, all;
  while (cost.steps < kCostStepsMax && all.step_ms < kCostMsMax) {
    const bool is_awake = room.world().counters().awake_bodies > 0;
    room.tick();
    const Profile profile = room.world().profile();
    add(all, profile);
    if (is_awake) add(awake, profile);
    for (std::size_t phase = 0; phase < kPhases; ++phase)
      cost.longest.ms[phase] = std::max(cost.longest.ms[phase], profile.ms[phase]);
    cost.longest.step_ms = std::max(cost.longest.step_ms, profile.step_ms);
    ++cost.steps;
    cost.awake_steps += is_awake;
  }
  cost.mean = cost.awake_steps > 0 ? mean(awake, cost.awake_steps) : mean(all, cost.steps);
  cost.last = room.world().counters();
  return cost;
}

std::string cost_text(const SceneCost& cost, unsigned threads) {
  char head[256];
  std::snprintf(
      head, sizeof(head),
      "What a step costs, measured now on this machine by the clock, on %u thread%s: of the first %u steps the %u "
      "with anybody awake.\nIn the end %u of %u bodies are awake and %u pairs touch.\n  %-22s %9s %9s\n",
      threads, threads == 1 ? "" : "s", cost.steps, cost.awake_steps, cost.last.awake_bodies, cost.last.bodies,
      cost.last.contacts, "phase", "mean, ms", "most, ms");
  std::string text = head;
  for (std::size_t phase = 0; phase < kPhases; ++phase)
    text += line(phase_name(static_cast<Phase>(phase)), cost.mean.ms[phase], cost.longest.ms[phase], cost.mean.step_ms);
  return text + line("the step", cost.mean.step_ms, cost.longest.step_ms, cost.mean.step_ms);
}

}  // namespace urto::app

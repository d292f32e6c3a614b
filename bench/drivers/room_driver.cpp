// Runs a scene in one of Urto's rooms: whole ticks, and the encoding of their snapshots, as a server's threads do both.
//   bench_room SCENE_FILE [--steps N] [--skip N] [--simd NAME]
#include "codec/snapshot_codec.h"
#include "report.h"
#include "room/room.h"
#include "scene_file.h"
#include "urto_scene.h"

namespace bench {
namespace {

// Only what a room needs of a benchmark's scene: bodies. Joints and what moves by itself are refused.
urto::SceneDef room_scene(const Scene& scene) {
  if (!scene.revolutes.empty() || !scene.sways.empty()) {
    std::fputs("the rooms of the benchmark have bodies alone\n", stderr);
    std::exit(2);
  }
  urto::SceneDef def;
  def.name = scene.name;
  def.world = world_settings(scene);
  for (const Body& body : scene.bodies) {
    urto::BodySpec& spec = def.bodies.emplace_back();
    spec.def = body_def(body);
  }
  return def;
}

// Mean times of a step of what a tick does, beside the step.
struct Sums {
  double step_ms = 0, encode_cpu_ms = 0;
  std::size_t bytes = 0;
};

void run(const Arguments& arguments) {
  const Scene scene = read_scene(arguments.scene_path);
  const int steps = arguments.steps > 0 ? arguments.steps : scene.steps;
  Report report;
  report.simd = choose_simd(arguments.simd);
  report.step_ms.reserve(static_cast<std::size_t>(steps));
  const std::uint64_t heap_before = heap_bytes();
  const auto make_world = [](const urto::WorldSettings& settings) {
    return urto::World::create(settings, nanoseconds);
  };
  const auto room = expect(urto::Room::create({}, room_scene(scene), make_world));
  report.heap_built = heap_bytes() - heap_before;
  room->join({"watcher", "1"});

  for (int step = 0; step < arguments.skip; ++step) room->tick();
  urto::codec::SnapshotEncoder encoder;
  Sums sums;
  start_counting_instructions();
  for (int step = 0; step < steps; ++step) {
    urto::TickResult result;
    time_step(report, [&] { result = room->tick(); });
    sums.step_ms += room->world().profile().step_ms;
    const double start = cpu_ms();
    sums.bytes += encoder.encode(*result.frame).size();
    sums.encode_cpu_ms += cpu_ms() - start;
  }
  stop_counting_instructions();
  report.heap_stepped = heap_bytes() - heap_before;
  report.engine = "urto room";
  report.version = BENCH_URTO_VERSION;
  report.scene = scene.name;
  for (const Body& body : scene.bodies) report.bodies += body.kind == BodyKind::kDynamic ? 1 : 0;
  report.awake = room->world().counters().awake_bodies;
  report.pairs = room->world().counters().pairs;
  report.touching = room->world().counters().contacts;
  report.hash = hexadecimal(room->world().state_hash());
  report.phases_ms = {{"step", sums.step_ms / steps},
                      {"encode", sums.encode_cpu_ms / steps},
                      {"snapshot_bytes", static_cast<double>(sums.bytes) / steps}};
  report.print();
}

}  // namespace
}  // namespace bench

int main(int count, char** values) { bench::run(bench::parse_arguments(count, values)); }

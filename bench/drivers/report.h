#pragma once

// What a driver tells of one run: one line of JSON on standard output.

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace bench {

struct Report {
  std::string engine, version, scene;
  std::string simd;  // the instruction set, where the engine chooses one as it starts
  int threads = 1;
  std::vector<double> step_ms;                            // by the wall clock
  double cpu_ms_sum = 0;                                  // of all threads of the program
  std::uint64_t bodies = 0;                               // dynamic ones
  std::uint64_t awake = 0;                                // dynamic and kinematic ones, at the end
  std::uint64_t pairs = 0;                                // of shapes whose bounds overlap, at the end
  std::uint64_t touching = 0;                             // of shapes, at the end
  std::string hash;                                       // of the final state, hexadecimal
  std::uint64_t heap_built = 0, heap_stepped = 0;         // bytes that the world takes: as built, and at the end
  std::vector<std::pair<std::string, double>> phases_ms;  // mean of a step
  // With --states: x, y, angle, velocity x and y, spin of every body at the end, in the order of the scene.
  std::vector<std::array<double, 6>> states;

  void print() const;
};

// Processor time of this program so far, in milliseconds.
double cpu_ms();

// Bytes in use on the heap of this program.
std::uint64_t heap_bytes();

// Valgrind's callgrind, where the program runs in it, counts instructions from here on (--instr-atstart=no).
void start_counting_instructions();
void stop_counting_instructions();

// Makes the call and notes what it took.
template <class Call>
void time_step(Report& report, Call&& call) {
  const double cpu_start = cpu_ms();
  const auto start = std::chrono::steady_clock::now();
  call();
  report.step_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  report.cpu_ms_sum += cpu_ms() - cpu_start;
}

// FNV-1a over the bytes of floats, for engines that have no hash of their own.
class Hash {
 public:
  void add(float value);
  std::string text() const;

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::string hexadecimal(std::uint64_t value);

// The arguments of every driver: SCENE_FILE [--threads N] [--steps N] [--skip N] [--states] [--simd NAME].
struct Arguments {
  std::string scene_path;
  std::string simd;  // of Urto alone; empty: the widest of the machine
  int threads = 1;
  int steps = 0;  // that are measured; 0: as the scene says
  int skip = 0;   // before them
  bool states = false;
};
Arguments parse_arguments(int count, char** values);

}  // namespace bench

#include "report.h"

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <numeric>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION static_cast<void>(0)
#define CALLGRIND_STOP_INSTRUMENTATION static_cast<void>(0)
#endif

namespace bench {

double cpu_ms() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

std::uint64_t heap_bytes() {
  const auto facts = mallinfo2();
  return facts.uordblks + facts.hblkhd;
}

void start_counting_instructions() { CALLGRIND_START_INSTRUMENTATION; }
void stop_counting_instructions() { CALLGRIND_STOP_INSTRUMENTATION; }

void Report::print() const {
  std::vector<double> sorted = step_ms;
  std::sort(sorted.begin(), sorted.end());
  const double mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
  std::printf("{\"engine\":\"%s\",\"version\":\"%s\",\"scene\":\"%s\",\"threads\":%d,\"steps\":%zu,", engine.c_str(),
              version.c_str(), scene.c_str(), threads, sorted.size());
  std::printf("\"cpu_ms\":%.6f,", cpu_ms_sum / static_cast<double>(sorted.size()));
  std::printf("\"mean_ms\":%.6f,\"median_ms\":%.6f,\"min_ms\":%.6f,\"max_ms\":%.6f,", mean, sorted[sorted.size() / 2],
              sorted.front(), sorted.back());
  if (!simd.empty()) std::printf("\"simd\":\"%s\",", simd.c_str());
  std::printf("\"heap_built\":%llu,\"heap_stepped\":%llu,", static_cast<unsigned long long>(heap_built),
              static_cast<unsigned long long>(heap_stepped));
  std::printf("\"awake\":%llu,", static_cast<unsigned long long>(awake));
  std::printf("\"bodies\":%llu,\"pairs\":%llu,\"touching\":%llu,\"hash\":\"%s\",\"phases_ms\":{",
              static_cast<unsigned long long>(bodies), static_cast<unsigned long long>(pairs),
              static_cast<unsigned long long>(touching), hash.c_str());
  for (std::size_t i = 0; i < phases_ms.size(); ++i) {
    std::printf("%s\"%s\":%.6f", i == 0 ? "" : ",", phases_ms[i].first.c_str(), phases_ms[i].second);
  }
  std::printf("}");
  for (std::size_t body = 0; body < states.size(); ++body) {
    std::printf("%s", body == 0 ? ",\"states\":[" : ",");
    for (std::size_t i = 0; i < states[body].size(); ++i) std::printf("%c%.9g", i == 0 ? '[' : ',', states[body][i]);
    std::printf("%s", body + 1 == states.size() ? "]]" : "]");
  }
  std::printf("}\n");
}

void Hash::add(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  for (int byte = 0; byte < 4; ++byte) value_ = (value_ ^ (bits >> (8 * byte) & 0xffu)) * 0x100000001b3u;
}

std::string Hash::text() const { return hexadecimal(value_); }

std::string hexadecimal(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(value));
  return text;
}

Arguments parse_arguments(int count, char** values) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    const std::string word = values[i];
    if (word == "--threads" && i + 1 < count) {
      arguments.threads = std::atoi(values[++i]);
    } else if (word == "--steps" && i + 1 < count) {
      arguments.steps = std::atoi(values[++i]);
    } else if (word == "--skip" && i + 1 < count) {
      arguments.skip = std::atoi(values[++i]);
    } else if (word == "--simd" && i + 1 < count) {
      arguments.simd = values[++i];
    } else if (word == "--states") {
      arguments.states = true;
    } else {
      arguments.scene_path = word;
    }
  }
  if (arguments.scene_path.empty() || arguments.threads < 1) {
    std::fprintf(stderr, "usage: %s SCENE_FILE [--threads N] [--steps N] [--skip N] [--states] [--simd NAME]\n",
                 values[0]);
    std::exit(2);
  }
  return arguments;
}

}  // namespace bench

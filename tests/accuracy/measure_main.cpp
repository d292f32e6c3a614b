// Measures a case in one engine and prints a line of JSON.
//
//   accuracy_ENGINE --list
//       the cases: row, names, levels
//   accuracy_ENGINE CASE METHOD [--runs N] [--budget S]
//       the error, and the least CPU time of N runs, fewer after S seconds
//   accuracy_ENGINE --rectangles N METHOD --steps N [--threads N]
//       what a step with so many rectangles takes (on several threads by the wall clock), and how they overlap
//   accuracy_ENGINE --check [--long]
//       every level: one line each of those that are not met
//   … --simd NAME
//       the instruction set, e.g. AVX2 (Urto)

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "accuracy/case.h"
#include "accuracy/engine.h"
#include "accuracy/features.h"
#include "accuracy/method_text.h"
#include "accuracy/rectangles.h"
#include "accuracy/replay.h"
#include "physics/solver/contact_kernels.h"

namespace urto::accuracy {
namespace {

constexpr int kOverlapCountMax = 2000;  // beyond, looking at all pairs would take longer than the steps

// Of the whole program: with several threads, of all of them.
double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_seconds() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::unique_ptr<Simulator> on_one_thread(const WorldSettings& settings) { return make_engine(settings, 1); }

std::string quoted(const std::string& text) {
  std::string out(1, '"');
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  out += '"';
  return out;
}

// JSON has no infinity.
std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

void print_list() {
  for (const Case& each : all_cases()) {
    std::string levels;
    for (const Level& level : each.levels)
      levels.append(levels.empty() ? "" : ",")
          .append(quoted(name_of(level.profile)))
          .append(":")
          .append(number(level.error_max));
    std::printf(
        "{\"row\":%d,\"case\":%s,\"title\":%s,\"metric\":%s,\"unit\":%s,\"curves\":%s,\"long\":%s,"
        "\"levels\":{%s}}\n",
        each.row, quoted(each.name).c_str(), quoted(each.title).c_str(), quoted(each.metric).c_str(),
        quoted(each.unit).c_str(), each.curves == Curves::kIntegrators ? "\"integrators\"" : "\"solvers\"",
        each.is_long ? "true" : "false", levels.c_str());
  }
}

struct Effort {
  int runs = 1;
  double budget_s = std::numeric_limits<double>::infinity();
};

void measure(const Case& a_case, const Method& method, const Effort& effort) {
  std::string head = std::string("{\"engine\":") + quoted(engine_name()) + ",\"version\":" + quoted(engine_version()) +
                     ",\"case\":" + quoted(a_case.name) + ",\"method\":" + quoted(method.name);
  double error = 0, cost = std::numeric_limits<double>::infinity();
  const double start = cpu_seconds();
  int runs = 0;
  try {
    while (runs == 0 || (runs < effort.runs && cpu_seconds() - start < effort.budget_s)) {
      ++runs;
      Lab lab(on_one_thread, method, cpu_seconds);
      error = error_of(a_case, lab);
      cost = std::min(cost, lab.cpu_seconds() / lab.simulated_seconds());
    }
  } catch (const Lacks& lacks) {
    std::printf("%s,\"lacks\":%s}\n", head.c_str(), quoted(lacks.what()).c_str());
    return;
  }
  std::printf("%s,\"error\":%s,\"cpu_s_per_s\":%s,\"runs\":%d}\n", head.c_str(), number(error).c_str(),
              number(cost).c_str(), runs);
}

// Overlap: of the deepest pair, the mean of four looks over the second half.
void measure_rectangles(int count, const Method& method, int steps, unsigned threads) {
  const auto engine = [threads](const WorldSettings& settings) { return make_engine(settings, threads); };
  Lab lab(engine, method, threads > 1 ? wall_seconds : cpu_seconds);
  Run run(lab, rectangles(count));
  run.steps(steps / 2);
  double overlap = 0;
  constexpr int kLooks = 4;
  for (int look = 0; look < kLooks; ++look) {
    run.steps(steps / 2 / kLooks);
    if (count <= kOverlapCountMax) overlap += run.overlap_max() / kLooks;
  }
  const double step_ms = 1e3 * lab.cpu_seconds() / (lab.simulated_seconds() / run.time_step());
  std::printf("{\"engine\":%s,\"method\":%s,\"rectangles\":%d,\"steps\":%d,\"step_ms\":%s,\"overlap\":%s}\n",
              quoted(engine_name()).c_str(), quoted(method.name).c_str(), count, steps, number(step_ms).c_str(),
              count <= kOverlapCountMax ? number(overlap).c_str() : "null");
}

// The two scenes take turns, so that whatever else the machine does meets both.
void measure_features(int runs, int steps) {
  for (const FeatureCase& each : feature_cases()) {
    double without_ms = std::numeric_limits<double>::infinity(), idle_ms = without_ms;
    for (int i = 0; i < runs; ++i) {
      for (const bool idle : {false, true}) {
        Lab lab(on_one_thread, Method{}, cpu_seconds);
        Run run(lab, idle ? each.idle : each.without);
        run.steps(steps);
        double& least = idle ? idle_ms : without_ms;
        least = std::min(least, 1e3 * lab.cpu_seconds() / steps);
      }
    }
    std::printf("{\"feature\":%s,\"scene\":%s,\"without_ms\":%s,\"idle_ms\":%s}\n", quoted(each.feature).c_str(),
                quoted(each.scene).c_str(), number(without_ms).c_str(), number(idle_ms).c_str());
  }
}

// As tests/accuracy/expected_failures.txt has them.
void check(bool with_long) {
  for (const Case& each : all_cases()) {
    for (const Level& level : each.levels) {
      if (each.is_long && !with_long) continue;
      const double start = cpu_seconds();
      Lab lab(on_one_thread, method_of(level.profile));
      double error = std::numeric_limits<double>::infinity();
      try {
        error = error_of(each, lab);
      } catch (const Lacks&) {
        continue;
      }
      std::fprintf(stderr, "%-28s %-20s %.3g (level %.3g)%s  %.2f s\n", each.name.c_str(),
                   name_of(level.profile).c_str(), error, level.error_max, error <= level.error_max ? "" : "  MISSED",
                   cpu_seconds() - start);
      if (!(error <= level.error_max))
        std::printf("%d %s %s %.4g\n", each.row, each.name.c_str(), name_of(level.profile).c_str(), error);
    }
  }
}

void choose_simd(const std::string& name) {
  for (const SimdTarget& target : simd_targets())
    if (target.name == name) return use_simd_target(target.id);
  std::string known;
  for (const SimdTarget& target : simd_targets()) known += " " + target.name;
  throw std::invalid_argument("this machine has no " + name + " but" + known);
}

struct Arguments {
  std::vector<std::string> names;
  Effort effort;
  int rectangles = 0, steps = 240;
  unsigned threads = 1;
  bool list = false, check = false, with_long = false, replay = false, features = false;
};

Arguments parse(const std::vector<std::string>& words) {
  Arguments out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--runs") {
      out.effort.runs = std::stoi(words.at(++i));
    } else if (words[i] == "--budget") {
      out.effort.budget_s = std::stod(words.at(++i));
    } else if (words[i] == "--rectangles") {
      out.rectangles = std::stoi(words.at(++i));
    } else if (words[i] == "--steps") {
      out.steps = std::stoi(words.at(++i));
    } else if (words[i] == "--threads") {
      out.threads = static_cast<unsigned>(std::stoul(words.at(++i)));
    } else if (words[i] == "--simd") {
      choose_simd(words.at(++i));
    } else if (words[i] == "--list") {
      out.list = true;
    } else if (words[i] == "--check") {
      out.check = true;
    } else if (words[i] == "--replay") {
      out.replay = true;
    } else if (words[i] == "--features") {
      out.features = true;
    } else if (words[i] == "--long") {
      out.with_long = true;
    } else {
      out.names.push_back(words[i]);
    }
  }
  return out;
}

int run(const std::vector<std::string>& words) {
  const Arguments arguments = parse(words);
  const std::vector<std::string>& names = arguments.names;
  if (arguments.list) {
    print_list();
  } else if (arguments.check) {
    check(arguments.with_long);
  } else if (arguments.features) {
    measure_features(arguments.effort.runs, arguments.steps);
  } else if (arguments.rectangles > 0 && names.size() == 1) {
    measure_rectangles(arguments.rectangles, method_from(names[0]), arguments.steps, arguments.threads);
  } else if (names.size() == 2 && find_case(names[0]) && arguments.replay) {
    std::puts(replay(*find_case(names[0]), method_from(names[1]), arguments.steps).c_str());
  } else if (names.size() == 2 && find_case(names[0])) {
    measure(*find_case(names[0]), method_from(names[1]), arguments.effort);
  } else {
    throw std::invalid_argument("no such case, or nothing to do; the head of measure_main.cpp says how");
  }
  return 0;
}

}  // namespace
}  // namespace urto::accuracy

int main(int count, char** values) {
  try {
    return urto::accuracy::run({values + 1, values + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", values[0], error.what());
    return 2;
  }
}

#include "accuracy/engine.h"
#include "accuracy/urto_simulator.h"

namespace urto::accuracy {

std::string engine_name() { return "urto"; }
std::string engine_version() { return URTO_ACCURACY_VERSION; }
std::unique_ptr<Simulator> make_engine(const WorldSettings& settings, unsigned threads) {
  return make_urto_on(threads, settings);
}

}  // namespace urto::accuracy

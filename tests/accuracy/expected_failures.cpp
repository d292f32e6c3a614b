#include "accuracy/expected_failures.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace urto::accuracy {

ExpectedFailures read_expected_failures(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  ExpectedFailures out;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string row, name, profile, figure, rest;
    if (!(words >> row >> name >> profile >> figure) || words >> rest) throw std::runtime_error(path + ": " + line);
    if (!out.emplace(std::pair(name, profile), std::stod(figure)).second)
      throw std::runtime_error(path + ": twice: " + line);
  }
  return out;
}

}  // namespace urto::accuracy

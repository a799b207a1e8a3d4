#include "geometry/base/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <utility>

namespace billet {

namespace {

namespace fs = std::filesystem;

std::optional<double> number_in(const fs::path& file) {
  std::ifstream stream(file);
  double number = 0.0;
  return stream >> number ? std::optional(number) : std::nullopt; // "max" is none
}

/// MemAvailable of the kernel.
std::optional<double> left_of_machine() {
  constexpr double kilobyte = 1024.0;
  std::ifstream stream("/proc/meminfo");
  for (std::string key; stream >> key;) {
    double value = 0.0;
    if (key == "MemAvailable:" && stream >> value)
      return kilobyte * value;
    stream.ignore(200, '\n');
  }
  return std::nullopt;
}

/// Folders of the control groups that limit this process: lines "5:memory:/a/b", or "0::/a/b".
std::optional<double> left_of_group() {
  constexpr std::size_t most_levels = 64;
  std::optional<double> least;
  std::ifstream stream("/proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos)
      continue;
    const std::string kind = line.substr(first + 1, second - first - 1);
    const bool unified = kind.empty();
    if (!unified && kind != "memory")
      continue;
    const fs::path root = unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    fs::path group = fs::path(line.substr(second + 1)).relative_path();
    for (std::size_t level = 0; level < most_levels; ++level) {
      const fs::path folder = root / group;
      const auto limit = number_in(folder / (unified ? "memory.max" : "memory.limit_in_bytes"));
      const auto used = number_in(folder / (unified ? "memory.current" : "memory.usage_in_bytes"));
      if (limit && used && !(least && *least <= *limit - *used))
        least = *limit - *used;
      if (group.empty())
        break;
      group = group.parent_path();
    }
  }
  return least;
}

/// What `ulimit -v` leaves.
std::optional<double> left_of_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::nullopt;
  return static_cast<double>(limit.rlim_cur);
}

} // namespace

std::optional<double> available_memory() {
  std::optional<double> least;
  for (const std::optional<double>& left : {left_of_machine(), left_of_group(), left_of_limit()})
    if (left && !(least && *least <= *left))
      least = std::max(0.0, *left);
  return least;
}

} // namespace billet

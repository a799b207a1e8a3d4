#include "app/start_note.h"

#include "io/results/atomic_file.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/utsname.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "study/runs.h"

namespace billet::app {

namespace {

using nlohmann::ordered_json;

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A word as a shell takes it.
std::string shell_word(const std::string& word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  const bool is_plain = !word.empty() && word.find_first_not_of(plain) == std::string::npos;
  return is_plain ? word : study::quoted(word);
}

/// The words this program was called with.
std::string command_line() {
  const std::string words = content_of("/proc/self/cmdline");
  std::string line;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find('\0', at), words.size());
    line.append(line.empty() ? "" : " ").append(shell_word(words.substr(at, end - at)));
    at = end + 1;
  }
  return line;
}

std::string processor() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);)
    if (const std::size_t colon = line.find(": ");
        line.starts_with("model name") && colon != std::string::npos)
      return line.substr(colon + 2);
  return {};
}

} // namespace

void note_start(const std::filesystem::path& folder, int threads, bool resumed) {
  const std::filesystem::path file = folder / "starts.json";
  ordered_json starts = ordered_json::array();
  if (resumed)
    if (ordered_json earlier = ordered_json::parse(content_of(file), nullptr, false);
        earlier.is_array())
      starts = std::move(earlier);
  utsname system{};
  ::uname(&system);
  std::error_code error;
  starts.push_back(
      {{"begun", fmt::format("{:%Y-%m-%d %H:%M:%S %z}", fmt::localtime(std::time(nullptr)))},
       {"command", command_line()},
       {"folder", std::filesystem::current_path(error).string()},
       {"billet", BILLET_VERSION},
       {"threads", threads},
       {"machine", system.nodename},
       {"processor", processor()},
       {"cores", std::thread::hardware_concurrency()},
       {"system", fmt::format("{} {} {}", system.sysname, system.release, system.machine)}});
  io::write_file(file, starts.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

} // namespace billet::app

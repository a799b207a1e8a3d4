// billet report: a page of a run's results that opens in a browser.

#include "app/command_line.h"
#include "app/render.h"
#include "app/report/page.h"
#include "geometry/base/error.h"
#include "geometry/base/stopwatch.h"
#include "io/results/atomic_file.h"
#include "io/text/home_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <system_error>
#include <thread>

namespace billet::app {

namespace {

namespace fs = std::filesystem;

fs::path page_file(const Arguments& arguments, const fs::path& results) {
  constexpr const char* usual = "report.html";
  if (!arguments.output)
    return results / usual;
  std::error_code error;
  if (fs::is_directory(*arguments.output, error))
    return *arguments.output / usual;
  const std::string suffix = arguments.output->extension().string();
  if (suffix != ".html" && suffix != ".htm")
    throw Error(
        Fault::usage, "",
        fmt::format("the page \"{}\" should have the suffix .html", arguments.output->string()));
  return *arguments.output;
}

struct Made {
  bool goes_on = false; ///< the run
  double seconds = 0.0;
  std::size_t bytes = 0;
  bool has_view = false;
};

/// @param reload_after  as long as the run goes on; zero: never [s]
Made make_page(const fs::path& results, const fs::path& file, int reload_after) {
  const double begin = seconds_now();
  const report::ResultsFolder content = report::read_results(results);
  report::PageSettings settings;
  settings.bundle = report::find_bundle(own_file());
  Made made;
  made.goes_on = content.state == report::RunState::running;
  made.has_view = settings.bundle.has_value();
  if (made.goes_on && reload_after > 0)
    settings.reload_after = reload_after;
  const std::string page = report::page_of(content, settings);
  io::write_file(file, page);
  made.bytes = page.size();
  made.seconds = seconds_now() - begin;
  return made;
}

void tell(const fs::path& file, const Made& made, bool quiet) {
  if (quiet)
    return;
  fmt::print("report: {}\n{:.2f} MB in {:.2f} s{}\n", file.string(),
             1e-6 * static_cast<double>(made.bytes), made.seconds,
             made.goes_on ? ", of a run that is going on" : "");
  if (!made.has_view)
    fmt::print("without the view of the frames: ./dev build --report builds it\n");
  std::fflush(stdout);
}

/// At most a fifth of the time goes into pages.
int interval_after(double seconds) {
  constexpr double least = 5.0, times = 4.0;
  return static_cast<int>(std::ceil(std::max(least, times * seconds)));
}

} // namespace

int make_report(const Arguments& arguments) {
  const fs::path results = io::with_home_folder(arguments.file, "RESULTS");
  const fs::path file = page_file(arguments, results);
  int interval = interval_after(0.0);
  Made made = make_page(results, file, arguments.follow ? interval : 0);
  tell(file, made, arguments.quiet);
  while (arguments.follow && made.goes_on) {
    interval = interval_after(made.seconds);
    std::this_thread::sleep_for(std::chrono::seconds(interval));
    made = make_page(results, file, interval);
    if (!made.goes_on)
      tell(file, made, arguments.quiet);
  }
  return 0;
}

} // namespace billet::app

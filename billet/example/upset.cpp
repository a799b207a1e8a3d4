// Advances a process increment by increment, copies it on the way, and lets both end.

#include <billet/run.h>

#include <algorithm>
#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: upset CASE.toml\n");
    return 2;
  }
  try {
    billet::Case upsetting = billet::Case::load(argv[1]);
    upsetting.set("title", "upset by a program");
    billet::Run run(upsetting);
    while (run.advance() == billet::Status::running && run.increment() < 5)
      std::printf("time %.4f, force on %s %.1f\n", run.time(), run.tools()[0].c_str(),
                  run.tool_force(0)[1]);
    billet::Run copy = run.copy();
    if (run.finish() != billet::Status::done || copy.finish() != billet::Status::done) {
      std::fprintf(stderr, "%s\n", run.reason().c_str());
      return 1;
    }
    const std::vector<double> strain = run.field("plastic_strain");
    std::printf("%zu increments, the last in %d iterations\n",
                run.history().size() / run.history_columns().size(),
                run.last_increment().iterations);
    std::printf("end: force %.6f and %.6f, largest strain %.4f of %zu nodes\n",
                run.tool_force(0)[1], copy.tool_force(0)[1],
                *std::max_element(strain.begin(), strain.end()), strain.size());
    return run.tool_force(0) == copy.tool_force(0) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

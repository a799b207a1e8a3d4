#include "study/verify/case_bench.h"

#include "geometry/base/error.h"
#include "io/case/read_case.h"
#include "io/results/atomic_file.h"
#include "io/scene/scene_builder.h"
#include "process/loop/run_checks.h"

#include <fmt/format.h>

#include <utility>

namespace billet::study {

namespace {

/// Hands each increment on, and keeps why a run could not go on.
class LookingOn final : public process::Observer {
public:
  explicit LookingOn(const CaseBench::Look& look) : look_(look) {}
  void incremented(const process::Run& run, const process::IncrementReport& report) override {
    if (look_)
      look_(run, report);
  }

private:
  const CaseBench::Look& look_;
};

class WhyItFailed final : public process::Observer {
public:
  void failed(const process::Run&, const process::PostMortem& post) override {
    reason = fmt::format("at time {:.6g}: {}", post.time, post.reason);
  }
  std::string reason;
};

} // namespace

CaseBench::CaseBench(std::filesystem::path folder) : folder_(std::move(folder)) {
  io::make_folder(folder_);
}

void CaseBench::write(const std::string& file, const std::string& text) const {
  io::write_file(folder_ / file, text);
}

std::unique_ptr<process::Process> CaseBench::ready(const std::string& name,
                                                   const std::string& text) const {
  const std::string file = name + ".toml";
  write(file, text);
  const io::Case content = io::read_case(folder_ / file);
  process::Scene scene = io::build_scene(content, file).scene;
  return std::make_unique<process::Process>(std::move(scene));
}

std::unique_ptr<process::Process>
CaseBench::run(const std::string& name, const std::string& text, const Look& look) const {
  std::unique_ptr<process::Process> process = ready(name, text);
  LookingOn observer(look);
  run_to_end(*process, name, {&observer});
  return process;
}

void run_to_end(process::Process& process,
                const std::string& name,
                const std::vector<process::Observer*>& observers) {
  WhyItFailed why;
  std::vector<process::Observer*> all = observers;
  all.push_back(&why);
  if (process.run(all) != process::RunStatus::done)
    throw Error(Fault::not_converged, name, "does not converge " + why.reason);
  for (const process::FailedCheck& check : process::failed_checks(process.view()))
    throw Error(Fault::failed_check, name, fmt::format("{}: {}", check.name, check.what));
}

} // namespace billet::study

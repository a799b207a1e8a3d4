// Tools that begin to act in the midst of a run where the workpiece already is.

#include "process/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace billet::process {

void Process::look_for_intruders(const Stage& stage, double until) {
  if (!contact_ || increment_ == 0)
    return; // before the first increment an overlap is refused
  acted_.resize(scene_.tools.size(), 0);
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    const bool acts = !stage.unload && contact_->acts(t, until);
    const bool acted = std::exchange(acted_[t], acts ? 1 : 0) != 0;
    if (!acts || acted || contact_->lies_on(t))
      continue;
    std::string where = overlap(t, until);
    if (where.empty())
      continue;
    const auto known =
        std::find_if(intruders_.begin(), intruders_.end(), [&](const Intruder& intruder) {
          return intruder.tool == t && intruder.time == until;
        });
    if (known != intruders_.end()) // the increment has become shorter since, and others went before
      known->increment = increment_;
    else
      intruders_.push_back({t, until, std::move(where), increment_});
  }
}

std::string Process::intruders_now() const {
  std::string text;
  for (const Intruder& intruder : intruders_)
    if (intruder.increment == increment_)
      text += fmt::format("; tool '{}' begins to act inside the workpiece, {}: a tool goes on its "
                          "way while it does not act",
                          scene_.tools[intruder.tool].name, intruder.where);
  return text;
}

} // namespace billet::process

#include "contact/drives/ram_term.h"

#include <algorithm>
#include <utility>

namespace billet::contact {

RamTerm::RamTerm(ContactTerm& contact, std::span<const Tool> tools, std::size_t n_nodal)
    : contact_(&contact), tools_(tools), n_nodal_(n_nodal) {
  const std::vector<DriveUnknown> drives = drive_unknowns(tools);
  for (std::size_t j = 0; j < drives.size(); ++j)
    if (!drives[j].turns && tools[drives[j].tool].motion.force->blow)
      flights_.push_back({drives[j].tool, j, std::nullopt});
}

Outcome<mechanics::Assembled> RamTerm::assemble(const mechanics::Trial& trial,
                                                mechanics::System& system) {
  const double dt = trial.time - trial.time_old;
  for (const Flight& flight : flights_) {
    if (!flight.ram)
      continue;
    const std::size_t i = n_nodal_ + flight.drive;
    system.residual[i] += flight.ram->inertia(trial.x[i] - trial.x_old[i], dt);
    system.borders[flight.drive].corner[flight.drive] += flight.ram->stiffness(dt);
  }
  return mechanics::Assembled{};
}

void RamTerm::commit(const mechanics::Trial& trial) {
  for (Flight& flight : flights_) {
    if (!flight.ram)
      continue;
    const std::size_t i = n_nodal_ + flight.drive;
    flight.ram->speed =
        flight.ram->speed_after(trial.x[i] - trial.x_old[i], trial.time - trial.time_old);
    flight.ram->force = accelerating(flight.tool, trial.time);
  }
}

double RamTerm::accelerating(std::size_t tool, double time) const {
  const geometry::Drive& drive = *tools_[tool].motion.force;
  return drive.load(time) + contact_->loads()[tool].force.dot(drive.axis);
}

void RamTerm::strike(std::size_t tool, double time) {
  const geometry::Blow& blow = *tools_[tool].motion.force->blow;
  go_on(tool, blow.mass, blow.speed, time);
}

void RamTerm::go_on(std::size_t tool, double mass, double speed, double time) {
  flight(tool).ram = Ram{mass, speed, accelerating(tool, time)};
  contact_->activity().hold(tool, false);
}

void RamTerm::stop(std::size_t tool) {
  flight(tool).ram.reset();
  contact_->activity().hold(tool, true);
}

const Ram* RamTerm::moving(std::size_t tool) const {
  const std::optional<Ram>& ram = flight(tool).ram;
  return ram ? &*ram : nullptr;
}

std::size_t RamTerm::unknown(std::size_t tool) const { return n_nodal_ + flight(tool).drive; }

const RamTerm::Flight& RamTerm::flight(std::size_t tool) const {
  return *std::find_if(flights_.begin(), flights_.end(),
                       [&](const Flight& f) { return f.tool == tool; });
}

RamTerm::Flight& RamTerm::flight(std::size_t tool) {
  return const_cast<Flight&>(std::as_const(*this).flight(tool)); // NOLINT: one search for both
}

} // namespace billet::contact

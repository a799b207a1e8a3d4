#include "contact/wear/process_window.h"

#include <algorithm>

namespace billet::contact {

void ProcessWindow::Sums::begin() {
  area_ = 0.0;
  by_area_.fill(0.0);
}

void ProcessWindow::Sums::add(const Values& means, const Values& at_end, double area) {
  area_ += area;
  for (std::size_t q = 0; q < n_window_quantities; ++q) {
    by_area_[q] += area * means[q];
    ranges_[q].lowest = std::min(ranges_[q].lowest, at_end[q]);
    ranges_[q].highest = std::max(ranges_[q].highest, at_end[q]);
  }
}

void ProcessWindow::Sums::end(double dt) {
  if (!(area_ > 0.0))
    return;
  time_ += dt;
  area_time_ += area_ * dt;
  for (std::size_t q = 0; q < n_window_quantities; ++q) {
    weighted_[q] += by_area_[q] * dt;
    ranges_[q].last_mean = by_area_[q] / area_; // (W.9)
  }
}

Window ProcessWindow::Sums::window() const {
  Window window;
  if (!(time_ > 0.0))
    return window;
  window.contact_time = time_;
  window.mean_area = area_time_ / time_;
  window.ranges = ranges_;
  for (std::size_t q = 0; q < n_window_quantities; ++q)
    window.ranges[q].mean = weighted_[q] / area_time_; // (W.8)
  return window;
}

void ProcessWindow::add(std::span<const std::vector<ClosedPoint>> closed,
                        const BulkFields& bulk,
                        double dt) {
  total_.begin();
  for (std::size_t t = 0; t < closed.size(); ++t) {
    tools_[t].begin();
    for (const ClosedPoint& at : closed[t]) {
      const std::size_t g = bulk.point[at.point];
      const double sliding_time = at.touching * dt;
      const double speed = at.slip > 0.0 ? at.slip / sliding_time : 0.0;
      const Values at_end{at.pressure, speed, at.sliding, bulk.strain[g], bulk.strain_rate[g]};
      Values means = at_end;
      means[static_cast<std::size_t>(WindowQuantity::pressure)] = at.mean_pressure();
      means[static_cast<std::size_t>(WindowQuantity::speed)] = at.slip / dt;
      tools_[t].add(means, at_end, at.area);
      total_.add(means, at_end, at.area);
    }
    tools_[t].end(dt);
  }
  total_.end(dt);
}

} // namespace billet::contact

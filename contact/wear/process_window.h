// The process window: under which pressure, sliding, strain and strain rate a pair of surfaces
// works over a run. A friction test stands for a process when its window does.
//
// Means are weighted with area and time over the contact points that are closed, extremes are those
// of single points at the ends of increments. Sliding speed is that of irreversible sliding: points
// that stick count, with zero.
//
// Units   MPa, mm, s. Theory: docs/theory/contact.md (W.8), (W.9).

#pragma once

#include "contact/surface/closed_point.h"

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace billet::contact {

/// One quantity over a run.
struct WindowRange {
  double mean = 0.0; ///< over area and time (W.8)
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  double last_mean = 0.0; ///< over the area, in the last increment with contact (W.9)

  template <class Archive> void fields(Archive& archive) {
    archive(mean, lowest, highest, last_mean);
  }
};

/// The quantities of a window, in this order wherever there is a list of them.
enum class WindowQuantity : std::size_t { pressure, speed, sliding, strain, strain_rate };
inline constexpr std::size_t n_window_quantities = 5;

/// What they are called in results.
inline constexpr std::array<std::string_view, n_window_quantities> window_names{
    "pressure", "sliding_speed", "sliding_distance", "surface_strain", "surface_strain_rate"};

/// The window of one pair, or of all together.
struct Window {
  double contact_time = 0.0; ///< in which at least one point was closed [s]
  double mean_area = 0.0;    ///< in contact, over that time [mm^2]
  std::array<WindowRange, n_window_quantities> ranges;

  [[nodiscard]] const WindowRange& operator[](WindowQuantity quantity) const {
    return ranges[static_cast<std::size_t>(quantity)];
  }
};

/// What the workpiece does at its contact points, by integration point of the bulk.
struct BulkFields {
  std::span<const std::size_t> point;  ///< of every contact point, shape (n_points)
  std::span<const double> strain;      ///< equivalent plastic [-]
  std::span<const double> strain_rate; ///< over the increment [1/s]
};

class ProcessWindow {
public:
  explicit ProcessWindow(std::size_t n_tools) : tools_(n_tools) {}

  /// Takes an increment in.
  ///
  /// @param closed  the points closed on each tool, shape (n_tools)
  /// @param dt      [s], > 0
  void add(std::span<const std::vector<ClosedPoint>> closed, const BulkFields& bulk, double dt);

  [[nodiscard]] Window tool(std::size_t t) const { return tools_[t].window(); }
  /// Over all pairs; a point that touches two tools counts twice.
  [[nodiscard]] Window total() const { return total_.window(); }

  template <class Archive> void fields(Archive& archive) { archive(tools_, total_); }

private:
  using Values = std::array<double, n_window_quantities>;

  /// Sums of one pair.
  class Sums {
  public:
    void begin();
    /// @param means   of the increment
    /// @param at_end  values at its end
    void add(const Values& means, const Values& at_end, double area);
    void end(double dt);
    [[nodiscard]] Window window() const;

    template <class Archive> void fields(Archive& archive) {
      archive(time_, area_time_, weighted_, area_, by_area_, ranges_);
    }

  private:
    double time_ = 0.0;
    double area_time_ = 0.0;
    Values weighted_{}; ///< times area and time
    double area_ = 0.0; ///< of the increment
    Values by_area_{};  ///< of the increment, times area
    std::array<WindowRange, n_window_quantities> ranges_;
  };

  std::vector<Sums> tools_;
  Sums total_;
};

} // namespace billet::contact

// Presses that are given by their energy: hammers and screw presses.
//
// A blow begins where the tool meets the workpiece, at its full speed, and is over when the work of
// the tool has brought its mass to rest. There the tool stays: a stage that begins without it, or
// unloads, lets it go. A blow begins with every stage in which the tool acts, unless one is still
// under way.
//
// Theory: docs/theory/process.md (P.10)-(P.12).

#pragma once

#include "contact/drives/ram_term.h"
#include "geometry/base/outcome.h"
#include "process/scene/scene.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace billet::process {

/// One blow of a press, so far or to its end.
struct BlowReport {
  std::size_t tool = 0; ///< of the scene's tools
  std::string stage;    ///< in which it began
  double begun = 0.0;   ///< [s]
  double time = 0.0;    ///< to which it has come [s]
  double energy = 0.0;  ///< of the ram when it began [N mm]
  double driven = 0.0;  ///< work of the load that drives it on [N mm]
  double used = 0.0;    ///< work on the workpiece [N mm]
  double left = 0.0;    ///< energy of the ram now [N mm]
  double stroke = 0.0;  ///< since the tool met the workpiece [mm]
  double speed = 0.0;   ///< of the ram now [mm/s]
  bool over = false;    ///< its energy is used up

  template <class Archive> void fields(Archive& archive) {
    archive(tool, stage, begun, time, energy, driven, used, left, stroke, speed, over);
  }
};

/// A blow under way.
struct CurrentBlow {
  std::size_t tool;
  std::size_t report;
  contact::Ram ram; ///< in the committed state

  template <class Archive> void fields(Archive& archive) { archive(tool, report, ram); }
};

/// Blows under way and what is known of all.
struct BlowRecord {
  std::vector<CurrentBlow> current;
  std::vector<BlowReport> reports;
};

class Blows {
public:
  /// @pre tools and contact outlive it
  /// @param size     of the body [mm]
  /// @param n_nodal  unknowns of the nodes
  Blows(std::span<const contact::Tool> tools,
        contact::ContactTerm& contact,
        double size,
        std::size_t n_nodal);

  /// The inertia of the rams, to be assembled after contact.
  [[nodiscard]] mechanics::ForceTerm& term() { return term_; }

  /// Ends the blows that are under way, with the energy that they have left.
  void end_all();

  /// Begins the blows of a stage: moves its rams to first contact.
  ///
  /// @param points  surface of the workpiece, in space [mm]
  /// @param x       all unknowns; those of the rams are set
  /// Fails where a ram strikes nothing.
  Outcome<Done>
  begin(const Stage& stage, double time, std::span<const Vec3> points, std::vector<double>& x);

  /// Longest increment that still follows the rams under way; none is: +infinity [s]. (P.11)
  [[nodiscard]] double longest_step() const;
  /// Length of the first increment of a blow [s]. (P.11)
  [[nodiscard]] double first_step() const;
  /// A shorter increment, if a ram has turned back in this one: to where it stops [s]. (P.12)
  [[nodiscard]] std::optional<double> step_to_stop(const mechanics::Trial& trial) const;
  /// Takes in an accepted increment and ends the blows that are over.
  /// @return one line for each of these
  [[nodiscard]] std::vector<std::string> commit(const mechanics::Trial& trial);

  [[nodiscard]] bool under_way() const;
  /// Those of the tools that strike.
  [[nodiscard]] const std::vector<std::size_t>& tools() const { return striking_; }
  /// Where the travel of one of them stands among the unknowns.
  [[nodiscard]] std::size_t unknown(std::size_t tool) const { return term_.unknown(tool); }

  [[nodiscard]] BlowRecord record() const { return {current_, reports_}; }
  /// Blows of another mesh go on from the committed state of contact; other tools stay where they
  /// are.
  void go_on_from(BlowRecord before, double time);
  [[nodiscard]] const std::vector<BlowReport>& reports() const { return reports_; }

  template <class Archive> void fields(Archive& archive) { archive(term_, current_, reports_); }

private:
  [[nodiscard]] const geometry::Drive& drive(std::size_t tool) const {
    return *tools_[tool].motion.force;
  }
  Outcome<Done> bring_to_touch(std::size_t tool,
                               double time,
                               std::span<const Vec3> points,
                               std::vector<double>& x);
  void take_in(const mechanics::Trial& trial, CurrentBlow& blow);

  std::span<const contact::Tool> tools_;
  contact::ContactTerm* contact_;
  contact::RamTerm term_;
  std::vector<std::size_t> striking_; ///< tools
  double size_;                       ///< of the body [mm]
  std::vector<CurrentBlow> current_;
  std::vector<BlowReport> reports_;
};

} // namespace billet::process

// The inertia of tools that strike, as a force term: it is added to the load and the contact in the
// equation of the tool's travel (C.14).
//
// Theory: docs/theory/process.md (P.10).

#pragma once

#include "contact/term/contact_term.h"
#include "contact/tools/ram.h"

#include <optional>
#include <span>
#include <vector>

namespace billet::contact {

/// To be assembled and committed after the contact term, whose forces it reads.
class RamTerm final : public mechanics::ForceTerm {
public:
  /// @pre contact and tools outlive the term
  /// @param n_nodal  unknowns of the nodes; those of the drives come after them
  RamTerm(ContactTerm& contact, std::span<const Tool> tools, std::size_t n_nodal);

  [[nodiscard]] Outcome<mechanics::Assembled> assemble(const mechanics::Trial& trial,
                                                       mechanics::System& system) override;
  void commit(const mechanics::Trial& trial) override;

  /// Lets a tool fly at the speed of its blow from the committed state on.
  void strike(std::size_t tool, double time);
  /// Lets a tool go on with a mass and a speed from the committed state on.
  void go_on(std::size_t tool, double mass, double speed, double time);
  /// Stops it where it is: it holds its place from now on.
  void stop(std::size_t tool);
  /// The ram of a tool that is under way.
  [[nodiscard]] const Ram* moving(std::size_t tool) const;
  /// Where a tool's travel stands among the unknowns.
  [[nodiscard]] std::size_t unknown(std::size_t tool) const;

  template <class Archive> void fields(Archive& archive) { archive(flights_); }

private:
  struct Flight {
    std::size_t tool;
    std::size_t drive; ///< among the drives
    std::optional<Ram> ram;

    template <class Archive> void fields(Archive& archive) { archive(tool, drive, ram); }
  };

  [[nodiscard]] Flight& flight(std::size_t tool);
  [[nodiscard]] const Flight& flight(std::size_t tool) const;
  /// What accelerates a tool in the committed state of contact [N].
  [[nodiscard]] double accelerating(std::size_t tool, double time) const;

  ContactTerm* contact_;
  std::span<const Tool> tools_;
  std::size_t n_nodal_;
  std::vector<Flight> flights_; ///< one for each tool that strikes
};

} // namespace billet::contact

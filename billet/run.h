// billet as a library: a forming process that a program of yours advances, looks at and copies.
//
//     billet::Run run("case.toml");
//     while (run.advance() == billet::Status::running)
//       std::cout << run.time() << ' ' << run.tool_force(0)[2] << '\n';
//
// Units are those of the case. Installed by `cmake --install`; found by `find_package(billet)`,
// target `billet::billet`. Cases in memory: billet/case.h, which this header includes.

#pragma once

#if __cplusplus < 202002L
#error "billet/run.h needs C++20: compile with -std=c++20"
#endif

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "billet/case.h"

namespace billet {

enum class Status {
  running,      ///< it can be advanced
  done,         ///< it has come to its end
  not_converged ///< an increment could not be solved: see Run::reason
};

/// How a case is read and run.
struct RunOptions {
  std::vector<std::string> overrides; ///< "tool.punch.friction.m=0.2", as for `billet run --set`
  int threads = 1;                    ///< that work on a run; its bits do not depend on them
  bool allow_outside = false;         ///< the case may name files outside of its folder
};

/// Labels of the units of a case.
struct Units {
  std::string length;      ///< "mm"
  std::string force;       ///< "N"
  std::string time;        ///< "s"
  std::string stress;      ///< "MPa"
  std::string temperature; ///< "degC"
};

/// How the last increment was solved.
struct Increment {
  int number = 0;                       ///< from 1; 0: there has been none
  double time = 0.0;                    ///< at its end [s]
  double length = 0.0;                  ///< [s]
  int iterations = 0;                   ///< of Newton's method
  int cutbacks = 0;                     ///< tries that failed before it
  std::vector<double> residuals;        ///< relative, at its start and after each iteration [-]
  std::vector<std::string> events = {}; ///< what happened at its end, a line each
};

/// Values at the nodes.
struct NodalField {
  std::string name;           ///< as in frames: "von_mises"
  std::string unit;           ///< "MPa"; "1" of pure numbers; of codes what they mean
  int components = 1;         ///< 1, 3 (X, Y, Z) or 6 (XX, YY, ZZ, XY, YZ, XZ)
  std::vector<double> values; ///< shape (n_nodes, components)
};

/// Values that stay as they are however the run goes on, and if it ends.
template <class T> struct Kept {
  std::shared_ptr<const void> owner; ///< of the memory
  std::span<const T> values;         ///< valid as long as an owner is held
};

/// A run of a case, in memory: nothing is written.
class Run {
public:
  /// Reads a case file and prepares its scene.
  /// @throws RunError
  explicit Run(const std::filesystem::path& case_file, const RunOptions& options = {});
  /// Prepares the scene of a case, which may be changed afterwards: the run has its own.
  /// @throws RunError
  explicit Run(Case content, const RunOptions& options = {});
  ~Run();
  /// A run that has been moved from may only be assigned to or destroyed.
  Run(Run&& other) noexcept;
  /// As the move constructor.
  Run& operator=(Run&& other) noexcept;

  /// Solves for one increment, or for as many as a new mesh needs.
  /// @throws RunError  (a limit of memory, say)
  Status advance();
  /// Advances to the end.
  Status finish();
  /// Whether it can be advanced, and if not, why.
  [[nodiscard]] Status status() const;
  /// Why an increment could not be solved; empty: all could.
  [[nodiscard]] const std::string& reason() const;
  /// Why a run that is done has ended: "end of time", or before it "full cavity", "tools
  /// overloaded", "tools together", "lap", "energy used up"; empty: it is not done.
  [[nodiscard]] std::string ended_by() const;

  /// At the end of the last increment [s].
  [[nodiscard]] double time() const;
  /// Number of the last increment; 0: there has been none.
  [[nodiscard]] int increment() const;
  /// How that was solved.
  [[nodiscard]] const Increment& last_increment() const;
  /// Checks of `billet run` that the run does not pass as it is now, a line each.
  [[nodiscard]] std::vector<std::string> failed_checks() const;

  /// Columns of the table of increments: those of history.csv.
  [[nodiscard]] const std::vector<std::string>& history_columns() const;
  /// A row for each increment so far, shape (n_increments, n_columns); units as in history.csv.
  [[nodiscard]] std::span<const double> history() const;

  /// Of positions, forces, times, stresses and temperatures.
  [[nodiscard]] const Units& units() const;
  /// 2: x, y, or radius and axis; 3: x, y, z.
  [[nodiscard]] int dimension() const;
  /// Where the nodes are, shape (n_nodes, dimension) [mm]; valid until the run is advanced.
  [[nodiscard]] std::span<const double> positions() const;
  /// The same memory, to be kept; copied only if somebody still holds it when the run goes on.
  [[nodiscard]] Kept<double> keep_positions();
  /// Nodes of the elements, shape (n_elements, nodes_per_element); valid until a new mesh is made.
  [[nodiscard]] std::span<const std::int32_t> elements() const;
  /// The same memory, to be kept; it is never copied.
  [[nodiscard]] Kept<std::int32_t> keep_elements() const;
  /// Of all elements, which are of one kind.
  [[nodiscard]] int nodes_per_element() const;

  /// Names of the fields at the nodes: "displacement", "von_mises", "plastic_strain", ...
  [[nodiscard]] std::vector<std::string> field_names() const;
  /// A field at the nodes, shape (n_nodes, components); components are 1, 3 (X, Y, Z) or 6 (XX, YY,
  /// ZZ, XY, YZ, XZ).
  /// @throws RunError for a name that is none of theirs
  [[nodiscard]] std::vector<double> field(std::string_view name) const;
  /// The same with its unit and the number of its components.
  /// @throws RunError for a name that is none of theirs
  [[nodiscard]] NodalField nodal_field(std::string_view name) const;
  /// All of them, which takes hardly longer than one.
  [[nodiscard]] std::vector<NodalField> nodal_fields() const;

  /// Names of the tools, in the order of the case.
  [[nodiscard]] std::vector<std::string> tools() const;
  /// Of the workpiece on a tool [N]; in plane strain per length [N/mm].
  [[nodiscard]] std::array<double, 3> tool_force(std::size_t tool) const;
  /// About the tool's reference point [N mm].
  [[nodiscard]] std::array<double, 3> tool_torque(std::size_t tool) const;

  /// The run as it is now, in bytes. The linear solver begins anew, here as where they are loaded.
  [[nodiscard]] std::string save();
  /// Goes on from bytes that a run of the same case was saved in.
  /// @throws RunError  and leaves the run as it was
  void load(std::string_view saved);
  /// Another run that goes on from here; both take the same way, to the bit.
  /// @throws RunError
  [[nodiscard]] Run copy();

private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

} // namespace billet

// billet as a library: a forming process that a program of yours advances, looks at and copies.
//
//     billet::Run run("case.toml");
//     while (run.advance() == billet::Status::running)
//       std::cout << run.time() << ' ' << run.tool_force(0)[2] << '\n';
//
// Units are those of the case. Installed by `cmake --install`; found by `find_package(billet)`,
// target `billet::billet`. This is the only header.

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace billet {

/// What cannot be run, and why: every complaint on a line of its own, with file, line, key and
/// remedy.
class RunError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

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

/// A run of a case, in memory: nothing is written.
class Run {
public:
  /// Reads a case file and prepares its scene.
  /// @throws RunError
  explicit Run(const std::filesystem::path& case_file, const RunOptions& options = {});
  ~Run();
  /// A run that has been moved from may only be assigned to or destroyed.
  Run(Run&& other) noexcept;
  /// Likewise.
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

  /// At the end of the last increment [s].
  [[nodiscard]] double time() const;
  /// Number of the last increment; 0: there has been none.
  [[nodiscard]] int increment() const;

  /// 2: x, y, or radius and axis; 3: x, y, z.
  [[nodiscard]] int dimension() const;
  /// Where the nodes are, shape (n_nodes, dimension) [mm]; valid until the run is advanced.
  [[nodiscard]] std::span<const double> positions() const;
  /// Nodes of the elements, shape (n_elements, nodes_per_element); valid until a new mesh is made.
  [[nodiscard]] std::span<const std::int32_t> elements() const;
  /// Of all elements, which are of one kind.
  [[nodiscard]] int nodes_per_element() const;

  /// Names of the fields at the nodes: "displacement", "von_mises", "plastic_strain", ...
  [[nodiscard]] std::vector<std::string> field_names() const;
  /// A field at the nodes, shape (n_nodes, components); components are 1, 3 (X, Y, Z) or 6 (XX, YY,
  /// ZZ, XY, YZ, XZ).
  /// @throws RunError for a name that is none of theirs
  [[nodiscard]] std::vector<double> field(std::string_view name) const;

  /// Names of the tools, in the order of the case.
  [[nodiscard]] std::vector<std::string> tools() const;
  /// Of the workpiece on a tool [N]; in plane strain per length [N/mm].
  [[nodiscard]] std::array<double, 3> tool_force(std::size_t tool) const;
  /// About the tool's reference point [N mm].
  [[nodiscard]] std::array<double, 3> tool_torque(std::size_t tool) const;

  /// The run as it is now, in bytes. The linear solver begins anew, here as where they are loaded.
  [[nodiscard]] std::string save();
  /// Goes on from bytes that a run of the same case was saved in.
  /// @throws RunError
  void load(std::string_view saved);
  /// Another run that goes on from here; both take the same way, to the bit.
  /// @throws RunError
  [[nodiscard]] Run copy();

private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

} // namespace billet

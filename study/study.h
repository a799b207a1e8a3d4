// A study: one case and settings to run it with, quantities to read off, and what to make of them.

#pragma once

#include "io/case/shape.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/quantity.h"

namespace billet::study {

/// A key of the case and the TOML text of its value, as `billet run --set KEY=VALUE` takes it.
struct Assignment {
  std::string key = {};
  std::string value = {};

  bool operator==(const Assignment&) const = default;
};

/// One of the settings along an axis.
struct Level {
  std::string label = {};
  std::vector<Assignment> set;
  std::optional<double> size = std::nullopt; ///< of what is refined, relative to the others [-]
  std::optional<std::filesystem::path> case_file = std::nullopt; ///< in place of the study's
};

/// Values that a sample may take between two, of one key.
struct Range {
  std::string key = {};
  double low = 0.0;
  double high = 0.0;
  bool logarithmic = false;
};

/// What is varied.
struct Axis {
  std::string name = {};
  std::vector<Level> levels;                 ///< of a range without a sample its steps
  std::optional<Range> range = std::nullopt; ///< what a sample draws from, in place of levels

  /// Whether every level has a size.
  [[nodiscard]] bool refines() const;
  /// The level with the smallest size.
  /// @pre refines()
  [[nodiscard]] const Level& finest() const;
};

/// How settings are drawn where not all combinations are run.
struct Sample {
  enum class Method { latin_hypercube, sobol };
  Method method = Method::latin_hypercube;
  int count = 0;
  std::uint32_t seed = 1;
};

/// Where runs are made.
struct Engine {
  enum class Kind { local, slurm, commands };
  Kind kind = Kind::local;
  std::optional<int> processes = std::nullopt; ///< at once; none: as many as the machine has cores
  int threads = 1;                             ///< of a run
  std::vector<std::string> options = {};       ///< of sbatch
  bool frames = false;                         ///< write those in between as well
};

/// What error and cost are measured by.
struct TradeSettings {
  enum class Cost { processor_time, iterations, memory };
  std::vector<std::string> quantities = {}; ///< empty: all
  /// Labels of the reference's levels by axis; an axis that is not named is what the trade is for:
  /// each of its levels has a reference of its own.
  std::map<std::string, std::string> reference = {};
  Cost cost = Cost::processor_time;
  double within = 0.01; ///< error that a recommended setting may have [-]
};

/// Over which axes a quantity is extrapolated.
struct ConvergenceSettings {
  std::vector<std::string> axes = {};       ///< each has sizes
  std::vector<std::string> quantities = {}; ///< empty: all
};

struct Study {
  std::string title = {};
  std::filesystem::path case_file;
  std::vector<std::string> overrides = {}; ///< of every run, "key=value"
  std::vector<Axis> axes;
  std::optional<Sample> sample;
  std::vector<Quantity> quantities;
  std::optional<TradeSettings> trade;
  std::optional<ConvergenceSettings> convergence;
  Engine engine;
};

/// Reads and validates a study file.
/// @throws Error (Fault::case_file) with all complaints
[[nodiscard]] Study read_study(const std::filesystem::path& file,
                               const std::vector<std::string>& overrides = {});

/// What may stand in a study file.
[[nodiscard]] io::Shape study_shape();

} // namespace billet::study

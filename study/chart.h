// A chart of a test: what is measured, over how far the test has gone, for values of the parameters
// that are to be found; of one law or several. docs/guide/friction-tests.md

#pragma once

#include "io/case/shape.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/conduct.h"
#include "study/study.h"

namespace billet::study {

/// What is read off a run along the way: an expression of columns of history.csv.
struct Reading {
  std::string name = {};
  std::string of = {};
  double average = 0.0; ///< over so much of x around a station; 0: there
};

/// A number of a law that is to be found.
struct Parameter {
  std::string name = {};
  std::vector<std::string> keys = {}; ///< of the case, which get the same value
  std::vector<double> values = {};    ///< increasing
};

/// A law and its one or two parameters.
struct Law {
  std::string name = {};
  std::vector<Assignment> set = {};
  std::vector<Parameter> parameters = {};
};

/// Something that nobody knows exactly, a number of the flow curve say.
struct Uncertain {
  std::string name = {};
  std::string key = {};
  double value = 0.0;
  double standard = 0.0; ///< standard uncertainty
};

/// What a chart file asks for.
struct ChartFile {
  Study study;                  ///< title, case, settings of all runs, where they are made
  Reading x;                    ///< how far the test has gone
  std::vector<double> stations; ///< of x, increasing
  std::vector<Reading> y;       ///< what is measured
  std::vector<Law> laws;
  std::vector<Level> refinement; ///< from coarse to fine, each with a size; empty: the case's mesh
  std::vector<Uncertain> uncertain;
};

/// @throws Error (Fault::case_file) with all complaints
[[nodiscard]] ChartFile read_chart_file(const std::filesystem::path& file,
                                        const std::vector<std::string>& overrides = {});

/// What a chart file may contain.
[[nodiscard]] io::Shape chart_file_shape();

/// One measured quantity of a law's runs.
struct ChartedQuantity {
  std::string name;
  /// Shape (n_points of the parameters' grid, n_stations), the last parameter changing fastest; not
  /// a number where a run did not get there.
  std::vector<std::vector<double>> values;
  /// Half widths of the 95 % interval for the error that mesh and increments leave, of the same
  /// shape; 0 without refinement.
  std::vector<std::vector<double>> model_error;
  /// What a standard uncertainty of each uncertain number changes, shape (n_uncertain, ...).
  std::vector<std::vector<std::vector<double>>> change;
};

struct ChartedLaw {
  std::string name;
  std::vector<Parameter> parameters;
  std::vector<ChartedQuantity> quantities;
};

/// A chart as identification uses it.
struct Chart {
  std::string title;
  std::string x;
  std::vector<double> stations;
  std::vector<std::string> uncertain; ///< names
  std::vector<ChartedLaw> laws;
};

/// Makes the runs, writes FOLDER/chart.json and FOLDER/chart.csv.
/// @return none: runs are left to be made
[[nodiscard]] std::optional<Chart> conduct_chart(const ChartFile& file, const Conduct& how);

/// FOLDER/chart.json and FOLDER/chart.csv.
void write_chart(const Chart& chart, const std::filesystem::path& folder);

/// @throws Error (Fault::input_output) for a file that is no chart
[[nodiscard]] Chart read_chart(const std::filesystem::path& chart_json);

/// Charts for billet-render: each quantity over x, one curve per value of the parameter; and over
/// the parameter, one curve per station.
[[nodiscard]] std::vector<std::vector<std::string>>
chart_pictures(const Chart& chart, const std::filesystem::path& folder);

} // namespace billet::study

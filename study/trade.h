// What settings cost and how far off they are.
//
// Axes that the reference names are settings; the others are problems, each of which has its own
// reference. A setting's error is the largest over problems and quantities, its cost the mean.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/outcome_table.h"

namespace billet::study {

/// Levels of the axes that the reference names, and what they make of all problems.
struct Setting {
  std::vector<std::string> labels;     ///< of those axes
  std::vector<Assignment> assignments; ///< of those axes
  double error = 0.0;                  ///< largest [-]; infinite: a run did not reach its end
  double cost = 0.0;                   ///< mean, in the trade's unit
  bool is_reference = false;
  bool on_front = false; ///< no other is both nearer and cheaper
};

/// Levels of the other axes, and what each setting makes of this problem.
struct TradeProblem {
  std::vector<std::string> labels; ///< of those axes
  std::vector<double> errors;      ///< by setting [-]; not a number: it or its reference failed
  std::vector<double> costs;       ///< by setting, in the trade's unit
};

struct Trade {
  std::vector<std::string> axes;         ///< whose levels make a setting
  std::vector<std::string> problem_axes; ///< the others
  std::vector<TradeProblem> problems;    ///< in the order of the rows
  std::vector<double> errors;      ///< of each row [-]; not a number: it or its reference failed
  std::vector<Setting> settings;   ///< in the order of the rows
  std::vector<std::size_t> front;  ///< settings, from the cheapest on
  std::optional<std::size_t> knee; ///< of the front: after it error costs most
  std::optional<std::size_t> cheapest_within; ///< setting
  std::vector<std::string> zero_in_reference; ///< quantities without a scale: no error is relative
};

/// @pre study.trade
[[nodiscard]] Trade trade_of(const Study& study, const std::vector<OutcomeRow>& rows);

/// The cost of a run in the trade's unit: s, iterations or MB.
[[nodiscard]] double cost_in(TradeSettings::Cost unit, const RunCost& cost);
[[nodiscard]] std::string unit_of(TradeSettings::Cost unit);

} // namespace billet::study

#include "io/case/history_columns.h"

#include "io/case/case.h"

#include <algorithm>

namespace billet::io {

std::vector<std::string> history_columns(const NamesOfHistory& names) {
  std::vector<std::string> columns(fixed_columns.begin(), fixed_columns.end());
  for (const std::string& tool : names.tools)
    for (const char* what : {"force", "torque", "displacement"})
      for (const char* axis : {"_x", "_y", "_z"})
        columns.push_back(tool + "." + what + axis);
  for (const std::string& support : names.supports)
    for (const char* axis : {"_x", "_y", "_z"})
      columns.push_back(support + ".force" + axis);
  if (names.has_trapped && !names.tools.empty())
    columns.insert(columns.end(), trapped_columns.begin(), trapped_columns.end());
  columns.insert(columns.end(), names.measures.begin(), names.measures.end());
  return columns;
}

std::vector<std::string> history_columns(const Case& content) {
  NamesOfHistory names{{}, {}, {}, content.contact.trapped.has_value()};
  for (const Tool& tool : content.tools)
    names.tools.push_back(tool.name);
  for (const Support& support : content.supports)
    if (!support.name.empty())
      names.supports.push_back(support.name);
  for (const Measure& measure : content.measures)
    names.measures.push_back(measure.name);
  return history_columns(names);
}

} // namespace billet::io

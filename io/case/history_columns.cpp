#include "io/case/history_columns.h"

#include "io/case/case.h"

namespace billet::io {

std::vector<std::string> history_columns(std::span<const std::string> tools,
                                         bool has_trapped,
                                         std::span<const std::string> measures) {
  std::vector<std::string> columns(fixed_columns.begin(), fixed_columns.end());
  for (const std::string& tool : tools)
    for (const char* what : {"force", "torque", "displacement"})
      for (const char* axis : {"_x", "_y", "_z"})
        columns.push_back(tool + "." + what + axis);
  if (has_trapped && !tools.empty())
    columns.insert(columns.end(), trapped_columns.begin(), trapped_columns.end());
  columns.insert(columns.end(), measures.begin(), measures.end());
  return columns;
}

std::vector<std::string> history_columns(const Case& content) {
  std::vector<std::string> tools, measures;
  for (const Tool& tool : content.tools)
    tools.push_back(tool.name);
  for (const Measure& measure : content.measures)
    measures.push_back(measure.name);
  return history_columns(tools, content.contact.trapped.has_value(), measures);
}

} // namespace billet::io

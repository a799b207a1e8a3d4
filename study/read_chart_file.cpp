#include "io/case/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "study/chart.h"
#include "study/setters.h"
#include "study/study_reader.h"

namespace billet::study {

namespace {

using io::At;
using io::TableReader;

std::optional<Reading> as_reading(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Reading reading;
  table.required("name", reading.name, io::as_name);
  reading.of = reading.name;
  table.optional("of", reading.of, io::as_text);
  check_expression(table, "of", reading.of);
  table.optional("average", reading.average, io::as_number, io::positive_number);
  table.finish();
  return reading;
}

std::optional<Parameter> as_parameter(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Parameter parameter;
  table.required("name", parameter.name, io::as_name);
  if (table.has("keys")) {
    table.required("keys", parameter.keys, io::as_texts);
  } else {
    parameter.keys.resize(1);
    table.required("key", parameter.keys.front(), io::as_text);
  }
  table.required("values", parameter.values, as_steps);
  if (parameter.values.size() == 1)
    table.find("values")->complain("a parameter that is to be found needs two values or more");
  table.finish();
  return parameter;
}

std::optional<Law> as_law(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Law law;
  table.required("name", law.name, io::as_name);
  table.optional("set", law.set, as_assignments);
  law.parameters = read_items<Parameter>(table, "parameters", as_parameter);
  constexpr std::size_t most = 2;
  if (law.parameters.empty() || law.parameters.size() > most)
    at.complain("a law has one or two parameters that are to be found",
                "give parameters = [{ name, key, values }]");
  table.finish();
  return law;
}

std::optional<Uncertain> as_uncertain(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Uncertain uncertain;
  table.required("name", uncertain.name, io::as_name);
  table.required("key", uncertain.key, io::as_text);
  table.required("value", uncertain.value, io::as_number, io::Number{});
  table.required("standard", uncertain.standard, io::as_number, io::positive_number);
  table.finish();
  return uncertain;
}

template <class Item>
void refuse_same(const At& root, const std::string& what, const std::vector<Item>& items) {
  std::set<std::string> names;
  for (const Item& item : items)
    if (!names.insert(item.name).second)
      root.complain(fmt::format("there is a {} '{}' already, names must differ", what, item.name));
}

void read_x(TableReader& root, ChartFile& file) {
  std::optional<TableReader> x = root.require_table("x");
  if (!x)
    return;
  x->required("name", file.x.name, io::as_name);
  file.x.of = file.x.name;
  x->optional("of", file.x.of, io::as_text);
  check_expression(*x, "of", file.x.of);
  x->required("values", file.stations, as_steps);
  x->finish();
}

/// What sets keys of the case, in the order in which the runs of a law get them.
std::vector<Setter> setters_of(const ChartFile& file, const Law& law) {
  std::vector<Setter> setters;
  std::vector<std::string> of_law;
  for (const Assignment& assignment : law.set)
    of_law.push_back(assignment.key);
  setters.push_back({fmt::format("law '{}'", law.name), std::move(of_law)});
  for (const Parameter& parameter : law.parameters)
    setters.push_back({fmt::format("parameter '{}'", parameter.name), parameter.keys});
  setters.push_back({"refinement", keys_of(file.refinement)});
  for (const Uncertain& uncertain : file.uncertain)
    setters.push_back({fmt::format("uncertain '{}'", uncertain.name), {uncertain.key}});
  return setters;
}

/// A measurement's bar stands in a column called after the quantity.
void refuse_names_of_bars(const At& root, const ChartFile& file) {
  for (const Reading& y : file.y)
    for (const char* ending : {"_standard", "_uncertainty"})
      for (const Reading& other : file.y)
        if (other.name == y.name + ending)
          root.complain(fmt::format("a [[y]] is called '{}', which the table of measurements has "
                                    "for the uncertainty of '{}'",
                                    other.name, y.name));
}

/// Coarse first; an extrapolation needs to know which is fine.
void check_refinement(const At& root, ChartFile& file) {
  std::vector<Level>& levels = file.refinement;
  if (levels.size() == 1)
    root.complain("a refinement has two levels or more", "add a coarser [[refinement]]");
  if (std::any_of(levels.begin(), levels.end(), [](const Level& each) { return !each.size; })) {
    root.complain("a refinement needs its size",
                  "give [[refinement]] size = 2 for twice as coarse");
    return;
  }
  std::sort(levels.begin(), levels.end(),
            [](const Level& a, const Level& b) { return *a.size > *b.size; });
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (*levels[i].size == *levels[i - 1].size)
      root.complain("two refinements have the same size");
}

void read_root_of_chart(TableReader& root, ChartFile& file) {
  read_common(root, file.study);
  read_x(root, file);
  file.y = read_items<Reading>(root, "y", as_reading);
  file.laws = read_items<Law>(root, "law", as_law);
  file.refinement = read_items<Level>(root, "refinement", as_level);
  file.uncertain = read_items<Uncertain>(root, "uncertain", as_uncertain);
  root.finish();
  if (file.y.empty())
    root.at().complain("nothing is measured", "give [[y]] name and of");
  if (file.laws.empty())
    root.at().complain("there is no law", "give [[law]] name and parameters");
  refuse_same(root.at(), "quantity", file.y);
  for (const Reading& y : file.y)
    if (y.name == file.x.name)
      root.at().complain(fmt::format("[x] and a [[y]] have the same name '{}'", y.name));
  refuse_same(root.at(), "law", file.laws);
  refuse_names_of_bars(root.at(), file);
  check_refinement(root.at(), file);
  for (const Law& law : file.laws)
    refuse_overruled(root.at(), file.study.case_file, setters_of(file, law));
}

} // namespace

io::Shape chart_file_shape() {
  return shape_of_file([](TableReader& root) {
    ChartFile file;
    read_root_of_chart(root, file);
  });
}

ChartFile read_chart_file(const std::filesystem::path& path,
                          const std::vector<std::string>& overrides) {
  ChartFile file;
  read_file(path, overrides, [&](TableReader& root) { read_root_of_chart(root, file); });
  return file;
}

} // namespace billet::study

#include "geometry/base/error.h"
#include "io/case/suggestion.h"
#include "io/case/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "study/node_text.h"
#include "study/outcome_table.h"
#include "study/setters.h"
#include "study/study.h"
#include "study/study_reader.h"

namespace billet::study {

namespace {

namespace fs = std::filesystem;
using io::At;
using io::Number;
using io::TableReader;
using io::Word;

constexpr std::array methods{
    Word<Sample::Method>{"latin-hypercube", Sample::Method::latin_hypercube},
    Word<Sample::Method>{"sobol", Sample::Method::sobol}};
constexpr std::array takes{Word<Quantity::Take>{"end", Quantity::Take::end},
                           Word<Quantity::Take>{"at", Quantity::Take::at},
                           Word<Quantity::Take>{"largest", Quantity::Take::largest},
                           Word<Quantity::Take>{"smallest", Quantity::Take::smallest},
                           Word<Quantity::Take>{"mean", Quantity::Take::mean}};
constexpr std::array costs{
    Word<TradeSettings::Cost>{"processor_time", TradeSettings::Cost::processor_time},
    Word<TradeSettings::Cost>{"iterations", TradeSettings::Cost::iterations},
    Word<TradeSettings::Cost>{"memory", TradeSettings::Cost::memory}};

template <const auto& words>
constexpr auto as_one_of = [](const At& at) { return io::as_word(at, words); };

void read_levels(const At& at, Axis& axis) {
  const auto* const list = at.list(1);
  if (list == nullptr || list->empty()) {
    at.complain_found("a list of tables { label, set = { KEY = VALUE }, size }");
    return;
  }
  for (std::size_t i = 0; i < list->size(); ++i)
    if (std::optional<Level> level = io::read_value_of(at.item((*list)[i], i), as_level))
      axis.levels.push_back(std::move(*level));
  std::set<double> sizes;
  for (const Level& level : axis.levels)
    if (level.size && !sizes.insert(*level.size).second)
      at.complain(fmt::format("two levels have the same size {}", *level.size),
                  "the smallest size is that of the finest");
}

void read_values(const At& at, const std::string& key, Axis& axis) {
  const auto* const list = at.list(1);
  if (list == nullptr || list->empty()) {
    at.complain_found("a list of at least one value");
    return;
  }
  for (const io::Node& value : *list)
    axis.levels.push_back({label_of(value), {{key, toml_text(value)}}});
}

/// Sizes of the levels, for an axis that refines.
void read_sizes(TableReader& table, Axis& axis) {
  std::optional<std::vector<double>> sizes;
  const std::optional<At> at = table.find("sizes");
  if (!at || !(sizes = io::as_numbers(*at, io::positive_number)))
    return;
  if (sizes->size() != axis.levels.size()) {
    at->complain(
        fmt::format("there are {} sizes and {} values", sizes->size(), axis.levels.size()));
    return;
  }
  if (std::set<double>(sizes->begin(), sizes->end()).size() != sizes->size()) {
    at->complain("two values have the same size", "the smallest size is that of the finest");
    return;
  }
  for (std::size_t i = 0; i < sizes->size(); ++i)
    axis.levels[i].size = (*sizes)[i];
}

void read_range(TableReader& table, const std::string& key, Axis& axis) {
  Range range{key};
  table.required("from", range.low, io::as_number, Number{});
  table.required("to", range.high, io::as_number, Number{});
  std::string scale = "linear";
  table.optional("scale", scale, io::as_text);
  range.logarithmic = scale == "log";
  if (scale != "log" && scale != "linear")
    table.find("scale")->complain_found("\"linear\" or \"log\"");
  if (!(range.low < range.high))
    table.at().complain(fmt::format("from {} must be less than to {}", range.low, range.high));
  else if (range.logarithmic && !(range.low > 0.0))
    table.at().complain("a logarithmic range begins above 0");
  int count = 0;
  if (table.optional("count", count, io::as_count))
    for (int i = 0; i < count; ++i) {
      const double share = count > 1 ? static_cast<double>(i) / (count - 1) : 0.0;
      const double value = range.logarithmic ? range.low * std::pow(range.high / range.low, share)
                                             : range.low + share * (range.high - range.low);
      const std::string text = fmt::format("{:.10g}", value);
      axis.levels.push_back({text, {{key, text}}});
    }
  axis.range = std::move(range);
}

std::optional<Axis> as_axis(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Axis axis;
  if (table.has("levels")) {
    const std::optional<At> levels = table.find("levels");
    table.required("name", axis.name, io::as_name);
    read_levels(*levels, axis);
  } else {
    std::string key;
    table.required("key", key, io::as_text);
    axis.name = key;
    table.optional("name", axis.name, io::as_text);
    if (table.has("values")) {
      const std::optional<At> values = table.find("values");
      read_values(*values, key, axis);
      read_sizes(table, axis);
    } else if (table.find("from") || table.find("to")) {
      read_range(table, key, axis);
    } else {
      at.complain("allowed is one of: key and values; key, from, to and count; name and levels");
    }
  }
  table.finish();
  return axis;
}

std::optional<Quantity> as_quantity(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Quantity quantity;
  table.required("name", quantity.name, io::as_name);
  table.optional("scale", quantity.scale, io::as_number, io::positive_number);
  if (table.has("expression")) {
    table.required("expression", quantity.expression, io::as_text);
    check_expression(table, "expression", quantity.expression);
    table.finish();
    return quantity;
  }
  table.required("of", quantity.of, io::as_text);
  table.optional("over", quantity.over, io::as_text);
  check_expression(table, "of", quantity.of);
  check_expression(table, "over", quantity.over);
  table.optional("at", quantity.at, io::as_number, Number{});
  table.optional("from", quantity.from, io::as_number, Number{});
  table.optional("to", quantity.to, io::as_number, Number{});
  quantity.take = quantity.at ? Quantity::Take::at : Quantity::Take::end;
  const bool said = table.optional("take", quantity.take, as_one_of<takes>);
  if ((quantity.take == Quantity::Take::at) != quantity.at.has_value())
    at.complain(said ? "'at' goes with take = \"at\"" : "a value to take is missing",
                "give at = VALUE, or take = \"end\", \"largest\", \"smallest\" or \"mean\"");
  const bool has_window = quantity.take == Quantity::Take::largest ||
                          quantity.take == Quantity::Take::smallest ||
                          quantity.take == Quantity::Take::mean;
  if ((quantity.from || quantity.to) && !has_window)
    at.complain("from and to go with take = \"largest\", \"smallest\" and \"mean\"");
  if (quantity.from && quantity.to && !(*quantity.from < *quantity.to))
    at.complain(fmt::format("from {} must be less than to {}", *quantity.from, *quantity.to));
  table.finish();
  return quantity;
}

std::optional<Sample> as_sample(const At& at) {
  TableReader table(at);
  Sample sample;
  table.required("method", sample.method, as_one_of<methods>);
  table.required("count", sample.count, io::as_count);
  int seed = 1;
  if (table.optional("seed", seed, io::as_count))
    sample.seed = static_cast<std::uint32_t>(seed);
  table.finish();
  return sample;
}

/// { AXIS = LABEL }
io::TableShape labels_of_axes() {
  return {{}, {}, {io::Shape{{io::AnyShape{"a label of the axis"}}}}};
}

std::optional<TradeSettings> as_trade(const At& at) {
  TableReader table(at);
  TradeSettings trade;
  table.optional("quantities", trade.quantities, io::as_texts);
  table.optional("cost", trade.cost, as_one_of<costs>);
  table.optional("within", trade.within, io::as_number, io::positive_number);
  if (const std::optional<At> reference = table.require("reference")) {
    const auto* const text = reference->node.as<std::string>();
    if (reference->inquiry() != nullptr)
      reference->expect(io::WordShape{{"finest"}}, labels_of_axes());
    else if (text != nullptr && *text != "finest")
      reference->complain_found("\"finest\" or a table { AXIS = LABEL }");
    else if (text == nullptr) {
      TableReader labels(*reference);
      for (const auto& [axis, label] : labels.named_items())
        trade.reference[axis] = label_of(label.node);
      if (labels.is_table() && trade.reference.empty())
        reference->complain("allowed is at least one axis");
    }
  }
  table.finish();
  return trade;
}

std::optional<ConvergenceSettings> as_convergence(const At& at) {
  TableReader table(at);
  ConvergenceSettings convergence;
  table.optional("axes", convergence.axes, io::as_texts);
  table.optional("quantities", convergence.quantities, io::as_texts);
  table.finish();
  return convergence;
}

/// Complains of a word that is not one of a list.
void require_known(const At& at,
                   const std::string& what,
                   const std::string& word,
                   const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), word) == known.end())
    at.complain(fmt::format("there is no {} '{}'", what, word), io::suggestion(word, known));
}

template <class Item> std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names(items.size());
  std::transform(items.begin(), items.end(), names.begin(),
                 [](const Item& item) { return item.name; });
  return names;
}

/// The finest level of every axis that refines.
std::map<std::string, std::string> finest(const std::vector<Axis>& axes) {
  std::map<std::string, std::string> labels;
  for (const Axis& axis : axes)
    if (axis.refines())
      labels[axis.name] = axis.finest().label;
  return labels;
}

void check_trade(const At& root, Study& study) {
  if (!study.trade)
    return;
  TableReader table(root);
  const At at = *table.find("trade");
  if (study.sample)
    at.complain("a sample has no reference: leave [sample] or [trade] out");
  for (const std::string& name : study.trade->quantities)
    require_known(at, "quantity", name, names_of(study.quantities));
  if (study.trade->reference.empty())
    study.trade->reference = finest(study.axes);
  if (study.trade->reference.empty())
    at.complain("reference = \"finest\" needs an axis with sizes",
                "give [[vary]] sizes = [...], or reference = { AXIS = LABEL }");
  for (const auto& [name, label] : study.trade->reference) {
    require_known(at, "axis", name, names_of(study.axes));
    for (const Axis& axis : study.axes)
      if (axis.name == name) {
        std::vector<std::string> labels;
        for (const Level& level : axis.levels)
          labels.push_back(level.label);
        require_known(at, "level of " + name, label, labels);
      }
  }
}

void check_convergence(const At& root, Study& study) {
  if (!study.convergence)
    return;
  TableReader table(root);
  const At at = *table.find("convergence");
  if (study.convergence->axes.empty())
    for (const Axis& axis : study.axes)
      if (axis.refines())
        study.convergence->axes.push_back(axis.name);
  if (study.convergence->axes.empty())
    at.complain("there is no axis with sizes to converge over", "give [[vary]] sizes = [...]");
  for (const std::string& name : study.convergence->axes) {
    require_known(at, "axis", name, names_of(study.axes));
    for (const Axis& axis : study.axes)
      if (axis.name == name && !axis.refines())
        at.complain(fmt::format("axis '{}' has no sizes", name), "give [[vary]] sizes = [...]");
      else if (axis.name == name && axis.levels.size() < 3)
        at.complain(fmt::format("axis '{}' has {} levels, an extrapolation needs at least 3", name,
                                axis.levels.size()));
  }
  for (const std::string& name : study.convergence->quantities)
    require_known(at, "quantity", name, names_of(study.quantities));
}

std::vector<std::string> keys_of_overrides(const Study& study) {
  std::vector<std::string> keys(study.overrides.size());
  std::transform(study.overrides.begin(), study.overrides.end(), keys.begin(),
                 [](const std::string& text) { return text.substr(0, text.find('=')); });
  return keys;
}

bool takes_other_cases(const Axis& axis) {
  return std::any_of(axis.levels.begin(), axis.levels.end(),
                     [](const Level& level) { return level.case_file.has_value(); });
}

void check_keys(const At& root, const Study& study) {
  std::vector<Setter> setters{{"set", keys_of_overrides(study)}};
  const Axis* with_cases = nullptr;
  for (const Axis& axis : study.axes) {
    std::vector<std::string> keys = keys_of(axis.levels);
    if (axis.range && axis.levels.empty())
      keys.push_back(axis.range->key);
    setters.push_back({fmt::format("axis '{}'", axis.name), std::move(keys)});
    if (!takes_other_cases(axis))
      continue;
    if (with_cases != nullptr)
      root.complain(
          fmt::format("axes '{}' and '{}' both take other cases", with_cases->name, axis.name),
          "only one of them would count");
    with_cases = &axis;
  }
  refuse_overruled(root, study.case_file, setters);
  if (study.sample && study.axes.empty())
    root.complain("[sample] has nothing to draw from", "give [[vary]] key, from and to, or values");
}

/// Axes and quantities are columns of study.csv.
void check_names(const At& root, const Study& study) {
  std::map<std::string, std::string> known;
  for (const std::string_view column : columns_of_every_study)
    known.emplace(column, fmt::format("study.csv has a column '{}'", column));
  const auto take = [&](const std::string& name, const std::string& what) {
    const auto [before, is_new] =
        known.emplace(name, fmt::format("there is {} '{}' already", what, name));
    if (!is_new)
      root.complain(fmt::format("{}, {} needs another name", before->second, what));
  };
  for (const Axis& axis : study.axes)
    take(axis.name, "an axis");
  for (const Quantity& quantity : study.quantities)
    take(quantity.name, "a quantity");
}

void check_axes(const At& root, const Study& study) {
  check_keys(root, study);
  check_names(root, study);
  for (const Axis& axis : study.axes) {
    std::set<std::string> labels;
    for (const Level& level : axis.levels)
      if (!labels.insert(level.label).second)
        root.complain(fmt::format("axis '{}' has the level '{}' twice", axis.name, level.label));
    if (!study.sample && axis.range && axis.levels.empty())
      root.complain(fmt::format("axis '{}' needs a count of steps", axis.name),
                    "give [[vary]] count = N, or draw from it with [sample]");
  }
}

Study read_root(TableReader& root) {
  Study study;
  read_common(root, study);
  study.axes = read_items<Axis>(root, "vary", as_axis);
  root.optional("sample", study.sample, as_sample);
  study.quantities = read_items<Quantity>(root, "quantity", as_quantity);
  root.optional("trade", study.trade, as_trade);
  root.optional("convergence", study.convergence, as_convergence);
  root.finish();
  check_axes(root.at(), study);
  if (root.context().complaints.empty()) {
    check_trade(root.at(), study);
    check_convergence(root.at(), study);
  }
  return study;
}

} // namespace

bool Axis::refines() const {
  return !levels.empty() && std::all_of(levels.begin(), levels.end(),
                                        [](const Level& level) { return level.size.has_value(); });
}

const Level& Axis::finest() const {
  return *std::min_element(levels.begin(), levels.end(),
                           [](const Level& a, const Level& b) { return *a.size < *b.size; });
}

io::Shape study_shape() {
  return shape_of_file([](TableReader& root) { (void)read_root(root); });
}

Study read_study(const fs::path& file, const std::vector<std::string>& overrides) {
  Study study;
  read_file(file, overrides, [&](TableReader& root) { study = read_root(root); });
  return study;
}

} // namespace billet::study

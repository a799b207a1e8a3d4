#include "study/study_reader.h"

#include "io/case/units.h"
#include "io/case/values.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <system_error>

#include "study/expression.h"
#include "study/file_text.h"
#include "study/node_text.h"

namespace billet::study {

namespace {

namespace fs = std::filesystem;
using io::At;
using io::TableReader;

constexpr std::array engines{io::Word<Engine::Kind>{"local", Engine::Kind::local},
                             io::Word<Engine::Kind>{"slurm", Engine::Kind::slurm},
                             io::Word<Engine::Kind>{"commands", Engine::Kind::commands}};

std::optional<Engine::Kind> as_engine_kind(const At& at) { return io::as_word(at, engines); }

/// { from, to, count, scale } as numbers.
std::optional<std::vector<double>> as_range(const At& at) {
  TableReader table(at);
  double low = 0.0, high = 0.0;
  int count = 0;
  std::string scale = "linear";
  const bool good = table.required("from", low, io::as_number, io::Number{}) &&
                    table.required("to", high, io::as_number, io::Number{}) &&
                    table.required("count", count, io::as_count);
  table.optional("scale", scale, io::as_text);
  table.finish();
  const bool logarithmic = scale == "log";
  if (!good || count < 2 || !(low < high) || (logarithmic && !(low > 0.0)) ||
      (!logarithmic && scale != "linear")) {
    at.complain_found("a list of numbers, or { from, to, count, scale = \"linear\" or \"log\" }, "
                      "from below to, count at least 2, from above 0 where logarithmic");
    return std::nullopt;
  }
  std::vector<double> steps;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    steps.push_back(logarithmic ? low * std::pow(high / low, share) : low + share * (high - low));
  }
  return steps;
}

} // namespace

std::string label_of(const io::Node& node) {
  const auto* const text = node.as<std::string>();
  return text != nullptr ? *text : toml_text(node);
}

std::optional<std::vector<Assignment>> as_assignments(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  std::vector<Assignment> set;
  for (const auto& [key, value] : table.named_items())
    set.push_back({key, toml_text(value.node)});
  return set;
}

std::optional<Level> as_level(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Level level;
  table.required("label", level.label, [](const At& label) -> std::optional<std::string> {
    return label_of(label.node);
  });
  std::string case_file;
  if (table.optional("case", case_file, io::as_text))
    level.case_file = at.context.directory / case_file;
  if (!level.case_file && !table.find("set"))
    (void)table.require("set");
  std::error_code error;
  if (level.case_file && !fs::exists(*level.case_file, error))
    table.find("case")->complain(fmt::format("there is no file '{}'", level.case_file->string()));
  if (table.has("set"))
    table.required("set", level.set, as_assignments);
  table.optional("size", level.size, io::as_number, io::positive_number);
  table.finish();
  return level;
}

std::optional<Engine> as_engine(const At& at) {
  TableReader table(at);
  Engine engine;
  table.optional("engine", engine.kind, as_engine_kind);
  table.optional("processes", engine.processes, io::as_count);
  table.optional("threads", engine.threads, io::as_count);
  table.optional("options", engine.options, io::as_texts);
  table.optional("frames", engine.frames, io::as_flag);
  table.finish();
  return engine;
}

std::optional<std::vector<double>> as_steps(const At& at) {
  std::optional<std::vector<double>> steps =
      at.is_a<io::Table>() ? as_range(at) : io::as_numbers(at, io::Number{});
  for (std::size_t i = 1; steps && i < steps->size(); ++i)
    if (!((*steps)[i - 1] < (*steps)[i])) {
      at.complain(
          fmt::format("values must increase, found {} after {}", (*steps)[i], (*steps)[i - 1]));
      return std::nullopt;
    }
  return steps;
}

void check_expression(TableReader& table, const std::string& key, const std::string& text) {
  const std::optional<At> at = table.find(key);
  if (!at || at->inquiry() != nullptr)
    return;
  if (const std::string mistake = Expression::mistake_in(text); !mistake.empty())
    at->complain(mistake);
}

void read_common(TableReader& root, Study& study) {
  root.optional("title", study.title, io::as_text);
  std::string case_file = "case.toml";
  root.optional("case", case_file, io::as_text);
  study.case_file = root.context().directory / case_file;
  std::error_code error;
  if (const std::optional<At> at = root.find("case"); at && !fs::exists(study.case_file, error))
    at->complain(fmt::format("there is no file '{}'", study.case_file.string()));
  std::vector<Assignment> set;
  if (root.optional("set", set, as_assignments))
    for (const Assignment& assignment : set)
      study.overrides.push_back(assignment.key + "=" + assignment.value);
  root.optional("run", study.engine, as_engine);
}

io::Shape shape_of_file(const std::function<void(TableReader& root)>& read) {
  io::Complaints complaints("");
  io::ReadContext context{complaints, io::unit_systems().front(), std::nullopt, ".", true};
  io::Inquiry inquiry;
  const io::Node node{io::TextPlace{}, &inquiry};
  (void)io::read_value_of(At{node, "", context}, [&](const At& at) {
    TableReader root(at);
    read(root);
    return true;
  });
  return inquiry.take();
}

void read_file(const fs::path& file,
               const std::vector<std::string>& overrides,
               const std::function<void(TableReader& root)>& read) {
  io::Complaints complaints(file.string());
  io::Node tree = io::parse_document(text_of_file(file), file.string());
  io::apply_overrides(tree, overrides, complaints);
  complaints.throw_if_any();
  io::ReadContext context{complaints, io::unit_systems().front(), std::nullopt,
                          file.has_parent_path() ? file.parent_path() : fs::path("."), true};
  TableReader root(At{tree, "", context});
  read(root);
  complaints.throw_if_any();
}

} // namespace billet::study

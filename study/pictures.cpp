#include "study/pictures.h"

#include "io/results/atomic_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace billet::study {

namespace {

namespace fs = std::filesystem;

/// A label that is a number as a whole.
std::optional<double> number_in(const std::string& label) {
  char* end = nullptr;
  const double value = std::strtod(label.c_str(), &end);
  return end != label.c_str() && *end == '\0' ? std::optional(value) : std::nullopt;
}

/// Places of the levels along an axis: the numbers that they are, or their sizes.
std::optional<std::vector<double>>
places_of(const Axis& axis, const std::vector<OutcomeRow>& rows, std::size_t position) {
  std::vector<double> places;
  for (const OutcomeRow& row : rows) {
    const std::string& label = row.row.labels[position];
    std::optional<double> place = number_in(label);
    for (const Level& level : axis.levels)
      if (level.label == label && level.size && !place)
        place = level.size;
    if (!place)
      return std::nullopt;
    places.push_back(*place);
  }
  return places;
}

/// Name of a file from text that may hold anything.
std::string file_name(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_ascii = byte < 0x80; // letters of other alphabets stay
        return is_ascii && std::isalnum(byte) == 0 && c != '-' && c != '_';
      },
      '_');
  return text;
}

/// Writes x,y below a header; a name of the series for billet-render.
std::string series(const fs::path& file,
                   const std::vector<std::pair<double, double>>& points,
                   const std::string& label) {
  std::string text = "x,y\n";
  for (const auto& [x, y] : points)
    text += fmt::format("{:.10g},{:.10g}\n", x, y);
  io::write_file(file, text);
  std::string name = label;
  std::replace(name.begin(), name.end(), ':', ' ');
  return fmt::format("{}:x:y:{}", file.string(), name.empty() ? "values" : name);
}

/// Whether a row has the finest level of every axis that refines, but for one.
bool is_finest(const Study& study, const Row& row, std::size_t but) {
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (a != but && study.axes[a].refines() && row.labels[a] != study.axes[a].finest().label)
      return false;
  return true;
}

/// A quantity over an axis, a curve for every combination of the other axes' levels.
std::optional<Picture> response_of(const Study& study,
                                   const std::vector<OutcomeRow>& rows,
                                   std::size_t axis,
                                   std::size_t quantity,
                                   const fs::path& folder,
                                   bool only_finest) {
  constexpr std::size_t most_curves = 7; // that colours tell apart
  const std::optional<std::vector<double>> places = places_of(study.axes[axis], rows, axis);
  if (!places)
    return std::nullopt;
  std::map<std::string, std::vector<std::pair<double, double>>> curves;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!rows[r].good() || (only_finest && !is_finest(study, rows[r].row, axis)))
      continue;
    std::vector<std::string> others;
    for (std::size_t a = 0; a < study.axes.size() && !study.sample; ++a)
      if (a != axis)
        others.push_back(fmt::format("{} {}", study.axes[a].name, rows[r].row.labels[a]));
    curves[fmt::format("{}", fmt::join(others, ", "))].emplace_back((*places)[r],
                                                                    rows[r].values[quantity]);
  }
  if (curves.empty() || curves.size() > most_curves)
    return std::nullopt;
  const std::string name =
      file_name(fmt::format("{}-over-{}", study.quantities[quantity].name, study.axes[axis].name));
  Picture picture{{"--curve", "--tight"}};
  std::size_t number = 0;
  for (auto& [label, points] : curves) {
    std::sort(points.begin(), points.end());
    if (study.sample)
      picture.arguments.emplace_back("--points");
    picture.arguments.push_back(
        series(folder / fmt::format("{}-{}.csv", name, ++number), points, label));
  }
  for (const std::string& word :
       {std::string("--x-label"), study.axes[axis].name, std::string("--y-label"),
        study.quantities[quantity].name, std::string("--title"), study.title, std::string("-o"),
        (folder.parent_path() / (name + ".png")).string()})
    picture.arguments.push_back(word);
  return picture;
}

/// Of all combinations, or where these are too many of the finest only.
std::optional<Picture> response(const Study& study,
                                const std::vector<OutcomeRow>& rows,
                                std::size_t axis,
                                std::size_t quantity,
                                const fs::path& folder) {
  std::optional<Picture> picture = response_of(study, rows, axis, quantity, folder, false);
  return picture ? picture : response_of(study, rows, axis, quantity, folder, true);
}

std::optional<Picture> pareto(const Study& study, const Trade& trade, const fs::path& folder) {
  std::vector<std::pair<double, double>> all, front;
  constexpr double percent = 100.0;
  const auto point = [&](const Setting& setting) {
    return std::pair(setting.cost, percent * setting.error);
  };
  for (const Setting& setting : trade.settings)
    if (!setting.is_reference && std::isfinite(setting.error) && setting.error > 0.0)
      all.push_back(point(setting));
  for (const std::size_t s : trade.front)
    if (trade.settings[s].error > 0.0)
      front.push_back(point(trade.settings[s]));
  if (all.empty())
    return std::nullopt;
  return Picture{{"--curve", "--log-x", "--log-y", series(folder / "front.csv", front, "front"),
                  "--points", series(folder / "settings.csv", all, "settings"), "--x-label",
                  fmt::format("cost [{}]", unit_of(study.trade->cost)), "--y-label", "error [%]",
                  "--title", study.title, "-o", (folder.parent_path() / "trade.png").string()}};
}

} // namespace

std::vector<Picture>
pictures_of(const Study& study, const Conducted& result, const fs::path& folder) {
  const fs::path charts = folder / "charts";
  io::make_folder(charts);
  std::vector<Picture> pictures;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    for (std::size_t q = 0; q < study.quantities.size(); ++q)
      if (std::optional<Picture> picture = response(study, result.rows, a, q, charts))
        pictures.push_back(std::move(*picture));
  if (result.findings.trade)
    if (std::optional<Picture> picture = pareto(study, *result.findings.trade, charts))
      pictures.push_back(std::move(*picture));
  return pictures;
}

} // namespace billet::study

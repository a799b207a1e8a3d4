#include "io/deck/read_amplitude.h"

#include "geometry/base/error.h"
#include "io/deck/deck_names.h"
#include "io/mesh/scanner.h"
#include "io/text/text.h"

#include <fmt/format.h>

namespace billet::io {

namespace {

double shift_of(const DeckKeyword& keyword, const char* parameter) {
  double shift = 0.0;
  if (keyword.has(parameter) && !parse_real(keyword.value(parameter), shift))
    throw Error(Fault::geometry, keyword.place,
                fmt::format("*{}: {}=\"{}\" is not a number", keyword.written, parameter,
                            keyword.value(parameter).substr(0, 30)));
  return shift;
}

/// Pairs of a time and a factor, several on a line.
void add_points(const DeckKeyword& keyword, std::size_t line, DeckAmplitude& amplitude) {
  const double shift_time = shift_of(keyword, "SHIFTX"), shift_factor = shift_of(keyword, "SHIFTY");
  for (std::size_t i = 0; i < keyword.data[line].size(); i += 2) {
    const double time = keyword.number(line, i).value_or(0.0) + shift_time;
    const double factor = keyword.number(line, i + 1).value_or(0.0) + shift_factor;
    if (!amplitude.points.empty() && !(time > amplitude.points.back().first))
      throw Error(Fault::geometry, keyword.places[line],
                  fmt::format("*{}: the time {:g} is not after the one before, {:g}",
                              keyword.written, time, amplitude.points.back().first),
                  "points of an amplitude are time, factor, with times that rise; where it jumps "
                  "they lie a little apart");
    amplitude.points.emplace_back(time, factor);
  }
}

} // namespace

void read_amplitude(Deck& deck, const DeckKeyword& keyword) {
  const std::string kind = keyword.has("USER") ? "USER" : keyword.word("DEFINITION");
  if (!kind.empty() && kind != "TABULAR" && kind != "SMOOTHSTEP")
    return note(
        deck, keyword,
        fmt::format("NAME={}: DEFINITION={} is not available, left out: write it as a table",
                    keyword.value("NAME"), kind));
  if (kind == "SMOOTHSTEP")
    note(deck, keyword, "DEFINITION=SMOOTH STEP is taken as a table, straight between its points");
  DeckAmplitude amplitude;
  amplitude.total_time = keyword.word("TIME").starts_with("TOTAL");
  amplitude.absolute = keyword.word("VALUE") == "ABSOLUTE";
  for (std::size_t line = 0; line < keyword.data.size(); ++line)
    add_points(keyword, line, amplitude);
  if (amplitude.points.empty())
    return note(deck, keyword,
                fmt::format("NAME={} has no points, left out", keyword.value("NAME")));
  const std::string name = in_capitals(keyword.value("NAME"));
  if (!deck.amplitudes.insert_or_assign(name, amplitude).second)
    note(deck, keyword, fmt::format("NAME={} is there twice, the last is taken", name));
}

} // namespace billet::io

// Small decks for tests, and what becomes of them.

#pragma once

#include "io/case/read_case.h"
#include "io/translate/deck_case.h"
#include "io/translate/deck_history.h"
#include "tests/io/case/case_text.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace billet::io {

inline Deck deck_of(const std::string& text, const test::TemporaryFolder& folder) {
  const auto file = folder.path() / "job.inp";
  std::ofstream(file) << text;
  return read_deck(file, {folder.path(), false});
}

inline DeckCase case_of_text(const std::string& text, const test::TemporaryFolder& folder) {
  return case_of(deck_of(text, folder), deck_units().front(), "job.inp");
}

/// Writes the files of a case and reads it as the program does.
inline Case read_back(const DeckCase& made, const test::TemporaryFolder& folder) {
  for (const DeckFile& file : made.files)
    std::ofstream(folder.path() / file.name) << file.content;
  return read_case(folder.path() / "case.toml");
}

inline bool remarks_say(const DeckCase& made, const std::string& text) {
  return std::any_of(made.remarks.begin(), made.remarks.end(), [&](const DeckRemark& one) {
    return (one.place + ": " + one.text).find(text) != std::string::npos;
  });
}

/// A square that is pulled; its parts are put together as a test needs them.
struct Pulled {
  std::string material = "*PLASTIC\n300,0\n";
  std::string model = {};            // before the first step
  std::string amplitude = "0,0,1,1"; // points
  std::string parameters = {};       // of *AMPLITUDE
  std::string first = "*BOUNDARY,AMPLITUDE=A\nTOP,2,2,-0.5\n";
  std::string second = {}; // of a second step of 1 s; empty: there is none

  [[nodiscard]] std::string text() const {
    const std::string last =
        second.empty() ? "" : "*STEP\n*STATIC\n0.1,1\n" + second + "*END STEP\n";
    return "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT,TYPE=CPE4,ELSET=E\n1,1,2,3,4\n"
           "*NSET,NSET=BOT\n1,2\n*ELSET,ELSET=PIECE\n1\n*NSET,NSET=TOP\n3,4\n"
           "*SOLID SECTION,ELSET=E,MATERIAL=M\n1.\n*MATERIAL,NAME=M\n*ELASTIC\n2e5,0.3\n" +
           material + "*BOUNDARY\nBOT,2,2\nBOT,1,1\n" + "*AMPLITUDE,NAME=A" + parameters + "\n" +
           amplitude + "\n" + model + "*STEP,NLGEOM\n*STATIC\n0.1,1\n" + first + "*END STEP\n" +
           last;
  }
};

/// How the upper edge moves.
inline DeckHistory pull_of(const Pulled& pulled) {
  const test::TemporaryFolder folder;
  Deck deck = deck_of(pulled.text(), folder);
  return prescribed_motions(deck).at("TOP").components.at(2);
}

inline DeckCase case_of_pulled(const Pulled& pulled) {
  const test::TemporaryFolder folder;
  return case_of_text(pulled.text(), folder);
}

/// The remarks on a deck, one a line.
inline std::string remarks_on(const Pulled& pulled) {
  std::string all;
  for (const DeckRemark& one : case_of_pulled(pulled).remarks)
    all += one.place.substr(one.place.find_last_of('/') + 1) + ": " + one.text + "\n";
  return all;
}

inline Case read_pulled(const Pulled& pulled) {
  const test::TemporaryFolder folder;
  return read_back(case_of_text(pulled.text(), folder), folder);
}

inline void expect_history(const DeckHistory& found, const DeckHistory& wanted) {
  constexpr double rounding = 1e-14; // times and values are of the order of 1
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_NEAR(found[i].first, wanted[i].first, rounding) << "point " << i;
    EXPECT_NEAR(found[i].second, wanted[i].second, rounding) << "point " << i;
  }
}

inline void expect_remark(const std::string& remarks, const std::string& wanted) {
  EXPECT_NE(remarks.find(wanted), std::string::npos) << wanted << "\nis not in\n" << remarks;
}

} // namespace billet::io

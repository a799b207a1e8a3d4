#include "io/case/suggestion.h"

#include "io/case/other_words.h"
#include "io/text/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace billet::io {

namespace {

constexpr std::size_t longest_word = 64; // longer text is no misspelt key
constexpr std::size_t most_listed = 20;

/// How far apart two words of these lengths may be and still be taken for one another.
int largest_distance(std::string_view a, std::string_view b) {
  return static_cast<int>(std::max(a.size(), b.size()) + 2) / 4;
}

} // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1, 0));
  for (std::size_t i = 0; i <= a.size(); ++i)
    d[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j)
    d[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string Meant::text() const {
  return fmt::format("did you mean '{}'?{}{}", word, remark.empty() ? "" : " ", remark);
}

std::optional<Meant> meant(std::string_view found, const std::vector<std::string>& known) {
  if (const std::optional<OurWord> ours = our_word(found, known))
    return Meant{std::string(ours->word), std::string(ours->remark)};
  const std::string* nearest = nullptr;
  int least = 0;
  for (const std::string& word : known) {
    if (found.size() > longest_word || word.size() > longest_word)
      continue;
    const int distance = edit_distance(in_small_letters(found), in_small_letters(word));
    if (distance <= largest_distance(found, word) && (nearest == nullptr || distance < least)) {
      nearest = &word;
      least = distance;
    }
  }
  return nearest != nullptr ? std::optional(Meant{*nearest, {}}) : std::nullopt;
}

std::string
suggestion(std::string_view found, const std::vector<std::string>& known, std::string_view label) {
  if (const std::optional<Meant> word = meant(found, known))
    return word->text();
  if (known.empty() || known.size() > most_listed)
    return {};
  return fmt::format("{} {}", label, fmt::join(known, ", "));
}

} // namespace billet::io

#include "io/results/xml_text.h"

#include <array>
#include <utility>

namespace billet::io {

namespace {

constexpr std::array<std::pair<char, std::string_view>, 5> entities{
    {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&apos;"}}};

} // namespace

std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    std::string_view replacement(&c, 1);
    for (const auto& [character, entity] : entities)
      if (c == character)
        replacement = entity;
    result += replacement;
  }
  return result;
}

std::string xml_unescaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::size_t length = 1;
    char c = text.front();
    for (const auto& [character, entity] : entities)
      if (text.starts_with(entity)) {
        c = character;
        length = entity.size();
      }
    result += c;
    text.remove_prefix(length);
  }
  return result;
}

} // namespace billet::io

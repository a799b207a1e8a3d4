// Two summaries: every figure that is a result.

#include "geometry/base/error.h"
#include "io/compare/compare_parts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <map>
#include <optional>

namespace billet::io {

namespace {

using Json = nlohmann::ordered_json;

/// What says how a run was made, and what is a text about its figures.
constexpr std::array<std::string_view, 14> of_the_run{"title",
                                                      "billet",
                                                      "threads",
                                                      "blas_kernels",
                                                      "increments",
                                                      "iterations",
                                                      "cutbacks",
                                                      "iterations_of_failed_tries",
                                                      "iterations_on_new_meshes",
                                                      "warnings",
                                                      "failure",
                                                      "seconds",
                                                      "resources",
                                                      "linear_solver"};

/// A number with the largest one of its list, or a text.
struct Leaf {
  std::optional<double> number;
  double scale = 0.0;
  std::string text;
};

using Leaves = std::map<std::string, Leaf>;

/// Items of lists are called by their name, where they have one.
std::string name_of(const Json& item, std::size_t i) {
  for (const char* key : {"name", "check", "tool"})
    if (item.is_object() && item.contains(key) && item[key].is_string())
      return item[key].get<std::string>();
  return std::to_string(i);
}

double largest_of(const Json& list) {
  double largest = 0.0;
  for (const Json& item : list)
    if (item.is_number())
      largest = std::max(largest, std::abs(item.get<double>()));
  return largest;
}

void flatten_json(const Json& value, const std::string& path, double scale, Leaves& leaves) {
  const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items())
      if (!path.empty() || std::find(of_the_run.begin(), of_the_run.end(), key) == of_the_run.end())
        flatten_json(inner, below(key), 0.0, leaves);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      flatten_json(value[i], below(name_of(value[i], i)), largest_of(value), leaves);
  } else if (value.is_number()) {
    const double number = value.get<double>();
    leaves[path] = {number, std::max(scale, std::abs(number)), ""};
  } else if (!value.is_null()) {
    leaves[path] = {std::nullopt, 0.0, value.is_string() ? value.get<std::string>() : value.dump()};
  }
}

Leaves read_summary(const std::filesystem::path& file) {
  std::ifstream stream(file);
  Leaves leaves;
  try {
    flatten_json(Json::parse(stream), "", 0.0, leaves);
  } catch (const Json::exception&) {
    throw Error(Fault::input_output, file.string(), "is no summary of a run", "",
                error_code::results_unreadable);
  }
  return leaves;
}

std::string text_of(const Leaf& leaf) {
  return leaf.number ? number_text(*leaf.number) : leaf.text;
}

Difference difference_of(const std::string& path, const Leaf& a, const Leaf& b) {
  if (!a.number || !b.number)
    return text_difference("summary " + path, text_of(a), text_of(b));
  LargestDifference largest;
  largest.look_at(*a.number, *b.number, "");
  Difference difference = largest.of("summary " + path);
  difference.scale = std::max(a.scale, b.scale);
  return difference;
}

} // namespace

void compare_summaries(const std::filesystem::path& first_file,
                       const std::filesystem::path& second_file,
                       Comparison& into) {
  for (const std::filesystem::path& file : {first_file, second_file})
    if (!std::filesystem::exists(file)) {
      into.notes.push_back(file.string() +
                           " is not there: a run that is going on or was killed; summaries are not "
                           "compared");
      return;
    }
  Leaves first = read_summary(first_file), second = read_summary(second_file);
  Leaves all = first;
  all.insert(second.begin(), second.end());
  for (const auto& [path, leaf] : all) {
    const auto a = first.find(path), b = second.find(path);
    if (a == first.end() || b == second.end())
      into.quantities.push_back(text_difference("summary " + path,
                                                a == first.end() ? "absent" : text_of(leaf),
                                                b == second.end() ? "absent" : text_of(leaf)));
    else
      into.quantities.push_back(difference_of(path, a->second, b->second));
  }
}

} // namespace billet::io

#include "io/case/schema.h"

#include "io/case/values.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace billet::io {

namespace {

using Json = nlohmann::ordered_json;

Json schema_of(const Shape& shape);

/// A number of a case file as a text: with its unit, which the program looks at.
constexpr auto number_with_unit = R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*\S)";

struct Describe {
  Json operator()(const NumberShape& shape) const {
    Json number{{"type", "number"}};
    const auto& [low, high, low_open, high_open] = shape.bounds;
    if (std::isfinite(low))
      number[low_open ? "exclusiveMinimum" : "minimum"] = low;
    if (std::isfinite(high))
      number[high_open ? "exclusiveMaximum" : "maximum"] = high;
    const std::string allowed = bounds_text(shape.bounds);
    number["description"] = allowed == "a number"
                                ? std::string(shape.measured.name)
                                : fmt::format("{}: {}", shape.measured.name, allowed);
    if (!shape.measured.takes_unit)
      return number;
    const std::string example =
        fmt::format("{}, as \"10 {}\"", shape.measured.name, shape.measured.example);
    const Json text{{"type", "string"}, {"pattern", number_with_unit}, {"description", example}};
    return {{"anyOf", {number, text}}};
  }

  Json operator()(const CountShape& shape) const {
    return {{"type", "integer"}, {"minimum", shape.least}, {"maximum", shape.most}};
  }

  Json operator()(const TextShape& shape) const {
    Json text{{"type", "string"}, {"description", shape.what}};
    if (!shape.pattern.empty())
      text["pattern"] = shape.pattern;
    return text;
  }

  Json operator()(const WordShape& shape) const {
    return shape.words.size() == 1 ? Json{{"const", shape.words.front()}}
                                   : Json{{"enum", shape.words}};
  }

  Json operator()(const FlagShape& /*shape*/) const { return {{"type", "boolean"}}; }

  Json operator()(const AnyShape& shape) const { return {{"description", shape.what}}; }

  Json operator()(const ListShape& shape) const {
    Json list{{"type", "array"}};
    if (!shape.item.front().alternatives.empty())
      list["items"] = schema_of(shape.item.front());
    if (shape.least > 0)
      list["minItems"] = shape.least;
    if (shape.most < std::numeric_limits<std::size_t>::max())
      list["maxItems"] = shape.most;
    return list;
  }

  Json operator()(const TableShape& shape) const {
    Json properties = Json::object(), required = Json::array();
    for (const KeyShape& key : shape.keys) {
      Json value = schema_of(key.shape);
      if (!key.initial.empty())
        value["default"] = Json::parse(key.initial);
      properties[key.key] = std::move(value);
      if (key.required)
        required.push_back(key.key);
    }
    Json table{{"type", "object"}, {"properties", std::move(properties)}};
    if (!required.empty())
      table["required"] = std::move(required);
    table["additionalProperties"] =
        shape.named.empty() ? Json(false) : schema_of(shape.named.front());
    return table;
  }
};

Json schema_of(const Shape& shape) {
  Json alternatives = Json::array();
  for (const Alternative& alternative : shape.alternatives)
    alternatives.push_back(std::visit(Describe{}, alternative));
  return alternatives.size() == 1 ? alternatives.front() : Json{{"anyOf", std::move(alternatives)}};
}

} // namespace

std::string json_schema(const Shape& shape, std::string_view title) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(schema_of(shape));
  return schema.dump(2) + "\n";
}

} // namespace billet::io

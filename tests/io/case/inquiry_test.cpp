// The reader's own answer to what it reads.

#include "io/case/inquiry.h"
#include "io/case/read_case.h"
#include "io/case/schema.h"
#include "io/case/table_reader.h"
#include "io/case/values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace billet::io::inquiry_test {

namespace {

const KeyShape* find_key(const TableShape& table, const std::string& key) {
  const auto found = std::find_if(table.keys.begin(), table.keys.end(),
                                  [&](const KeyShape& one) { return one.key == key; });
  return found == table.keys.end() ? nullptr : &*found;
}

const TableShape& only_table(const Shape& shape) {
  EXPECT_EQ(shape.alternatives.size(), 1U);
  return std::get<TableShape>(shape.alternatives.front());
}

/// The alternative of a table whose labels hold a word.
const TableShape* with_label(const Shape& shape, const std::string& label) {
  for (const Alternative& alternative : shape.alternatives)
    if (const auto* const table = std::get_if<TableShape>(&alternative))
      if (std::find(table->labels.begin(), table->labels.end(), label) != table->labels.end())
        return table;
  return nullptr;
}

const Shape& item_of(const Shape& shape) {
  return std::get<ListShape>(shape.alternatives.front()).item.front();
}

/// What a reader asks of a table.
Shape asked(const std::function<void(TableReader&)>& read) {
  Complaints complaints("");
  ReadContext context{complaints, unit_systems().front(), Analysis::plane_strain, {}, false};
  Inquiry inquiry;
  const Node node{TextPlace{}, &inquiry};
  (void)read_value_of(At{node, "", context}, [&](const At& at) {
    TableReader table(at);
    read(table);
    return true;
  });
  EXPECT_TRUE(complaints.empty());
  return inquiry.take();
}

TEST(Inquiry, notes_key_kind_bounds_and_default) {
  const Shape shape = asked([](TableReader& table) {
    double penalty = 100.0;
    std::string name;
    table.required("name", name, as_name);
    table.optional("penalty", penalty, as_number, positive_stress);
  });
  const TableShape& table = only_table(shape);
  ASSERT_EQ(table.keys.size(), 2U);
  EXPECT_TRUE(find_key(table, "name")->required);
  const KeyShape& penalty = *find_key(table, "penalty");
  EXPECT_FALSE(penalty.required);
  EXPECT_EQ(penalty.initial, "100");
  const auto& number = std::get<NumberShape>(penalty.shape.alternatives.front());
  EXPECT_EQ(number.measured.name, quantity::stress.name);
  EXPECT_TRUE(number.bounds.low_open);
}

TEST(Inquiry, a_word_that_decides_on_other_keys_gives_an_alternative_for_each) {
  constexpr std::array words{Word<int>{"one", 1}, Word<int>{"two", 2}};
  const Shape shape = asked([&](TableReader& table) {
    int kind = 0;
    double value = 0.0;
    table.required("kind", kind, [&](const At& at) { return as_choice(at, words); });
    table.required(kind == 1 ? "a" : "b", value, as_number, Number{});
  });
  ASSERT_EQ(shape.alternatives.size(), 2U);
  EXPECT_NE(find_key(*with_label(shape, "one"), "a"), nullptr);
  EXPECT_EQ(find_key(*with_label(shape, "one"), "b"), nullptr);
  EXPECT_NE(find_key(*with_label(shape, "two"), "b"), nullptr);
}

TEST(Inquiry, a_key_that_is_refused_whatever_it_is_is_none) {
  const Shape shape = asked([](TableReader& table) {
    if (const std::optional<At> at = table.find("gone"))
      at->complain("it was taken out");
  });
  EXPECT_TRUE(only_table(shape).keys.empty());
}

TEST(Inquiry, ways_that_would_go_unseen_are_an_error_of_the_program) {
  Complaints complaints("");
  ReadContext context{complaints, unit_systems().front(), Analysis::plane_strain, {}, false};
  Inquiry inquiry;
  const Node node{TextPlace{}, &inquiry};
  TableReader table(At{node, "", context});
  EXPECT_THROW((void)table.has("key"), std::logic_error);
}

TEST(CaseShape, has_the_keys_of_every_law_surface_and_press) {
  const Shape shape = case_shape();
  const TableShape& root = only_table(shape);
  for (const char* key : {"analysis", "workpiece", "material"})
    EXPECT_TRUE(find_key(root, key)->required) << key;
  const TableShape& tool = only_table(item_of(find_key(root, "tool")->shape));
  const Shape& surface = find_key(tool, "surface")->shape;
  EXPECT_EQ(surface.alternatives.size(), 11U);
  EXPECT_NE(find_key(*with_label(surface, "stl"), "unit"), nullptr);
  EXPECT_TRUE(find_key(*with_label(surface, "stl"), "unit")->required);
  const Shape& friction = find_key(tool, "friction")->shape;
  const TableShape& levanov = *with_label(friction, "levanov");
  EXPECT_NE(find_key(levanov, "exponent"), nullptr);
  EXPECT_EQ(find_key(levanov, "mu"), nullptr);
  const TableShape& motion = only_table(find_key(tool, "motion")->shape);
  const TableShape& screw = *with_label(find_key(motion, "press")->shape, "screw");
  EXPECT_TRUE(find_key(screw, "pitch")->required);
}

TEST(CaseShape, a_material_of_the_library_needs_nothing_else) {
  const Shape shape = case_shape();
  const Shape& material = only_table(find_key(only_table(shape), "material")->shape).named.front();
  const TableShape& own = *with_label(material, "without library");
  EXPECT_TRUE(find_key(own, "elastic")->required);
  const TableShape& of_library = *with_label(material, "with library");
  EXPECT_TRUE(find_key(of_library, "library")->required);
  EXPECT_FALSE(find_key(of_library, "elastic")->required);
}

TEST(Schema, closes_tables_and_gives_units_as_text) {
  const std::string schema = json_schema(case_shape(), "cases");
  EXPECT_NE(schema.find("\"additionalProperties\": false"), std::string::npos);
  EXPECT_NE(schema.find("\"hansel-spittel\""), std::string::npos);
  EXPECT_NE(schema.find("a stress, as \\\"10 MPa\\\""), std::string::npos);
}

} // namespace

} // namespace billet::io::inquiry_test

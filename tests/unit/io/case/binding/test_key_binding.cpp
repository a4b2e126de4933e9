// One row of a table of keys gives reading, ranges, defaults, writing and the keys of other kinds.

#include "io/case/binding/key_binding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "base/error.hpp"
#include "results/case_json_schema.hpp"

namespace perilink {
namespace {

using testing::HasSubstr;

constexpr Kinds toy_damage_run = kinds::bond_based | kinds::plane | kinds::damage;
constexpr Kinds toy_explicit_run = kinds::bond_based | kinds::space | kinds::explicit_;

struct ToySection {
  int count = 3;
  std::optional<double> size;
  Strain strain = Strain::small;
  std::vector<double> times;
  Vector3 at{};
  double depth = 1.0;
  std::vector<int> marks;
  double width = 2.0;
};

/// What a new key needs: its row.
const TableSchema& toy_table() {
  using namespace allowed;
  static const TableSchema table{
      "toy",
      true,
      {key("count", &ToySection::count, from(1, 9), {{kinds::explicit_, {}, {}}}),
       key("size", &ToySection::size, positive).needed("the size of the toy"),
       key("strain", &ToySection::strain),
       key("times", &ToySection::times, not_negative),
       key("at", &ToySection::at, Values::Kind::position),
       key("depth", &ToySection::depth, fraction).only_with("strain", {"green"}).hinted("try 0.5"),
       key("marks", &ToySection::marks, from(1, 9), {{kinds::explicit_, {}, {}}})
           .ascending()
           .hinted("sort them")
           .instead_of("times"),
       {"weight", {Values::Kind::number, positive}},
       KeySchema("side", {{"left", "right"}}).beside("weight").needed("its side"),
       key("width", &ToySection::width, positive).derived()},
      {}};
  return table;
}

ToySection read_toy(const std::string& text, Kinds kind = toy_damage_run) {
  const TomlValue root = parse_toml(text, "toy.toml");
  ToySection section, others;
  read_keys(toy_table(), CaseTable(root, "toy[1]", "toy.toml"), kind, &section, &others);
  return section;
}

std::string toy_refusal(const std::string& text, Kinds kind = toy_damage_run) {
  try {
    read_toy(text, kind);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string toy_text(const ToySection& section, Kinds kind = toy_damage_run) {
  TomlWriter out;
  write_keys(toy_table(), out, kind, &section, "");
  return out.take();
}

TEST(KeyBinding, ReadsByTheTypeOfTheMember) {
  const ToySection toy = read_toy(
      "count = 4\nsize = 2\nstrain = \"green\"\ntimes = [0, 0.5]\nat = [1, 2]\ndepth = 0.25");
  EXPECT_EQ(toy.count, 4);
  EXPECT_EQ(toy.size, 2.0);
  EXPECT_EQ(toy.strain, Strain::green);
  EXPECT_EQ(toy.times, (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(toy.at, (Vector3{1.0, 2.0, 0.0}));
  EXPECT_EQ(toy.depth, 0.25);
  EXPECT_EQ(read_toy("size = 1\nat = [1, 2, 3]", toy_explicit_run).at, (Vector3{1.0, 2.0, 3.0}));
}

TEST(KeyBinding, RefusesWhatTheRowExcludes) {
  EXPECT_THAT(toy_refusal("size = 1\ncount = 10"), HasSubstr("an integer from 1 to 9"));
  EXPECT_THAT(toy_refusal("size = 0"),
              HasSubstr("toy.toml:1: toy[1].size: is 0, but must be greater"));
  EXPECT_THAT(toy_refusal("count = 2"), HasSubstr("give the size of the toy"));
  EXPECT_THAT(toy_refusal("size = 1\ntimes = [1, -1]"),
              HasSubstr("is -1, but must not be negative"));
  EXPECT_THAT(toy_refusal("size = 1\nstrain = \"gren\""), HasSubstr("did you mean `green`?"));
  EXPECT_THAT(toy_refusal("size = 1\nat = [1]"), HasSubstr("2 dimensions"));
  EXPECT_THAT(toy_refusal("size = 1\ndepth = 0.1"), HasSubstr("strain is \"small\""));
  EXPECT_THAT(toy_refusal("size = 1\nstrain = \"green\"\ndepth = 1"), HasSubstr("try 0.5"));
}

TEST(KeyBinding, ChecksKeysOfOtherKindsWithoutUsingThem) {
  EXPECT_EQ(read_toy("size = 1\ncount = 4", toy_explicit_run).count, 3);
  EXPECT_THAT(toy_refusal("size = 1\ncount = 10", toy_explicit_run), HasSubstr("from 1 to 9"));
}

TEST(KeyBinding, ChecksOrderAndRivalsOfKeysOfOtherKinds) {
  for (const Kinds kind : {toy_damage_run, toy_explicit_run}) {
    EXPECT_EQ(toy_refusal("size = 1\nmarks = [1, 3]", kind), "accepted");
    EXPECT_THAT(toy_refusal("size = 1\nmarks = [3, 3]", kind),
                HasSubstr("toy.toml:2: toy[1].marks: has 3 after 3, but the numbers must ascend"));
    EXPECT_THAT(toy_refusal("size = 1\nmarks = [3, 2]", kind), HasSubstr("sort them"));
    EXPECT_THAT(toy_refusal("size = 1\nmarks = [3]\ntimes = [1]", kind),
                HasSubstr("toy[1].marks: is given together with `times`"));
  }
}

TEST(KeyBinding, ChecksValuesThatAreReadByHand) {
  EXPECT_EQ(toy_refusal("size = 1\nweight = 2\nside = \"left\""), "accepted");
  EXPECT_THAT(toy_refusal("size = 1\nweight = 0\nside = \"left\""),
              HasSubstr("toy[1].weight: is 0, but must be greater than zero"));
  EXPECT_THAT(toy_refusal("size = 1\nweight = 2\nside = \"lft\""),
              HasSubstr("did you mean `left`?"));
}

TEST(KeyBinding, NeedsAKeyOnlyBesideTheOneThatItDependsOn) {
  EXPECT_EQ(toy_refusal("size = 1"), "accepted");
  EXPECT_THAT(toy_refusal("size = 1\nweight = 2"), HasSubstr("give its side"));
  EXPECT_THAT(toy_refusal("size = 1\nside = \"left\""), HasSubstr("is given without `weight`"));
}

TEST(KeyBinding, ReportsWrongValuesBeforeMissingAndExcludedKeys) {
  EXPECT_THAT(toy_refusal("count = 10"), HasSubstr("toy[1].count: is the integer 10"));
  EXPECT_THAT(toy_refusal("strain = \"gren\"\ndepth = 0.5"),
              HasSubstr("toy[1].strain: is \"gren\", which is not one of the choices"));
}

TEST(KeyBinding, WritesWhatItReads) {
  const std::string text =
      "count = 4\nsize = 2\nstrain = \"green\"\nat = [1, 2]\ndepth = 0.25\nwidth = 2\n";
  EXPECT_EQ(toy_text(read_toy(text)), text);
  EXPECT_EQ(toy_text(ToySection{}), "count = 3\nstrain = \"small\"\nat = [0, 0]\nwidth = 2\n")
      << "neither absent numbers, nor empty lists, nor keys of another word";
  EXPECT_THAT(toy_text(ToySection{}, toy_explicit_run), Not(HasSubstr("count")));
}

TEST(KeyBinding, KnowsDefaults) {
  const auto& keys = toy_table().keys;
  EXPECT_EQ(default_of(keys[0])->integer, 3);
  EXPECT_EQ(default_of(keys[1]), std::nullopt);
  EXPECT_EQ(default_of(keys[2])->text, "small");
  EXPECT_EQ(default_of(keys[5]), std::nullopt)
      << "a default out of range stands for a computed one";
  EXPECT_EQ(default_of(keys.back()), std::nullopt) << "it depends on other keys";
}

TEST(KeyBinding, KeysOfATableAreMembersOfOneSection) {
  for (const TableSchema& table : case_schema()) {
    std::set<std::string> sections;
    for (const KeySchema& key : table.keys) {
      if (key.section != nullptr) sections.insert(key.section->name());
    }
    EXPECT_LE(sections.size(), 1u) << table.name;
  }
}

}  // namespace
}  // namespace perilink

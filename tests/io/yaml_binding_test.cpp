// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/yaml_binding.h"

#include <gmock/gmock.h>

#include <clocale>
#include <limits>
#include <locale>

#include "tests/io/temp_folder.h"

namespace lightstripe {

enum class Fruit { kApple, kPear };
constexpr std::array<EnumName<Fruit>, 2> enum_names(Fruit) {
  return {{{Fruit::kApple, "apple"}, {Fruit::kPear, "pear"}}};
}

struct Inner {
  double sigma = 1.5;
  std::optional<int> count;
};
template <class V>
void visit_fields(V&& v, Inner& o) {
  v("sigma", o.sigma, "px");
  v("count", o.count, "default: all");
}

struct Everything {
  bool flag = false;
  int number = 7;
  std::int64_t wide = 0;
  std::uint64_t seed = 0;
  double value = 0.1;
  std::string name = "x";
  Fruit fruit = Fruit::kApple;
  std::optional<double> maybe;
  std::vector<double> list;
  std::array<int, 2> pair{1, 2};
  Eigen::Vector2d point{0, 0};
  Eigen::Vector3d up{0, -1, 0};
  Inner inner;
  std::vector<Inner> inners;
  std::vector<std::pair<std::string, std::string>> frames;
  YamlSubtree part;
};
template <class V>
void visit_fields(V&& v, Everything& o) {
  v("flag", o.flag);
  v("number", o.number);
  v("wide", o.wide);
  v("seed", o.seed);
  v("value", o.value);
  v("name", o.name);
  v("fruit", o.fruit);
  v("maybe", o.maybe);
  v("list", o.list);
  v("pair", o.pair);
  v("point", o.point);
  v("up", o.up);
  v("inner", o.inner);
  v("inners", o.inners);
  v("frames", o.frames);
  v("part", o.part);
}

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

Everything read(const std::string& text) {
  const TempFolder folder;
  Everything out;
  read_yaml(folder.write("a.yaml", text), out);
  return out;
}

/// The message behind the file's folder, which differs from run to run.
std::string complaint(const std::string& text) {
  const std::string message = error_of([&] { read(text); });
  const std::size_t at = message.find("a.yaml");
  return at == std::string::npos ? message : message.substr(at);
}

TEST(YamlBinding, ReadsEveryTypeOfField) {
  const Everything out = read(R"(flag: true
number: -3
wide: -9007199254740993
seed: 18446744073709551615
value: 2.5e-3
name: calib/gauge/*.png
fruit: pear
maybe: +4
list: [1, 2.5]
pair: [11, 8]
point: [1, 2]
up: [0.0, -1.0, 0.5]
inner: {sigma: 3}
inners:
  - sigma: 1
    count: 5
  - {}
frames:
  zeta: z/*.png
  alpha: a/*.png
)");
  EXPECT_TRUE(out.flag);
  EXPECT_EQ(out.number, -3);
  EXPECT_EQ(out.wide, -9007199254740993);
  EXPECT_EQ(out.seed, 18446744073709551615U);
  EXPECT_EQ(out.value, 2.5e-3);
  EXPECT_EQ(out.name, "calib/gauge/*.png");
  EXPECT_EQ(out.fruit, Fruit::kPear);
  EXPECT_EQ(out.maybe, 4.0);
  EXPECT_THAT(out.list, ElementsAre(1, 2.5));
  EXPECT_THAT(out.pair, ElementsAre(11, 8));
  EXPECT_EQ(out.point, Eigen::Vector2d(1, 2));
  EXPECT_EQ(out.up, Eigen::Vector3d(0, -1, 0.5));
  EXPECT_EQ(out.inner.sigma, 3);
  ASSERT_EQ(out.inners.size(), 2U);
  EXPECT_EQ(out.inners[0].count, 5);
  EXPECT_EQ(out.inners[1].sigma, 1.5);
  EXPECT_THAT(out.frames, ElementsAre(Pair("zeta", "z/*.png"), Pair("alpha", "a/*.png")));
}

TEST(YamlBinding, LeavesWhatIsNotGiven) {
  const Everything out = read("name: y\ninner:\nmaybe: null\n");
  EXPECT_EQ(out.name, "y");
  EXPECT_EQ(out.number, 7);
  EXPECT_EQ(out.inner.sigma, 1.5);
  EXPECT_EQ(out.maybe, std::nullopt);
}

TEST(YamlBinding, TakesWindowsLinesAndAByteOrderMark) {
  const Everything out = read("\xef\xbb\xbfname: a b\r\ninner:\r\n  sigma: 3 # px\r\nlist:\r\n  - 1\r\n");
  EXPECT_EQ(out.name, "a b");
  EXPECT_EQ(out.inner.sigma, 3);
  EXPECT_THAT(out.list, ElementsAre(1));
}

TEST(YamlBinding, NamesFileKeyAndLineOfAnUnknownKeyAndTheNearestOne) {
  EXPECT_EQ(complaint("flag: true\ninner:\n  sgma: 3\n"),
            "a.yaml: inner.sgma (line 3): unknown key; did you mean 'sigma'? allowed: sigma, count");
  EXPECT_EQ(complaint("inners: [{sigma: 1}, {weight: 3}]\n"),
            "a.yaml: inners[1].weight (line 1): unknown key; allowed: sigma, count");
}

TEST(YamlBinding, RefusesARepeatedKey) {
  EXPECT_EQ(complaint("number: 1\nname: a\nnumber: 2\n"),
            "a.yaml: number (line 3): given twice, first in line 1; keep one of the two");
  EXPECT_THAT(complaint("part: {a: {b: 1, b: 2}}\n"), HasSubstr("part.a.b (line 1): given twice"));
}

TEST(YamlBinding, RefusesAWrongType) {
  EXPECT_EQ(complaint("number: 1.5\n"), "a.yaml: number (line 1): is '1.5'; give a whole number");
  EXPECT_THAT(complaint("number: 3000000000\n"), HasSubstr("give a whole number of at most 9 digits"));
  EXPECT_THAT(complaint("seed: -1\n"), HasSubstr("not negative"));
  EXPECT_EQ(complaint("value: fast\n"), "a.yaml: value (line 1): is 'fast'; give a finite number");
  EXPECT_THAT(complaint("value: \"3\"\n"), HasSubstr("is '3' (quoted text); give a finite number"));
  EXPECT_THAT(complaint("value: [1]\n"), HasSubstr("is a list of 1; give a finite number"));
  EXPECT_THAT(complaint("value:\n"), HasSubstr("is empty; give a finite number"));
  EXPECT_THAT(complaint("value: 1,5\n"), HasSubstr("is '1,5'"));
  EXPECT_THAT(complaint("flag: yes\n"), HasSubstr("is 'yes'; give true or false"));
  EXPECT_THAT(complaint("name: {a: 1}\n"), HasSubstr("is a map of keys; give a text"));
  EXPECT_THAT(complaint("inner: 3\n"), HasSubstr("give a map of keys and values"));
  EXPECT_THAT(complaint("frames: [a]\n"), HasSubstr("give a map of keys and values"));
  EXPECT_THAT(complaint("- 1\n- 2\n"), HasSubstr("a.yaml (line 1): is a list of 2"));
}

TEST(YamlBinding, RefusesNumbersThatAreNotFinite) {
  for (const char* text : {".nan", "nan", ".inf", "-.inf", "inf", "1e999", "-1e999"})
    EXPECT_THAT(complaint(std::string("value: ") + text), HasSubstr("give a finite number")) << text;
  EXPECT_THAT(complaint("list: [1, .nan]\n"), HasSubstr("list[1] (line 1)"));
}

TEST(YamlBinding, RefusesAListOfAnotherLength) {
  EXPECT_EQ(complaint("pair: [1, 2, 3]\n"), "a.yaml: pair (line 1): is a list of 3; give a list of 2");
  EXPECT_THAT(complaint("up: [1, 2]\n"), HasSubstr("give a list of 3"));
  EXPECT_THAT(complaint("list: 3\n"), HasSubstr("give a list [a, b, ...]"));
}

TEST(YamlBinding, ListsTheChoicesOfAnEnum) {
  EXPECT_EQ(complaint("fruit: cherry\n"), "a.yaml: fruit (line 1): is 'cherry'; allowed: apple, pear");
  EXPECT_EQ(complaint("fruit: paer\n"),
            "a.yaml: fruit (line 1): is 'paer'; did you mean 'pear'? allowed: apple, pear");
}

TEST(YamlBinding, ExplainsAFileThatIsNoYaml) {
  EXPECT_THAT(complaint(""), HasSubstr("is empty"));
  EXPECT_THAT(complaint("# only a comment\n"), HasSubstr("is empty"));
  EXPECT_THAT(complaint("a: [1, 2\nb: 3\n"), HasSubstr("is not valid YAML"));
  EXPECT_THAT(complaint("a: b: c\n"), HasSubstr("a.yaml (line 1): is not valid YAML"));
  EXPECT_THAT(complaint("just words\n"),
              HasSubstr("a.yaml (line 1): is 'just words'; give a map of keys and values"));
  EXPECT_THAT(complaint(std::string("a: \0b", 5)), HasSubstr("is not a text file"));
  EXPECT_THAT(complaint("name: a\n---\nname: b\n"), HasSubstr("more than one YAML document"));
  EXPECT_THAT(complaint("name: !!python/object:os.system x\n"), HasSubstr("tags"));
  EXPECT_THAT(error_of([] {
                Everything out;
                read_yaml("/no/such/file.yaml", out);
              }),
              HasSubstr("/no/such/file.yaml: cannot be read"));
}

TEST(YamlBinding, TellsThatAPatternWithAStarInFrontNeedsQuotes) {
  EXPECT_THAT(complaint("flag: true\nname: *.png\n"), HasSubstr("(line 2)"));
  EXPECT_THAT(complaint("name: *.png\n"), HasSubstr("put a text that begins with * in quotes"));
}

TEST(YamlBinding, RefusesAliasBombs) {
  EXPECT_THAT(complaint("a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n"), HasSubstr("alias"));
}

TEST(YamlBinding, RefusesDeepNestingWithoutACrash) {
  const std::string deep(100'000, '[');
  EXPECT_THAT(complaint("list: " + deep), HasSubstr("a.yaml (line 1)"));
  EXPECT_THAT(complaint("list: " + deep + std::string(100'000, ']')), HasSubstr("nested deeper"));
  std::string blocks;
  for (std::size_t i = 0; i < 500; ++i) blocks += std::string(i, ' ') + "a:\n";
  EXPECT_THAT(complaint(blocks), HasSubstr("nested deeper"));
  std::string dashes;
  for (int i = 0; i < 100'000; ++i) dashes += "- ";
  EXPECT_THAT(complaint(dashes), HasSubstr("nested deeper"));
}

TEST(YamlBinding, RefusesAFileBeyondTheLimit) {
  EXPECT_THAT(complaint("# " + std::string((16 << 20) + 1, 'x')),
              HasSubstr("larger than the limit of 16777216 bytes"));
}

Everything unusual_values() {
  Everything out;
  out.flag = true;
  out.wide = std::numeric_limits<std::int64_t>::min();
  out.seed = std::numeric_limits<std::uint64_t>::max();
  out.value = 0.1 + 0.2;
  out.name = "*.png # no \"comment\": {really}\n\ttrue \\ \x01 äöü";
  out.fruit = Fruit::kPear;
  out.maybe = std::numeric_limits<double>::denorm_min();
  out.list = {1e300, -1.0 / 3.0, 5e-324, -0.0, 123456789012345680.0};
  out.inners = {Inner{2.5, 3}, Inner{}};
  out.frames = {{"two words", "007"}, {"null", "true"}, {"b", "~"},   {"c", ""},
                {"d", "- x"},         {"-", "1e3"},     {"f", "a: b"}};
  out.part.text = "thresholds: 10,20\nlist: [a, 'b c', \"3\"]\n";
  return out;
}

TEST(YamlBinding, DumpReadsBackToTheSameBits) {
  const Everything before = unusual_values();
  const std::string text = dump_yaml(before);
  const Everything after = read(text);
  EXPECT_EQ(dump_yaml(after), text);
  EXPECT_EQ(after.value, before.value);
  EXPECT_EQ(after.name, before.name);
  EXPECT_EQ(after.list, before.list);
  EXPECT_TRUE(std::signbit(after.list[3]));
  EXPECT_EQ(after.maybe, before.maybe);
  EXPECT_EQ(after.frames, before.frames);
  EXPECT_EQ(after.wide, before.wide);
  EXPECT_EQ(after.seed, before.seed);
}

TEST(YamlBinding, DumpQuotesTextsThatOtherToolsWouldTakeForNumbersOrWords) {
  for (const char* name : {"007", "1e3", "true", "No", "null", "", " x", "*.png"}) {
    Everything out;
    out.name = name;
    EXPECT_THAT(dump_yaml(out), HasSubstr("name: \"" + out.name + "\"\n"));
  }
}

TEST(YamlBinding, DumpWithCommentsExplainsAndReadsBack) {
  Inner inner;
  const std::string text = dump_yaml(inner, true);
  EXPECT_EQ(text, "sigma: 1.5  # px\n# count:  # default: all\n");
  EXPECT_EQ(dump_yaml(inner), "sigma: 1.5\n");
  const TempFolder folder;
  read_yaml(folder.write("a.yaml", text), inner);
  EXPECT_EQ(inner.count, std::nullopt);
}

TEST(YamlBinding, LongPartsBecomeBlocks) {
  std::vector<Inner> inners(6, Inner{0.123456789, 1000});
  Everything all;
  all.inners = inners;
  const Everything back = read(dump_yaml(all));
  EXPECT_THAT(dump_yaml(all), HasSubstr("inners:\n  - {sigma: 0.123456789, count: 1000}\n"));
  ASSERT_EQ(back.inners.size(), 6U);
  EXPECT_EQ(back.inners[5].count, 1000);
}

TEST(YamlSubtree, IsBoundLaterWithTheLinesOfItsFile) {
  const Everything out = read("flag: true\npart:\n  sigma: 3\n\n  # a comment\n  cuont: 4\n");
  Inner inner;
  const std::string message = error_of([&] { read_subtree(out.part, inner); });
  EXPECT_THAT(message, HasSubstr("a.yaml: part.cuont (line 6): unknown key; did you mean 'count'?"));
  const Everything good = read("part: {sigma: 3,\n count: 4}\n");
  read_subtree(good.part, inner);
  EXPECT_EQ(inner.sigma, 3);
  EXPECT_EQ(inner.count, 4);
}

TEST(YamlSubtree, EmptyChangesNothing) {
  Inner inner;
  read_subtree(YamlSubtree{}, inner);
  read_subtree(read("part:\n").part, inner);
  EXPECT_EQ(inner.sigma, 1.5);
}

TEST(YamlSubtree, KeepsTheTypeOfItsTexts) {
  struct Out {
    YamlSubtree part;
  };
  const Everything out = read("part: {thresholds: 'a, b', n: 12, t: \"12\", list: [x y, -1]}\n");
  const detail::YamlNode node = detail::parse_yaml(out.part.text, {});
  ASSERT_EQ(node.items.size(), 4U);
  EXPECT_EQ(node.items[0].text, "a, b");
  EXPECT_FALSE(node.items[1].quoted);
  EXPECT_TRUE(node.items[2].quoted);
  EXPECT_EQ(node.items[3].items[0].text, "x y");
}

TEST(SetField, OverridesOneFieldByItsDottedName) {
  Everything out;
  set_field(out, "inner.sigma", "3");
  set_field(out, "fruit", "pear");
  set_field(out, "pair", "[4, 5]");
  set_field(out, "name", "a: b # c");
  set_field(out, "maybe", "2");
  EXPECT_EQ(out.inner.sigma, 3);
  EXPECT_EQ(out.fruit, Fruit::kPear);
  EXPECT_THAT(out.pair, ElementsAre(4, 5));
  EXPECT_EQ(out.name, "a: b # c");
  EXPECT_EQ(out.maybe, 2.0);
}

TEST(SetField, ExplainsWhatIsWrong) {
  Everything out;
  EXPECT_EQ(error_of([&] { set_field(out, "inner.sgma", "3", "--option"); }),
            "--option.inner.sgma: unknown key; did you mean 'sigma'? allowed: sigma, count");
  EXPECT_EQ(error_of([&] { set_field(out, "inner.sigma", "x", "--option"); }),
            "--option.inner.sigma: is 'x'; give a finite number");
  EXPECT_THAT(error_of([&] { set_field(out, "number.part", "3"); }), HasSubstr("number.part: unknown key"));
  EXPECT_THAT(error_of([&] { set_field(out, "value", "nan"); }), HasSubstr("give a finite number"));
  EXPECT_THAT(error_of([&] { set_field(out, "inner", "3"); }), HasSubstr("inner"));
  EXPECT_THAT(error_of([&] { set_field(out, "", "3"); }), HasSubstr("unknown key"));
}

TEST(ListFields, NamesTheLeavesWithValuesAndComments) {
  Everything out;
  const auto fields = list_fields(out);
  const auto sigma =
      std::find_if(fields.begin(), fields.end(), [](const FieldText& f) { return f.key == "inner.sigma"; });
  ASSERT_NE(sigma, fields.end());
  EXPECT_EQ(sigma->value, "1.5");
  EXPECT_EQ(sigma->comment, "px");
}

struct GermanNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(YamlBinding, IgnoresTheLocale) {
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new GermanNumbers));
  const Everything out = read("value: 2.5\nnumber: 1234567\n");
  const std::string text = dump_yaml(Inner{1234567.5, 12345});
  const std::string message = complaint(std::string(1500, '\n') + "number: x\n");
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(out.value, 2.5);
  EXPECT_EQ(out.number, 1234567);
  EXPECT_EQ(text, "sigma: 1234567.5\ncount: 12345\n");
  EXPECT_THAT(message, HasSubstr("(line 1501)"));
}

}  // namespace
}  // namespace lightstripe

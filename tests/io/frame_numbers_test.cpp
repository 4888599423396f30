// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/frame_numbers.h"

#include <gmock/gmock.h>

#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A recording that consists of names only.
class Named : public FrameSource {
 public:
  explicit Named(std::vector<std::string> names)
      : names_(std::move(names)), numbers_(numbers_in_names(names_)) {}
  std::int64_t size() const override { return static_cast<std::int64_t>(names_.size()); }
  std::string name(std::int64_t index) const override { return names_[static_cast<std::size_t>(index)]; }
  GreyImage read(std::int64_t) const override { return Image8(); }
  std::optional<std::int64_t> number(std::int64_t index) const override {
    if (numbers_.empty()) return std::nullopt;
    return numbers_[static_cast<std::size_t>(index)];
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::int64_t> numbers_;
};

Named numbered(const std::vector<int>& numbers) {
  std::vector<std::string> names;
  for (const int n : numbers) names.push_back("img_" + std::to_string(n) + ".png");
  return Named(names);
}

FrameMap map_of(const std::vector<const FrameSource*>& sources,
                const std::vector<std::int64_t>& positions = {}) {
  return map_frames(sources, positions, "scan.yaml: frames");
}

TEST(NumbersInNames, AreTheLastDigitsWhereAllElseIsEqual) {
  EXPECT_THAT(numbers_in_names({"cam2_007.png", "cam2_010.png"}), ElementsAre(7, 10));
  EXPECT_THAT(numbers_in_names({"3.jpg", "12.png"}), ElementsAre(3, 12));
  EXPECT_THAT(numbers_in_names({"a_1.png", "b_2.png"}), IsEmpty());
  EXPECT_THAT(numbers_in_names({"a.png", "b.png"}), IsEmpty());
  EXPECT_THAT(numbers_in_names({"99999999999999999999.png"}), IsEmpty());  // beyond 64 bits
}

TEST(MapFrames, ConsecutiveNumbersCountFromTheFirstPicture) {
  const Named source = numbered({1, 2, 3});
  const FrameMap map = map_of({&source});
  EXPECT_EQ(map.first, 0);
  EXPECT_EQ(map.end, 3);
  EXPECT_THAT(map.index[0], ElementsAre(0, 1, 2));
}

TEST(MapFrames, AGapIsAMissingFrameAndTheOthersKeepTheirPlace) {
  const Named gauge = numbered({0, 1, 3, 4}), field = numbered({0, 1, 2, 3});
  const FrameMap map = map_of({&gauge, &field});
  EXPECT_THAT(map.index[0], ElementsAre(0, 1, -1, 2, 3));
  EXPECT_THAT(map.index[1], ElementsAre(0, 1, 2, 3, -1));
}

TEST(MapFrames, ACommonStepIsNoGap) {
  const Named source = numbered({10, 20, 30, 50});
  EXPECT_THAT(map_of({&source}).index[0], ElementsAre(0, 1, 2, -1, 3));
}

TEST(MapFrames, TheTravelTableTellsWhetherTheFirstPictureIsMissing) {
  const Named source = numbered({1, 2, 3});
  const FrameMap first_lost = map_of({&source}, {0, 1, 2, 3});
  EXPECT_EQ(first_lost.first, 1);
  EXPECT_EQ(first_lost.end, 4);
  const FrameMap counted_from_one = map_of({&source}, {0, 1, 2});
  EXPECT_EQ(counted_from_one.first, 0);
  EXPECT_EQ(counted_from_one.end, 3);
}

TEST(MapFrames, SparseNumbersLeaveTheOrderOnly) {
  const Named source = numbered({1000, 1007, 1301, 5001});
  EXPECT_THAT(map_of({&source}).index[0], ElementsAre(0, 1, 2, 3));
}

TEST(MapFrames, OfTwoPicturesWithOneNumberTheFirstCounts) {
  const Named source({"img_1.png", "img_01.png", "img_2.png"});
  const FrameMap map = map_of({&source});
  EXPECT_THAT(map.index[0], ElementsAre(0, 2));
  EXPECT_THAT(map.duplicate_pictures, ElementsAre("img_01.png"));
}

TEST(MapFrames, WithoutNumbersTheSensorsNeedTheSameLength) {
  const Named gauge({"a.png", "b.png"}), field({"c.png"});
  EXPECT_THAT(error_of([&] {
                map_of({&gauge, &field});
              }),
              HasSubstr("scan.yaml: frames: one sensor has 2 frames, another 1"));
}

TEST(MapFrames, ASensorThatIsNotInTheScanHasNoPictures) {
  const Named source = numbered({0, 1});
  const FrameMap map = map_of({nullptr, &source});
  EXPECT_THAT(map.index[0], ElementsAre(-1, -1));
  EXPECT_THAT(map.index[1], ElementsAre(0, 1));
}

TEST(NumbersInNames, MayHaveASign) {
  EXPECT_THAT(numbers_in_names({"x_-10.png", "x_-5.png", "x_3.png"}), ElementsAre(-10, -5, 3));
  EXPECT_THAT(numbers_in_names({"img-5.png", "img-6.png"}), ElementsAre(5, 6)) << "a hyphen is no sign";
  const Named source({"x_-2.png", "x_-1.png", "x_0.png", "x_1.png"});
  EXPECT_THAT(map_of({&source}).index[0], ElementsAre(0, 1, 2, 3));
}

TEST(MapFrames, CountersThatStartApartArePairedByOrderWhereNoneHasAGap) {
  const Named gauge = numbered({0, 1, 2, 3, 4, 5, 6, 7}), field = numbered({3, 4, 5, 6, 7, 8, 9, 10}),
              gap = numbered({3, 4, 5, 6, 8, 9, 10, 11}),
              far = numbered({900, 901, 902, 903, 905, 906, 907, 908});
  for (const std::vector<std::int64_t>& table : {std::vector<std::int64_t>{}, {0, 1, 2, 3, 4, 5, 6, 7}}) {
    const FrameMap map = map_of({&gauge, &field}, table);
    EXPECT_TRUE(map.paired_by_order);
    EXPECT_EQ(map.end, 8);
    EXPECT_THAT(map.index[1], ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  }
  EXPECT_FALSE(map_of({&gauge, &gap}).paired_by_order);
  EXPECT_EQ(map_of({&gauge, &gap}).end, 12);
  EXPECT_TRUE(map_of({&gauge, &far}).paired_by_order) << "no common numbers: the order is all there is";
  const FrameMap as_numbered = map_of({&gauge, &field}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  EXPECT_FALSE(as_numbered.paired_by_order) << "the table knows all numbers";
  EXPECT_EQ(as_numbered.end, 11);
}

TEST(MapFrames, TimeStampsAreLookedUpInTheTable) {
  std::vector<std::string> names;
  std::vector<std::int64_t> table;
  for (const std::int64_t frame : {0, 1, 2, 3, 4}) {
    table.push_back(1'700'000'000'123'456'789 + frame * 33'333'334 - frame % 2);
    names.push_back(std::to_string(table.back()) + ".png");
  }
  const Named source(names);
  const FrameMap map = map_of({&source}, table);
  EXPECT_EQ(map.first, 0);
  EXPECT_EQ(map.end, 5);
  EXPECT_EQ(map.stamps, table);
  EXPECT_TRUE(map_of({&source}, {0, 1, 2, 3, 4}).stamps.empty()) << "the table counts frames";
}

TEST(MapFrames, PicturesOfOneStampAreOneFrameAlsoWhereSomeAreMissing) {
  const std::vector<std::int64_t> table = {1'700'000'000'000'000'000, 1'700'000'000'041'000'000,
                                           1'700'000'000'080'000'000, 1'700'000'000'120'000'000};
  const auto png = [&](std::size_t i) { return std::to_string(table[i]) + ".png"; };
  const Named gauge({png(0), png(1), png(3)}), field({png(0), png(1), png(2), png(3)});
  const FrameMap map = map_of({&gauge, &field}, table);
  EXPECT_EQ(map.stamps, table);
  EXPECT_FALSE(map.paired_by_order);
  EXPECT_THAT(map.index[0], ElementsAre(0, 1, -1, 2));
  EXPECT_THAT(map.index[1], ElementsAre(0, 1, 2, 3));
  // Clocks that do not agree leave the order.
  const Named later({"1700000000000000007.png", "1700000000041000007.png", "1700000000080000009.png",
                     "1700000000119000000.png"});
  const FrameMap apart = map_of({&field, &later}, table);
  EXPECT_EQ(apart.end, 4);
  EXPECT_TRUE(apart.paired_by_order);
}

TEST(MapFrames, EvenStampsOfAnExactClockAreLookedUpAsWell) {
  const Named source({"1700000000000000000.png", "1700000000040000000.png", "1700000000080000000.png"});
  const std::vector<std::int64_t> table = {1'700'000'000'000'000'000, 1'700'000'000'040'000'000,
                                           1'700'000'000'080'000'000};
  EXPECT_EQ(map_of({&source}, table).stamps, table);
  EXPECT_EQ(map_of({&source}, {0, 1, 2}).end, 3);
}

}  // namespace
}  // namespace lightstripe

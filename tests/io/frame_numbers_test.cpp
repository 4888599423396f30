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

}  // namespace
}  // namespace lightstripe

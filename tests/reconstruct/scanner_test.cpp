// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/scanner.h"

#include "extraction/track/track_stripes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <thread>

#include "core/error.h"
#include "numbered_scan.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;
using testing::kFrames;
using testing::numbered_image;
using testing::numbered_input;
using testing::scan;
using testing::stripes_of_numbered_image;
using testing::two_sensor_rig;

TEST(ScanProfiles, FramesComeInOrderWithSensorsInTheRigsOrder) {
  ScanSummary summary;
  const auto profiles = scan(numbered_input(), 4, &summary);
  ASSERT_EQ(profiles.size(), kFrames);
  for (std::size_t f = 0; f < kFrames; ++f) {
    EXPECT_EQ(profiles[f].frame, static_cast<std::int64_t>(f));
    EXPECT_EQ(profiles[f].travel, 2.0 * static_cast<double>(f));
    ASSERT_EQ(profiles[f].points.size(), 10u);
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_EQ(profiles[f].points[i].sensor, i < 5 ? 0 : 1);
      EXPECT_EQ(profiles[f].points[i].intensity, static_cast<float>(f));
    }
  }
  EXPECT_EQ(summary.frames, kFrames);
  EXPECT_EQ(summary.points, 10 * kFrames);
  EXPECT_EQ(summary.frames_without_points, 0);
  EXPECT_FALSE(summary.stopped);
}

TEST(ScanProfiles, BitsDoNotDependOnTheNumberOfThreads) {
  const auto expected = scan(numbered_input(), 1);
  for (int threads : {2, 3, 4, 0}) {
    const auto found = scan(numbered_input(), threads);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t f = 0; f < found.size(); ++f) {
      ASSERT_EQ(found[f].points.size(), expected[f].points.size());
      for (std::size_t i = 0; i < found[f].points.size(); ++i) {
        const ProfilePoint &a = found[f].points[i], &b = expected[f].points[i];
        for (int k = 0; k < 3; ++k)
          EXPECT_EQ(std::bit_cast<std::uint64_t>(a.position[k]), std::bit_cast<std::uint64_t>(b.position[k]));
        EXPECT_EQ(std::bit_cast<std::uint64_t>(a.sigma_mm), std::bit_cast<std::uint64_t>(b.sigma_mm));
      }
    }
  }
}

TEST(ScanProfiles, FramesWithoutPositionAreLeftOutAndCounted) {
  ScanInput input = numbered_input();
  input.position = [](std::int64_t frame) -> std::optional<FramePosition> {
    if (frame % 3 == 0) return std::nullopt;
    return FramePosition{};
  };
  ScanSummary summary;
  const auto profiles = scan(input, 3, &summary);
  EXPECT_EQ(summary.without_position.count, kFrames / 3);
  ASSERT_EQ(summary.frames, kFrames - kFrames / 3);
  EXPECT_EQ(profiles[0].frame, 1);
  EXPECT_EQ(profiles[1].frame, 2);
  EXPECT_EQ(profiles[2].frame, 4);
}

TEST(ScanProfiles, MissingPicturesGiveShorterOrEmptyProfiles) {
  ScanInput input = numbered_input();
  input.read = [](std::int64_t frame, int sensor) -> std::optional<GreyImage> {
    if (frame == 7 || (frame == 9 && sensor == 0)) return std::nullopt;
    return numbered_image(frame, sensor);
  };
  ScanSummary summary;
  const auto profiles = scan(input, 4, &summary);
  ASSERT_EQ(profiles.size(), kFrames);
  EXPECT_TRUE(profiles[7].points.empty());
  ASSERT_EQ(profiles[9].points.size(), 5u);
  EXPECT_EQ(profiles[9].points[0].sensor, 1);
  EXPECT_EQ(summary.frames_without_points, 1);
}

TEST(ScanProfiles, PicturesThatCannotBeUsedAreSkippedAndNamed) {
  ScanInput input = numbered_input();
  input.read = [](std::int64_t frame, int sensor) {
    if (frame == 7) throw Error("7.png", "ends before its picture does", "record it again");
    return frame == 12 && sensor == 1 ? Image8(31, 24, 0) : numbered_image(frame, sensor);
  };
  std::vector<ScannedFrame> frames;
  const auto summary = scan_profiles(input, two_sensor_rig(), StripeExtractor(stripes_of_numbered_image), 3,
                                     [&](const ScannedFrame& frame) { frames.push_back(frame); });
  ASSERT_EQ(frames.size(), kFrames);
  ASSERT_EQ(frames[7].skipped.size(), 2u);
  EXPECT_EQ(frames[7].pictures, 0);
  EXPECT_EQ(frames[7].skipped[1].sensor, 1);
  EXPECT_THAT(frames[7].skipped[1].reason, HasSubstr("7.png: ends before"));
  ASSERT_EQ(frames[12].skipped.size(), 1u);
  EXPECT_EQ(frames[12].profile.points.size(), 5u);
  EXPECT_THAT(frames[12].skipped[0].reason, HasSubstr("field, frame 12: the picture has 31 x 24 px"));
  EXPECT_EQ(summary.pictures_skipped, 3);
  EXPECT_EQ(summary.pictures, 2 * kFrames - 3);
}

TEST(ScanProfiles, OtherExceptionsOfAReaderEndTheRunAlsoWhereErrorsAreSkipped) {
  for (const int threads : {1, 4}) {
    ScanInput input = numbered_input();
    input.read = [](std::int64_t frame, int sensor) {
      if (frame == 20) throw 42;  // not even a std::exception
      return numbered_image(frame, sensor);
    };
    EXPECT_THROW(scan(input, threads), int);
    input = numbered_input();
    input.encode = [](ScannedFrame& frame) {
      if (frame.profile.frame == 20) throw std::length_error("encode");
    };
    EXPECT_THROW(scan(input, threads), std::length_error);
  }
}

TEST(ScanProfiles, ARangeOfFramesGivesTheSameProfilesAsTheWholeScan) {
  const auto whole = scan(numbered_input(), 4);
  ScanInput input = numbered_input();
  input.first_frame = 30;
  input.end_frame = 50;
  const auto part = scan(input, 4);
  ASSERT_EQ(part.size(), 20u);
  for (std::size_t f = 0; f < part.size(); ++f) {
    EXPECT_EQ(part[f].frame, whole[30 + f].frame);
    EXPECT_EQ(part[f].travel, whole[30 + f].travel);
    EXPECT_EQ(part[f].points[3].position, whole[30 + f].points[3].position);
  }
}

TEST(ScanProfiles, FramesThatWereNeverRecordedArePassedOverSilently) {
  ScanInput input = numbered_input();
  input.recorded = [](std::int64_t frame) { return frame % 10 == 0; };
  ScanSummary summary;
  EXPECT_EQ(scan(input, 2, &summary).size(), kFrames / 10);
  EXPECT_TRUE(summary.without_position.empty());
}

TEST(ScanProfiles, InterpolatedFramesAreNamed) {
  ScanInput input = numbered_input();
  input.position = [](std::int64_t frame) {
    return FramePosition{1.0, std::nullopt, frame == 3 || frame == 4 || frame == 9};
  };
  ScanSummary summary;
  scan(input, 3, &summary);
  EXPECT_EQ(summary.interpolated.text(), "3 to 4, 9");
}

TEST(ScanProfiles, AnEmptyScanHandsOnNothing) {
  ScanInput input = numbered_input();
  input.end_frame = 0;
  ScanSummary summary;
  EXPECT_TRUE(scan(input, 4, &summary).empty());
  EXPECT_EQ(summary.frames, 0);
}

TEST(ScanProfiles, StrictPictureOfAnotherSizeIsAnErrorThatNamesTheFrame) {
  ScanInput input = numbered_input();
  input.strict = true;
  input.read = [](std::int64_t frame, int sensor) {
    return frame == 12 && sensor == 1 ? Image8(31, 24, 0) : numbered_image(frame, sensor);
  };
  try {
    scan(input, 4);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("field, frame 12"));
    EXPECT_THAT(error.what(), HasSubstr("31 x 24"));
    EXPECT_THAT(error.what(), HasSubstr("32 x 24"));
  }
}

// A level stripe with a Gaussian section of 2 px, its centre at this row.
Image8 picture_of_level_stripe(double row) {
  Image8 image(240, 120, 0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image(x, y) =
          static_cast<std::uint8_t>(std::lround(10 + 200 * std::exp(-0.125 * (y - row) * (y - row))));
  return image;
}

TEST(ScanProfiles, PicturesOfAStripeBecomeSectionsByTheRealExtraction) {
  // Sheet y = 100 mm and f = 1000 px: a stripe at row 60 + 200 + shift lies at z = 100 * 1000 / (200 +
  // shift).
  Rig rig;
  rig.sensors.push_back(
      {"gauge", {240, 120, 1000, 1000, 120, -140, {}}, {{Eigen::Vector3d::UnitY(), 100}}, {}});
  ScanInput input;
  input.end_frame = 8;
  input.read = [](std::int64_t frame, int) -> std::optional<GreyImage> {
    return picture_of_level_stripe(60 + 0.37 * static_cast<double>(frame));
  };
  input.position = [](std::int64_t) { return FramePosition{}; };
  ExtractionOptions options;
  options.stripe_width = 2 * std::sqrt(3.0) * 2;
  std::int64_t frames = 0;
  scan_profiles(input, rig, options, 2, [&](const ScannedFrame& frame) {
    const Profile& profile = frame.profile;
    const double z = 100 * 1000 / (200 + 0.37 * static_cast<double>(profile.frame));
    EXPECT_GT(profile.points.size(), 200u);
    // 0.02 px (rounding to 8 bits, no noise) are 0.02 * z^2 / 1e5 = 0.05 mm.
    for (const auto& p : profile.points) EXPECT_NEAR(p.v, z, 0.05);
    ++frames;
  });
  EXPECT_EQ(frames, 8);
}

TEST(ScanProfiles, ATrackedScanHasTheSameBitsForAnyThreadsAndInParts) {
  Rig rig;
  rig.sensors.push_back(
      {"gauge", {240, 120, 1000, 1000, 120, -140, {}}, {{Eigen::Vector3d::UnitY(), 100}}, {}});
  ScanInput input;
  input.end_frame = 2 * kTrackedFrames + 5;
  std::atomic<int> reads = 0;
  input.read = [&](std::int64_t frame, int) -> std::optional<GreyImage> {
    ++reads;
    if (frame == kTrackedFrames) throw Error("picture", "is damaged", "record it again");
    return picture_of_level_stripe(50 + 0.07 * static_cast<double>(frame));
  };
  input.position = [](std::int64_t) { return FramePosition{}; };
  ExtractionOptions options;
  options.track = true;
  const auto run = [&](std::int64_t first, std::int64_t end, int threads) {
    input.first_frame = first;
    input.end_frame = end;
    std::vector<double> values;
    const auto summary = scan_profiles(input, rig, options, threads, [&](const ScannedFrame& frame) {
      for (const auto& p : frame.profile.points) {
        values.push_back(p.v);
        values.push_back(p.sigma_mm);
      }
    });
    EXPECT_EQ(summary.pictures_skipped, first <= kTrackedFrames && kTrackedFrames < end ? 1 : 0);
    return values;
  };
  const std::int64_t end = input.end_frame;
  const auto whole = run(0, end, 1);
  EXPECT_EQ(reads, end);  // each picture once, key frames too
  EXPECT_GT(whole.size(), 2U * 200U * static_cast<std::size_t>(end - 1));
  for (const int threads : {2, 5}) EXPECT_EQ(run(0, end, threads), whole);
  auto parts = run(0, 20, 2);
  for (const auto& [from, to] : {std::pair<std::int64_t, std::int64_t>{20, 50}, {50, end}}) {
    const auto part = run(from, to, 2);
    parts.insert(parts.end(), part.begin(), part.end());
  }
  EXPECT_EQ(parts, whole);
}

TEST(ScanProfiles, NegativeThreadsAreTheCallersFault) {
  EXPECT_THROW(scan(numbered_input(), -1), std::logic_error);
}

}  // namespace
}  // namespace lightstripe

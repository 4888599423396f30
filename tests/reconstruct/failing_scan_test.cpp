// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the scanner does when a callback fails, is slow, or asks for an end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>
#include <stop_token>
#include <thread>

#include "core/error.h"
#include "numbered_scan.h"
#include "reconstruct/scanner.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;
using testing::numbered_image;
using testing::numbered_input;
using testing::scan;
using testing::stripes_of_numbered_image;
using testing::two_sensor_rig;

TEST(ScanProfiles, ExceptionsOfEveryCallbackComeOut) {
  for (int threads : {1, 4}) {
    ScanInput bad_read = numbered_input(), bad_position = numbered_input();
    bad_read.strict = true;
    bad_read.read = [](std::int64_t frame, int sensor) {
      if (frame == 20) throw Error("frame 20", "cannot be read", "look at it");
      return numbered_image(frame, sensor);
    };
    EXPECT_THROW(scan(bad_read, threads), Error);
    bad_position.position = [](std::int64_t frame) -> std::optional<FramePosition> {
      if (frame == 20) throw std::out_of_range("position");
      return FramePosition{};
    };
    EXPECT_THROW(scan(bad_position, threads), std::out_of_range);
    const auto bad_extractor = [](const GreyImage&) -> std::vector<Stripe> { throw std::bad_alloc(); };
    EXPECT_THROW(
        scan_profiles(numbered_input(), two_sensor_rig(), bad_extractor, threads, [](const ScannedFrame&) {}),
        std::bad_alloc);
    std::int64_t last = -1;
    const auto bad_sink = [&](const ScannedFrame& frame) {
      last = frame.profile.frame;
      if (last == 20) throw Error("cloud.ply", "disk full", "make room");
    };
    EXPECT_THROW(scan_profiles(numbered_input(), two_sensor_rig(), StripeExtractor(stripes_of_numbered_image),
                               threads, bad_sink),
                 Error);
    EXPECT_EQ(last, 20);  // nothing is handed on after the failure
  }
}

TEST(ScanProfiles, OfSeveralFailuresThatOfTheFirstFrameComesOut) {
  ScanInput input = numbered_input();
  input.strict = true;
  input.read = [](std::int64_t frame, int sensor) {
    if (frame == 20) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (frame >= 20) throw Error("frame " + std::to_string(frame), "cannot be read", "look at it");
    return numbered_image(frame, sensor);
  };
  try {
    scan(input, 4);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame 20"));
  }
}

TEST(ScanProfiles, FramesUnderWayAreBoundedWhenTheSinkIsSlow) {
  for (int threads : {1, 2, 4}) {
    std::atomic<std::int64_t> started{0}, most{0};
    std::int64_t handed_on = 0;
    std::atomic<std::int64_t> done{0};
    ScanInput input = numbered_input();
    input.read = [&](std::int64_t frame, int sensor) {
      if (sensor == 0) {
        const std::int64_t alive = ++started - done;
        std::int64_t seen = most;
        while (alive > seen && !most.compare_exchange_weak(seen, alive)) {
        }
      }
      return numbered_image(frame, sensor);
    };
    scan_profiles(input, two_sensor_rig(), StripeExtractor(stripes_of_numbered_image), threads,
                  [&](const ScannedFrame&) {
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                    ++handed_on;
                    done = handed_on;
                  });
    EXPECT_LE(most, 2 * threads);
    EXPECT_GE(most, 1);
  }
}

TEST(ScanProfiles, AStopEndsTheRunAfterTheFramesUnderWay) {
  std::stop_source stop;
  ScanInput input = numbered_input();
  input.stop = stop.get_token();
  std::int64_t frames = 0;
  const auto summary = scan_profiles(input, two_sensor_rig(), StripeExtractor(stripes_of_numbered_image), 2,
                                     [&](const ScannedFrame& frame) {
                                       EXPECT_EQ(frame.profile.frame, frames++);
                                       if (frame.profile.frame == 30) stop.request_stop();
                                     });
  EXPECT_TRUE(summary.stopped);
  EXPECT_EQ(summary.frames, frames);
  EXPECT_GE(frames, 31);
  EXPECT_LE(frames, 31 + 2 * 2);
}

}  // namespace
}  // namespace lightstripe

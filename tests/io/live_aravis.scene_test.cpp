// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A camera of software over the loopback interface: a real GigE Vision stream, also with packets lost on
// purpose.
#include <gtest/gtest.h>

#ifdef LIGHTSTRIPE_ARAVIS
#include <arv.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "io/live_source.h"

namespace lightstripe {
namespace {

constexpr int kWidth = 320, kHeight = 240;

/// Pixel i of picture k: tells which picture it is, and whether all of it is there.
std::uint8_t pixel(std::uint32_t picture, std::size_t i) {
  return static_cast<std::uint8_t>(i < 4 ? picture >> (8 * i) : 31 * i + 7 * picture);
}

void fill(ArvBuffer* buffer, void* counter, guint32, guint32, ArvPixelFormat) {
  std::size_t size = 0;
  auto* data = static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, &size)));
  auto& picture = *static_cast<std::uint32_t*>(counter);
  for (std::size_t i = 0; i < std::size_t{kWidth} * kHeight; ++i) data[i] = pixel(picture, i);
  ++picture;
}

class Loopback : public ::testing::Test {
 protected:
  void begin(const char* serial, double lost_ratio) {
    camera_ = arv_gv_fake_camera_new("lo", serial);
    if (camera_ == nullptr || !arv_gv_fake_camera_is_running(camera_))
      GTEST_SKIP() << "no GigE Vision camera can be served on the loopback interface here";
    g_object_set(camera_, "gvsp-lost-ratio", lost_ratio, nullptr);
    arv_fake_camera_set_fill_pattern(arv_gv_fake_camera_get_fake_camera(camera_), fill, &counter_);
  }
  void TearDown() override {
    if (camera_ != nullptr) g_object_unref(camera_);
  }

  /// The next `count` frames; each whole one has to be one picture from its first to its last pixel.
  std::vector<LiveFrame> frames(const std::string& serial, int count) {
    const auto source = open_live("aravis:" + serial + "?frame_rate=100&region=0,0,320,240&packet_size=8192",
                                  {Channel::kGray, 0});
    std::vector<LiveFrame> found;
    while (static_cast<int>(found.size()) < count) found.push_back(source->next({}).value());
    return found;
  }
  static std::uint32_t picture_of(const LiveFrame& frame) {
    const Image8& image = std::get<Image8>(frame.image);
    std::uint32_t picture = 0;
    std::memcpy(&picture, image.pixels.data(), sizeof(picture));
    std::size_t wrong = image.pixels.size() == std::size_t{kWidth} * kHeight ? 0 : 1;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) wrong += image.pixels[i] != pixel(picture, i);
    EXPECT_EQ(wrong, 0U) << frame.frame;
    return picture;
  }
  /// Frames are counted without gaps, and a frame's number says which picture it is.
  static void check(const std::vector<LiveFrame>& found) {
    std::optional<std::int64_t> first;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const LiveFrame& frame = found[i];
      EXPECT_EQ(frame.frame, static_cast<std::int64_t>(i));
      EXPECT_EQ(frame.status == FrameStatus::kWhole, frame.reason.empty());
      if (frame.status != FrameStatus::kWhole) continue;
      const std::int64_t offset = std::int64_t{picture_of(frame)} - frame.frame;
      if (!first) first = offset;
      EXPECT_EQ(offset, *first) << frame.frame;
    }
  }

  ArvGvFakeCamera* camera_ = nullptr;
  std::uint32_t counter_ = 0;
};

TEST_F(Loopback, EveryFrameArrivesPixelByPixel) {
  begin("LS-TEST-1", 0);
  if (IsSkipped()) return;
  const auto found = frames("LS-TEST-1", 60);
  check(found);
  EXPECT_GT(std::count_if(found.begin(), found.end(),
                          [](const LiveFrame& f) { return f.status == FrameStatus::kWhole; }),
            55);
}

TEST_F(Loopback, WithLostPacketsEveryFrameIsNamedAndTheOthersAreWhole) {
  begin("LS-TEST-2", 0.05);
  if (IsSkipped()) return;
  const auto found = frames("LS-TEST-2", 250);
  check(found);
  const auto whole = std::count_if(found.begin(), found.end(),
                                   [](const LiveFrame& f) { return f.status == FrameStatus::kWhole; });
  EXPECT_GT(whole, 50);
  EXPECT_LT(whole, 220);  // 0.05 of twelve packets a frame, of which the first carries its number
}

}  // namespace
}  // namespace lightstripe

#else

TEST(Loopback, NeedsAravis) { GTEST_SKIP() << "built without Aravis (apt install libaravis-dev)"; }

#endif

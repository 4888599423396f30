// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Webcams and network streams, through OpenCV.
#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <opencv2/videoio.hpp>

#include "core/error.h"
#include "io/grey_channel.h"
#include "io/live_cameras.h"
#include "io/opencv_codecs.h"

namespace lightstripe {
namespace {

class Capture : public LiveSource {
 public:
  Capture(const SourceText& text, const LiveOptions& options) : text_(text), channel_(options.channel) {
    const bool device = text.scheme == "v4l2";
    if (device) refuse_other_options(text, {"width", "height", "frame_rate"});
    try {
      if (!capture_->open(text.place, device ? cv::CAP_V4L2 : cv::CAP_FFMPEG)) refuse();
    } catch (const cv::Exception&) {
      refuse();
    }
    set(cv::CAP_PROP_FRAME_WIDTH, "width");
    set(cv::CAP_PROP_FRAME_HEIGHT, "height");
    set(cv::CAP_PROP_FPS, "frame_rate");
    const double rate = capture_->get(cv::CAP_PROP_FPS);
    if (rate > 0 && rate < 100000) rate_ = rate;
    counts_by_time_ = device && rate_.has_value();
  }

  std::optional<LiveFrame> next(const std::stop_token& stop) override {
    if (waiting_.empty() && !grab(stop)) return std::nullopt;
    LiveFrame frame = std::move(waiting_.front());
    waiting_.pop_front();
    return frame;
  }

  CameraSettings settings() const override {
    return {text_.scheme == "v4l2" ? "v4l2:" + text_.place : text_.place, std::nullopt, std::nullopt, rate_};
  }

 private:
  [[noreturn]] void refuse() const {
    throw Error(text_.place, "cannot be opened as a camera or stream",
                "check the name, that it is connected, and your rights");
  }

  void set(int property, const std::string& key) {
    const auto wanted = number_option(text_, key);
    if (!wanted) return;
    const bool taken = capture_->set(property, *wanted);
    const double got = capture_->get(property);
    if (!taken || std::abs(got - *wanted) > 0.01 * std::abs(*wanted))
      throw Error("option " + key + " of the source",
                  fmt::format("the camera gives {} instead of {}", got, *wanted),
                  "ask for a value that it has (v4l2-ctl --list-formats-ext)");
  }

  bool grab(const std::stop_token& stop) {
    cv::Mat picture;
    if (stop.stop_requested() || !capture_->read(picture) || picture.empty()) return false;
    const double ms = capture_->get(cv::CAP_PROP_POS_MSEC);
    if (counts_by_time_ && last_ms_) add_lost(*last_ms_, ms);
    last_ms_ = ms;
    LiveFrame frame;
    frame.frame = next_++;
    frame.arrived = std::chrono::system_clock::now();
    frame.complete = std::chrono::steady_clock::now();
    frame.camera_ns = static_cast<std::int64_t>(1e6 * ms);
    if (channel_ == Channel::kAuto)
      channel_ = strongest_channel(picture).channel;  // the first picture decides for all
    frame.image = grey_values(picture, channel_, text_.place);
    waiting_.push_back(std::move(frame));
    return true;
  }

  void add_lost(double before_ms, double now_ms) {
    const double intervals = (now_ms - before_ms) * *rate_ / 1000;
    constexpr double kMost = 100000;  // a clock that was set, no loss
    if (!(intervals > 1.5) || intervals > kMost) return;
    for (long i = std::lround(intervals) - 1; i > 0; --i) {
      LiveFrame lost;
      lost.frame = next_++;
      lost.status = FrameStatus::kLost;
      lost.reason = "its time stamp is missing";
      lost.arrived = std::chrono::system_clock::now();
      lost.complete = std::chrono::steady_clock::now();
      waiting_.push_back(std::move(lost));
    }
  }

  SourceText text_;
  Channel channel_;
  std::unique_ptr<cv::VideoCapture> capture_ = opencv_codecs().new_capture();
  std::optional<double> rate_, last_ms_;
  bool counts_by_time_ = false;
  std::int64_t next_ = 0;
  std::deque<LiveFrame> waiting_;
};

}  // namespace

std::unique_ptr<LiveSource> open_capture(const SourceText& text, const LiveOptions& options) {
  return std::make_unique<Capture>(text, options);
}

}  // namespace lightstripe

// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/video_frames.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <opencv2/videoio.hpp>
#include <string_view>
#include <vector>

#include "core/counted.h"
#include "core/error.h"
#include "io/choose_channel.h"
#include "io/grey_channel.h"
#include "io/opencv_codecs.h"

namespace lightstripe {
namespace {

constexpr std::size_t kMaxKept = 64;     // decoded frames that wait for a thread that is behind
constexpr std::int64_t kSampleStep = 8;  // every so many frames one votes for the channel, fewer later on

class VideoFrames : public FrameSource {
 public:
  VideoFrames(const std::filesystem::path& path, Channel channel) : path_(path), channel_(channel) {
    rewind();
    count_frames();
    rewind();
  }

  std::int64_t size() const override { return size_; }
  std::string name(std::int64_t index) const override {
    return fmt::format("{}#{}", path_.filename().string(), index);
  }

  std::filesystem::path file(std::int64_t) const override { return path_; }
  Channel channel() const override { return channel_; }
  /// These containers count their frames; others' counts are estimates, but a whole file is not short of
  /// many.
  std::string doubt() const override {
    constexpr std::array<std::string_view, 4> kCounted{".avi", ".mp4", ".mov", ".m4v"};
    const bool counted = std::ranges::find(kCounted, path_.extension().string()) != kCounted.end();
    if (stated_ <= size_ + (counted ? 0 : std::max<std::int64_t>(2, size_ / 50))) return {};
    return fmt::format("holds {} that can be read, its header says {}: it is cut short or damaged",
                       lightstripe::counted(size_, "frame"), stated_);
  }

  GreyImage read(std::int64_t index) const override {
    LIGHTSTRIPE_CHECK(index >= 0 && index < size_, "a frame of the sequence");
    return grey_values(picture(index), channel_, path_.string());
  }

 private:
  void rewind() const {
    // Named, because the others (GStreamer, numbered images) take what is no video and talk on stderr.
    const bool opened = capture_->open(path_.string(), cv::CAP_FFMPEG) ||
                        capture_->open(path_.string(), cv::CAP_OPENCV_MJPEG);
    if (!opened)
      throw Error(path_.string(), "cannot be opened as a video", "check the file or convert it to images");
    next_ = 0;
    kept_.clear();
  }

  void count_frames() {
    const double stated = capture_->get(cv::CAP_PROP_FRAME_COUNT);
    if (stated > 0 && stated < 1e9) stated_ = static_cast<std::int64_t>(stated);
    std::int64_t next_vote = 0;
    std::vector<Channel> votes;
    for (cv::Mat frame; capture_->grab(); ++size_) {
      if (channel_ != Channel::kAuto || size_ != next_vote || !capture_->retrieve(frame)) continue;
      const Channel chosen = strongest_channel(frame).channel;
      if (chosen != Channel::kGray) votes.push_back(chosen);
      // Of a video nobody knows the length beforehand: ever sparser samples reach its end.
      next_vote += std::max(kSampleStep, next_vote / 8);
    }
    if (channel_ == Channel::kAuto) channel_ = count_votes(votes);
    if (size_ == 0) throw Error(path_.string(), "holds no frames", "check the file or convert it to images");
  }

  /// Frames are decoded strictly in order, because seeking is not exact in many formats; those that were
  /// passed over are kept for the threads that ask for them next.
  cv::Mat picture(std::int64_t index) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (const auto found = kept_.find(index); found != kept_.end()) {
      cv::Mat frame = found->second;
      kept_.erase(found);
      return frame;
    }
    if (index < next_) rewind();
    while (true) {
      cv::Mat frame;
      if (!capture_->read(frame) || frame.depth() != CV_8U)
        throw Error(name(next_), "cannot be decoded", "convert the video to images");
      if (next_++ == index) return frame;
      kept_.emplace(next_ - 1, std::move(frame));
      if (kept_.size() > kMaxKept) kept_.erase(kept_.begin());
    }
  }

  std::filesystem::path path_;
  Channel channel_;
  std::int64_t size_ = 0, stated_ = 0;
  mutable std::mutex mutex_;
  std::unique_ptr<cv::VideoCapture> capture_ = opencv_codecs().new_capture();
  mutable std::int64_t next_ = 0;
  mutable std::map<std::int64_t, cv::Mat> kept_;
};

}  // namespace

std::unique_ptr<FrameSource> open_video(const std::filesystem::path& path, Channel channel) {
  return std::make_unique<VideoFrames>(path, channel);
}

}  // namespace lightstripe

// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/live_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "core/error.h"
#include "io/live_cameras.h"
#include "io/number_text.h"
#include "io/raw_frames.h"

namespace lightstripe {
namespace {

/// Files, frame by frame, as if a camera sent them.
class Playback : public LiveSource {
 public:
  Playback(const std::string& files, const SourceText& text, Channel channel)
      : source_(open_frames({}, files, channel)), rate_(number_option(text, "frame_rate").value_or(0)) {
    if (rate_ < 0) throw Error(files + ": frame_rate", "is negative", "give frames a second");
  }

  std::optional<LiveFrame> next(const std::stop_token& stop) override {
    if (stop.stop_requested() || next_ == source_->size()) return std::nullopt;
    if (rate_ > 0) std::this_thread::sleep_until(due());
    LiveFrame frame;
    frame.frame = next_++;
    try {
      frame.image = source_->read(frame.frame);
    } catch (const Error& error) {
      frame.status = FrameStatus::kIncomplete;
      frame.reason = error.what();
    }
    frame.arrived = std::chrono::system_clock::now();
    frame.complete = std::chrono::steady_clock::now();
    if (rate_ > 0)
      frame.camera_ns = static_cast<std::int64_t>(1e9 * static_cast<double>(frame.frame) / rate_);
    return frame;
  }
  CameraSettings settings() const override {
    return {"files", std::nullopt, std::nullopt, rate_ > 0 ? std::optional(rate_) : std::nullopt};
  }

 private:
  std::chrono::steady_clock::time_point due() const {
    return start_ +
           std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * static_cast<double>(next_) / rate_));
  }

  std::unique_ptr<FrameSource> source_;
  double rate_;
  std::int64_t next_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Text behind the last '?' as options, if it reads like options: a '?' in a pattern stands for a character.
std::size_t options_at(const std::string& source) {
  const std::size_t mark = source.rfind('?');
  return mark != std::string::npos && source.find('=', mark) != std::string::npos ? mark : std::string::npos;
}

}  // namespace

std::string_view name_of(FrameStatus status) {
  switch (status) {
    case FrameStatus::kWhole:
      return "ok";
    case FrameStatus::kIncomplete:
      return "incomplete";
    case FrameStatus::kLost:
      return "lost";
    case FrameStatus::kLate:
      break;
  }
  return "late";
}

SourceText parse_source(const std::string& source) {
  SourceText text;
  const std::size_t mark =
      source.starts_with("rtsp") || source.starts_with("http") ? std::string::npos : options_at(source);
  text.place = source.substr(0, mark);
  for (const std::string scheme : {"aravis", "v4l2", "rtsp", "rtsps", "http", "https"})
    if (text.place.starts_with(scheme + ":")) text.scheme = scheme;
  if (text.scheme == "aravis" || text.scheme == "v4l2") text.place.erase(0, text.scheme.size() + 1);
  if (mark == std::string::npos) return text;
  std::string_view rest = std::string_view(source).substr(mark + 1);
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
    const std::size_t equals = one.find('=');
    if (equals == std::string_view::npos || equals == 0)
      throw Error(source, fmt::format("has '{}' where an option is expected", one),
                  "write ?name=value&name=value");
    text.options[std::string(one.substr(0, equals))] = one.substr(equals + 1);
  }
  return text;
}

std::optional<double> number_option(const SourceText& text, const std::string& key) {
  const auto found = text.options.find(key);
  if (found == text.options.end()) return std::nullopt;
  const auto number = parse_number(found->second);
  if (!number)
    throw Error("option " + key + " of the source", "'" + found->second + "' is no number", "give a number");
  return number;
}

void refuse_other_options(const SourceText& text, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : text.options)
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw Error("option " + key + " of the source", "is not known",
                  fmt::format("use {}", fmt::join(known, ", ")));
}

bool is_camera(const std::string& source) { return !parse_source(source).scheme.empty(); }

std::unique_ptr<LiveSource> open_live(const std::string& source, const LiveOptions& options) {
  const SourceText text = parse_source(source);
  if (text.scheme == "aravis") return open_aravis(text, options);
  if (!text.scheme.empty()) return open_capture(text, options);
  if (!is_raw(source)) refuse_other_options(text, {"frame_rate"});
  return std::make_unique<Playback>(is_raw(source) ? source : text.place, text, options.channel);
}

}  // namespace lightstripe

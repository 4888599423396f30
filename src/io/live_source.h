// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One door for pictures that come by themselves: an industrial camera (GenICam), a webcam, a network stream,
// and recordings played like one.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "core/image.h"
#include "io/images.h"

namespace lightstripe {

enum class FrameStatus { kWhole, kIncomplete, kLost, kLate };
std::string_view name_of(FrameStatus status);  ///< "ok", "incomplete", "lost", "late"

/// One frame, whether it arrived or not: frames are counted by the camera, so that a gap in its count is a
/// lost frame.
struct LiveFrame {
  std::int64_t frame = 0;                    ///< from 0, ascending without gaps
  FrameStatus status = FrameStatus::kWhole;  ///< late: left out because the reader was behind
  std::string reason;                        ///< why there is no picture; empty for a whole frame
  GreyImage image;                           ///< of a whole frame only
  std::int64_t camera_ns = 0;                ///< the camera's clock; 0 where it has none, or for a lost frame
  std::chrono::system_clock::time_point arrived;
  std::chrono::steady_clock::time_point complete;  ///< when the last byte was there: latency counts from here
  std::optional<double> encoder;                   ///< counts, from the frame's chunk data
};

/// What the camera was told, read back from it; nothing where it does not say.
struct CameraSettings {
  std::string camera;
  std::optional<double> exposure_us, gain, frames_per_second;
};

class LiveSource {
 public:
  virtual ~LiveSource() = default;
  /// Waits for the next frame; nothing when the source has ended or a stop was asked for. An Error where the
  /// camera is gone. One thread at a time.
  virtual std::optional<LiveFrame> next(const std::stop_token& stop) = 0;
  virtual CameraSettings settings() const = 0;
};

/// A source's text taken apart: "aravis:SERIAL?exposure_us=200&gain=3".
struct SourceText {
  std::string scheme, place;
  std::map<std::string, std::string> options;
};

struct LiveOptions {
  Channel channel = Channel::kAuto;
  /// Frames that may wait for the reader; older ones are left out as late. 0: as many as there is memory for.
  int max_waiting = 0;
};

/// Whether the text names a camera or stream rather than files: aravis:, v4l2:, rtsp:// (and http://).
bool is_camera(const std::string& source);

/// aravis:SERIAL (empty: the only camera) with the options exposure_us, gain, frame_rate, packet_size,
/// region=X,Y,WIDTH,HEIGHT, pixel_format, encoder (name of the chunk with the encoder's count);
/// v4l2:/dev/video0 with width, height, frame_rate; rtsp://... ; or files as a scan names them (folder,
/// pattern, video, TIFF), played in their order, with `?frame_rate=` at that rate. An Error names what cannot
/// be opened or set.
std::unique_ptr<LiveSource> open_live(const std::string& source, const LiveOptions& options);

/// The number of an option, nothing where it is not given. An Error where it is no number.
std::optional<double> number_option(const SourceText& text, const std::string& key);
/// An Error where an option is none of `known`.
void refuse_other_options(const SourceText& text, std::initializer_list<std::string_view> known);
SourceText parse_source(const std::string& source);

}  // namespace lightstripe

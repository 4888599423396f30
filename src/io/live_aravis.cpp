// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// GenICam cameras (GigE Vision, USB3 Vision) through Aravis 0.8, which is optional.
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <deque>

#include "core/error.h"
#include "io/live_cameras.h"
#include "io/number_text.h"

#ifdef LIGHTSTRIPE_ARAVIS
#include <arv.h>
#endif

namespace lightstripe {

#ifndef LIGHTSTRIPE_ARAVIS

std::unique_ptr<LiveSource> open_aravis(const SourceText& text, const LiveOptions&) {
  throw Error("aravis:" + text.place, "this lightstripe was built without Aravis",
              "install libaravis-dev and build it again");
}

#else

namespace {

constexpr int kBuffers = 32;
constexpr int kSocketBufferBytes = 16 << 20;
constexpr std::uint64_t kLastShortId = 65535;  // GigE Vision 1 counts blocks 1 .. 65535, then 1 again
constexpr std::int64_t kMostLost = 1000000;    // a gap that is larger means a camera that began anew
// Only a frame's first packet carries its number: Aravis gives a frame without one the number that the same
// buffer had before. This one is written into each buffer that waits.
constexpr std::uint64_t kNoNumber = ~std::uint64_t{0};

/// From one block's number to the next one's. Frames that wait for packets sent again may come after later
/// ones: a small step back is one, a large one the counter's begin.
std::int64_t frames_between(std::uint64_t last, std::uint64_t id) {
  const auto step = static_cast<std::int64_t>(id) - static_cast<std::int64_t>(last);
  const auto round = static_cast<std::int64_t>(kLastShortId);
  if (last > kLastShortId || id > kLastShortId) return step;
  if (step < -round / 2) return step + round;
  return step > round / 2 ? step - round : step;
}

struct Unref {
  void operator()(gpointer object) const { g_object_unref(object); }
};
template <class T>
using Owned = std::unique_ptr<T, Unref>;

/// What a call of Aravis complained of, as an Error.
class Complaint {
 public:
  ~Complaint() { g_clear_error(&error_); }
  Complaint() = default;
  Complaint(const Complaint&) = delete;
  Complaint& operator=(const Complaint&) = delete;
  GError** slot() { return &error_; }
  void check(const std::string& what, const std::string& what_to_do) {
    if (error_ != nullptr)
      throw Error(what, fmt::format("the camera refuses ({})", error_->message), what_to_do);
  }
  std::string text() const { return error_ != nullptr ? error_->message : "no answer"; }

 private:
  GError* error_ = nullptr;
};

std::string known_cameras() {
  std::string list;
  for (unsigned i = 0; i < arv_get_n_devices(); ++i)
    list += fmt::format("{}{}", list.empty() ? "" : ", ", arv_get_device_serial_nbr(i));
  return list;
}

/// Aravis' name of the camera with this serial number (or id, or address); of the only one where none is
/// given.
std::string device_of(const std::string& wanted) {
  arv_update_device_list();
  const unsigned count = arv_get_n_devices();
  for (unsigned i = 0; i < count; ++i)
    for (const char* name : {arv_get_device_serial_nbr(i), arv_get_device_id(i), arv_get_device_address(i)})
      if (name != nullptr && wanted == name) return arv_get_device_id(i);
  const std::string called = "aravis:" + wanted;
  if (count == 0)
    throw Error(called, "no GenICam camera answers",
                "check cable, power and network (arv-tool-0.8 lists cameras)");
  if (wanted.empty() && count == 1) return arv_get_device_id(0);
  if (wanted.empty()) throw Error(called, "there are several cameras", "name one of " + known_cameras());
  throw Error(called, "no camera has this serial number", "use one of " + known_cameras());
}

const char* reason_of(ArvBufferStatus status) {
  switch (status) {
    case ARV_BUFFER_STATUS_TIMEOUT:
      return "packets did not arrive in time";
    case ARV_BUFFER_STATUS_MISSING_PACKETS:
      return "packets are missing";
    case ARV_BUFFER_STATUS_WRONG_PACKET_ID:
      return "a packet has a wrong number";
    case ARV_BUFFER_STATUS_SIZE_MISMATCH:
      return "the picture is larger than announced";
    case ARV_BUFFER_STATUS_ABORTED:
      return "the transfer was ended";
    default:
      return "the transfer failed";
  }
}

template <class T>
Image<T> copy_of(const void* data, int width, int height, int padding_bytes) {
  Image<T> image(width, height);
  const auto* from = static_cast<const std::uint8_t*>(data);
  const std::size_t row = static_cast<std::size_t>(width) * sizeof(T),
                    step = row + static_cast<std::size_t>(padding_bytes);
  for (int y = 0; y < height; ++y) std::memcpy(image.row(y), from + static_cast<std::size_t>(y) * step, row);
  return image;
}

class AravisCamera : public LiveSource {
 public:
  AravisCamera(const SourceText& text, const LiveOptions& options)
      : called_("aravis:" + text.place), max_waiting_(options.max_waiting) {
    refuse_other_options(
        text, {"exposure_us", "gain", "frame_rate", "packet_size", "region", "pixel_format", "encoder"});
    const std::string device = device_of(text.place);
    Complaint complaint;
    camera_.reset(arv_camera_new(device.c_str(), complaint.slot()));
    if (!camera_)
      throw Error(called_, fmt::format("cannot be opened ({})", complaint.text()),
                  "see that no other program uses it");
    configure(text);
    read_settings(device);
    start();
  }
  ~AravisCamera() override {
    if (stream_) arv_camera_stop_acquisition(camera_.get(), nullptr);
  }
  AravisCamera(const AravisCamera&) = delete;
  AravisCamera& operator=(const AravisCamera&) = delete;

  std::optional<LiveFrame> next(const std::stop_token& stop) override {
    while (waiting_.empty()) {
      if (stop.stop_requested()) return std::nullopt;
      take(stop);
    }
    LiveFrame frame = std::move(waiting_.front());
    waiting_.pop_front();
    return frame;
  }
  CameraSettings settings() const override { return settings_; }

 private:
  void configure(const SourceText& text) {
    const std::string advice = "see what it takes (arv-tool-0.8 control)";
    Complaint complaint;
    if (const auto region = text.options.find("region"); region != text.options.end())
      set_region(region->second);
    const auto format = text.options.find("pixel_format");
    arv_camera_set_pixel_format_from_string(
        camera_.get(), format != text.options.end() ? format->second.c_str() : "Mono8", complaint.slot());
    complaint.check(called_ + ": pixel_format", advice);
    if (const auto rate = number_option(text, "frame_rate"))
      arv_camera_set_frame_rate(camera_.get(), *rate, complaint.slot());
    complaint.check(called_ + ": frame_rate", advice);
    if (const auto us = number_option(text, "exposure_us"))
      arv_camera_set_exposure_time(camera_.get(), *us, complaint.slot());
    complaint.check(called_ + ": exposure_us", advice);
    if (const auto gain = number_option(text, "gain"))
      arv_camera_set_gain(camera_.get(), *gain, complaint.slot());
    complaint.check(called_ + ": gain", advice);
    if (arv_camera_is_gv_device(camera_.get())) {
      const auto bytes = number_option(text, "packet_size");
      if (bytes) arv_camera_gv_set_packet_size(camera_.get(), static_cast<int>(*bytes), complaint.slot());
      complaint.check(called_ + ": packet_size", advice);
      // Raw sockets need rights that a container does not give; the stream would then time out.
      arv_camera_gv_set_stream_options(camera_.get(), ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
    }
    if (const auto encoder = text.options.find("encoder"); encoder != text.options.end()) {
      encoder_ = encoder->second;
      arv_camera_set_chunks(camera_.get(), encoder_.c_str(), complaint.slot());
      complaint.check(called_ + ": encoder", "name a chunk that this camera has");
      chunks_.reset(arv_camera_create_chunk_parser(camera_.get()));
    }
  }

  void set_region(const std::string& text) {
    std::array<int, 4> numbers{};
    std::string_view rest = text;
    for (int& number : numbers) {
      const auto parsed = parse_integer(rest.substr(0, rest.find(',')));
      if (!parsed || *parsed < 0 || *parsed > 1 << 20)
        throw Error(called_ + ": region", "'" + text + "' is no region", "write X,Y,WIDTH,HEIGHT");
      number = static_cast<int>(*parsed);
      rest.remove_prefix(std::min(rest.find(','), rest.size() - 1) + 1);
    }
    Complaint complaint;
    arv_camera_set_region(camera_.get(), numbers[0], numbers[1], numbers[2], numbers[3], complaint.slot());
    complaint.check(called_ + ": region", "see which regions it takes (arv-tool-0.8 control)");
  }

  void read_settings(const std::string& device) {
    settings_.camera = device;
    const auto read = [&](auto function) -> std::optional<double> {
      Complaint complaint;
      const double value = function(camera_.get(), complaint.slot());
      return *complaint.slot() == nullptr ? std::optional(value) : std::nullopt;
    };
    settings_.exposure_us = read(arv_camera_get_exposure_time);
    settings_.gain = read(arv_camera_get_gain);
    settings_.frames_per_second = read(arv_camera_get_frame_rate);
  }

  void start() {
    Complaint complaint;
    stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, complaint.slot()));
    if (!stream_)
      throw Error(called_, fmt::format("gives no stream ({})", complaint.text()),
                  "see that no other program uses it");
    if (ARV_IS_GV_STREAM(stream_.get()))
      g_object_set(stream_.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size",
                   kSocketBufferBytes, nullptr);
    const auto payload = arv_camera_get_payload(camera_.get(), complaint.slot());
    complaint.check(called_, "read its manual on PayloadSize");
    for (int i = 0; i < kBuffers; ++i) give(arv_buffer_new_allocate(payload));
    arv_camera_set_acquisition_mode(camera_.get(), ARV_ACQUISITION_MODE_CONTINUOUS, complaint.slot());
    arv_camera_start_acquisition(camera_.get(), complaint.slot());
    complaint.check(called_, "see that nothing else controls it");
  }

  void take(const std::stop_token& stop) {
    constexpr std::uint64_t kWaitUs = 50000;
    constexpr int kWaits = 40;  // after 2 s without a frame the camera is asked whether it is still there
    ArvBuffer* buffer = nullptr;
    for (int i = 0; buffer == nullptr && !stop.stop_requested(); ++i) {
      buffer = arv_stream_timeout_pop_buffer(stream_.get(), kWaitUs);
      if (buffer == nullptr && i % kWaits == kWaits - 1) see_that_it_is_there();
    }
    if (buffer == nullptr) return;
    add(buffer);
    give(buffer);
  }

  void give(ArvBuffer* buffer) {
    arv_buffer_set_frame_id(buffer, kNoNumber);
    arv_stream_push_buffer(stream_.get(), buffer);
  }

  void see_that_it_is_there() {
    Complaint complaint;
    arv_camera_get_payload(camera_.get(), complaint.slot());
    complaint.check(called_, "check cable and power");
  }

  /// Frames waiting in the stream behind this one, for a bounded latency.
  bool is_late() const {
    if (max_waiting_ == 0) return false;
    int in = 0, out = 0;
    arv_stream_get_n_buffers(stream_.get(), &in, &out);
    return out > max_waiting_;
  }

  void add(ArvBuffer* buffer) {
    LiveFrame frame;
    frame.arrived = std::chrono::system_clock::now();
    frame.complete = complete_time(buffer, frame.arrived);
    const std::uint64_t id = arv_buffer_get_frame_id(buffer);
    if (id == kNoNumber) return;  // the gap before the next one names it
    const std::int64_t step = last_id_ ? frames_between(*last_id_, id) : 1;
    if (step <= 0 && step > -kBuffers) return;  // named as lost when a later one was complete
    add_lost(step, frame);
    last_id_ = id;
    frame.frame = next_++;
    const ArvBufferStatus status = arv_buffer_get_status(buffer);
    frame.camera_ns = static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer));
    if (status != ARV_BUFFER_STATUS_SUCCESS) {
      frame.status = FrameStatus::kIncomplete;
      frame.reason = reason_of(status);
    } else if (is_late()) {
      frame.status = FrameStatus::kLate;
      frame.reason = "newer frames were waiting";
    } else {
      read_picture(buffer, frame);
    }
    if (chunks_ && status == ARV_BUFFER_STATUS_SUCCESS) frame.encoder = encoder_of(buffer);
    waiting_.push_back(std::move(frame));
  }

  /// Aravis stamps a buffer with the system's clock when its last packet arrived.
  static std::chrono::steady_clock::time_point complete_time(ArvBuffer* buffer,
                                                             std::chrono::system_clock::time_point now) {
    const auto age =
        now.time_since_epoch() - std::chrono::nanoseconds(arv_buffer_get_system_timestamp(buffer));
    const bool plausible = age >= std::chrono::nanoseconds(0) && age < std::chrono::minutes(1);
    return std::chrono::steady_clock::now() - (plausible
                                                   ? std::chrono::duration_cast<std::chrono::nanoseconds>(age)
                                                   : std::chrono::nanoseconds(0));
  }

  /// Names the frames that are missing before this one; a gap beyond all measure is a camera that began anew.
  void add_lost(std::int64_t step, const LiveFrame& now) {
    for (std::int64_t i = 1; i < step && step < kMostLost; ++i) {
      LiveFrame lost;
      lost.frame = next_++;
      lost.status = FrameStatus::kLost;
      lost.reason = "it had not arrived when a later one was complete";
      lost.arrived = now.arrived;
      lost.complete = now.complete;
      waiting_.push_back(std::move(lost));
    }
  }

  void read_picture(ArvBuffer* buffer, LiveFrame& frame) const {
    std::size_t bytes = 0;
    const void* data = arv_buffer_get_image_data(buffer, &bytes);
    const int width = arv_buffer_get_image_width(buffer), height = arv_buffer_get_image_height(buffer);
    int padding = 0, ignored = 0;
    arv_buffer_get_image_padding(buffer, &padding, &ignored);
    const ArvPixelFormat format = arv_buffer_get_image_pixel_format(buffer);
    const bool wide = format == ARV_PIXEL_FORMAT_MONO_10 || format == ARV_PIXEL_FORMAT_MONO_12 ||
                      format == ARV_PIXEL_FORMAT_MONO_14 || format == ARV_PIXEL_FORMAT_MONO_16;
    if (format != ARV_PIXEL_FORMAT_MONO_8 && !wide)
      throw Error(called_, "sends neither Mono8 nor Mono10, 12, 14 or 16", "give pixel_format=Mono8");
    const std::size_t row =
        static_cast<std::size_t>(width) * (wide ? 2 : 1) + static_cast<std::size_t>(padding);
    if (data == nullptr || width <= 0 || height <= 0 ||
        bytes + static_cast<std::size_t>(padding) < row * static_cast<std::size_t>(height)) {
      frame.status = FrameStatus::kIncomplete;
      frame.reason = "it has fewer bytes than pixels";
    } else if (wide) {
      frame.image = copy_of<std::uint16_t>(data, width, height, padding);
    } else {
      frame.image = copy_of<std::uint8_t>(data, width, height, padding);
    }
  }

  std::optional<double> encoder_of(ArvBuffer* buffer) const {
    Complaint complaint;
    const auto value =
        arv_chunk_parser_get_integer_value(chunks_.get(), buffer, encoder_.c_str(), complaint.slot());
    return *complaint.slot() == nullptr ? std::optional(static_cast<double>(value)) : std::nullopt;
  }

  std::string called_, encoder_;
  int max_waiting_;
  Owned<ArvCamera> camera_;
  Owned<ArvChunkParser> chunks_;
  Owned<ArvStream> stream_;
  CameraSettings settings_;
  std::optional<std::uint64_t> last_id_;
  std::int64_t next_ = 0;
  std::deque<LiveFrame> waiting_;
};

}  // namespace

std::unique_ptr<LiveSource> open_aravis(const SourceText& text, const LiveOptions& options) {
  return std::make_unique<AravisCamera>(text, options);
}

#endif

}  // namespace lightstripe

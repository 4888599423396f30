// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The frames of a tracked scan that others are searched by, each found once, whichever thread needs it first.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/stripe.h"
#include "extraction/track/track_reference.h"

namespace lightstripe {

/// What one sensor shows in one frame.
struct SensorStripes {
  bool has_picture = false;
  std::vector<Stripe> stripes;
  std::exception_ptr unreadable;  ///< the Error why its picture cannot be used
  std::string reason;             ///< the same in words
};

struct KeyFrame {
  SensorStripes found;
  TrackReference reference;    ///< empty: nothing to go by
  std::exception_ptr failure;  ///< anything else that went wrong
};

class KeyFrames {
 public:
  using Make = std::function<KeyFrame()>;

  /// The key frame `frame` of `sensor`; made by the first caller, for whom the others wait. `make` must not
  /// call this; what it throws becomes the key frame's failure.
  std::shared_ptr<const KeyFrame> get(std::int64_t frame, int sensor, const Make& make);

 private:
  struct Slot {
    bool ready = false;
    std::shared_ptr<const KeyFrame> key;
  };

  std::mutex mutex_;
  std::condition_variable made_;
  std::map<std::pair<std::int64_t, int>, Slot> slots_;
};

}  // namespace lightstripe

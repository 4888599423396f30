// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/key_frames.h"

#include <algorithm>

#include "extraction/track/track_stripes.h"

namespace lightstripe {
namespace {

/// Far more frames than are under way at one time: older key frames are not asked for any more. Where one is
/// all the same, it is made again.
constexpr std::int64_t kKept = 64 * kTrackedFrames;

KeyFrame made_or_failed(const KeyFrames::Make& make) {
  try {
    return make();
  } catch (...) {
    return {{}, {}, std::current_exception()};
  }
}

}  // namespace

std::shared_ptr<const KeyFrame> KeyFrames::get(std::int64_t frame, int sensor, const Make& make) {
  std::unique_lock lock(mutex_);
  const auto [at, is_new] = slots_.try_emplace({frame, sensor});
  if (!is_new) {
    const auto place = at->first;
    made_.wait(lock, [&] { return slots_.count(place) == 0 || slots_.at(place).ready; });
    if (const auto found = slots_.find(place); found != slots_.end()) return found->second.key;
    return std::make_shared<const KeyFrame>(made_or_failed(make));
  }
  std::erase_if(slots_, [&](const auto& s) { return s.second.ready && s.first.first < frame - kKept; });
  lock.unlock();
  auto key = std::make_shared<const KeyFrame>(made_or_failed(make));
  lock.lock();
  slots_[{frame, sensor}] = {true, key};
  made_.notify_all();
  return key;
}

}  // namespace lightstripe

// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/encoder_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "core/counted.h"
#include "reconstruct/frame_ranges.h"

namespace lightstripe {
namespace {

constexpr double kJump = 20;     // usual steps
constexpr double kNoRig = 1000;  // usual steps: no rig goes there and back within a frame
constexpr double kFullTurn = 360;

struct Steps {
  double usual = 0;   ///< median size a frame, 0: not known
  double widest = 0;  ///< three quarters of the sizes a frame are smaller
};

double frames_between(const TravelReadings& readings, std::size_t i, std::size_t j) {
  return static_cast<double>(readings[j].first - readings[i].first);
}

Steps steps_of(const TravelReadings& readings) {
  constexpr std::size_t kFewest = 4;
  std::vector<double> sizes;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    const double step = std::abs(readings[i].second - readings[i - 1].second);
    if (step > 0) sizes.push_back(step / frames_between(readings, i - 1, i));
  }
  if (sizes.size() < kFewest) return {};
  std::sort(sizes.begin(), sizes.end());
  return {sizes[sizes.size() / 2], sizes[sizes.size() * 3 / 4]};
}

/// The finest digit of the readings, as a whole number of 1e-6: the greatest common divisor; 0 where they are
/// finer than that or too large.
std::int64_t resolution_of(const TravelReadings& readings) {
  std::int64_t divisor = 0;
  for (const auto& [frame, travel] : readings) {
    const double scaled = travel * 1e6;
    if (!(std::abs(scaled) < 9e15) ||
        std::abs(scaled - std::round(scaled)) > 1e-3 * (1 + std::abs(scaled) * 1e-9))
      return 0;
    divisor = std::gcd(divisor, std::llround(scaled));
  }
  return divisor;
}

/// The length of a counter that began anew between two raw readings, signed as it has to be added; nothing
/// where none or more than one fits. A counter begins anew at one end of its range, 0 .. length or -length /
/// 2
/// .. length / 2, and was at the other end before.
std::optional<double> wrap_length(double before, double behind, const Steps& steps, double frames,
                                  std::int64_t resolution) {
  constexpr int kMostParts = 100;
  if (resolution <= 0) return std::nullopt;
  const double step = behind - before, near = 1.5 * steps.widest * frames;
  std::vector<double> fitting;
  for (const double counts : {65536.0, 4294967296.0})
    for (int parts = 1; parts <= kMostParts; ++parts) {
      const double length = counts * static_cast<double>(resolution) * 1e-6 / parts;
      if (length < kJump * steps.usual * frames) break;
      if (std::abs(std::abs(step) - length) > near) continue;
      const double low = std::min(before, behind), high = std::max(before, behind);
      const bool unsigned_ends = std::abs(low) <= near && std::abs(high - length) <= near;
      const bool signed_ends = std::abs(low + length / 2) <= near && std::abs(high - length / 2) <= near;
      if (unsigned_ends || signed_ends) fitting.push_back(length);
    }
  if (fitting.size() != 1) return std::nullopt;
  return step < 0 ? fitting.front() : -fitting.front();
}

class Check {
 public:
  Check(TravelReadings readings, MotionType motion)
      : steps_(steps_of(readings)), rotary_(motion == MotionType::kRotary), in_(std::move(readings)) {}

  CheckedReadings run() {
    if (steps_.usual == 0) {
      out_.readings = std::move(in_);
      say_stuck();  // also a counter that never moved
      return std::move(out_);
    }
    resolution_ = resolution_of(in_);
    for (std::size_t i = 0; i < in_.size(); ++i) take(i);
    say_left_out();
    say_stuck();
    return std::move(out_);
  }

 private:
  std::string unit() const { return rotary_ ? "deg" : "mm"; }

  bool is_jump(double step, double frames, double limit) const {
    if (rotary_ && std::abs(step) <= kFullTurn + kJump * steps_.usual * frames) return false;
    return std::abs(step) > limit * steps_.usual * frames;
  }

  /// How many readings from `i` on stand for nothing: all far from what lies before and behind them.
  std::size_t errors_at(std::size_t i) const {
    constexpr std::size_t kLongest = 50;
    if (i == 0 || out_.readings.empty()) return 0;
    const auto& [frame, travel] = out_.readings.back();
    for (std::size_t j = i; j < in_.size() && j - i <= kLongest; ++j) {
      const double frames = static_cast<double>(in_[j].first - frame), step = in_[j].second + added_ - travel;
      if (!is_jump(step, frames, kJump)) return j - i;
      if (!is_jump(step, frames, kNoRig)) return 0;
    }
    return 0;
  }

  void take(std::size_t i) {
    if (skip_ > 0) {
      --skip_;
      return;
    }
    auto [frame, travel] = in_[i];
    if (!out_.readings.empty()) {
      const double step = travel + added_ - out_.readings.back().second;
      const double frames = static_cast<double>(frame - out_.readings.back().first);
      if (is_jump(step, frames, kJump)) {
        if (!explain(i, step, frames)) return;
      } else if (is_reset(i, step, frames)) {
        name_jump(frame, step);
      }
    }
    out_.readings.emplace_back(frame, travel + added_);
  }

  /// Back by several usual steps in between steps forth (or the other way round), as no rig turns.
  bool is_reset(std::size_t i, double step, double frames) const {
    constexpr double kSteps = 3;
    if (i < 2 || i + 1 >= in_.size() || std::abs(step) <= kSteps * steps_.usual * frames) return false;
    const double before = in_[i - 1].second - in_[i - 2].second, after = in_[i + 1].second - in_[i].second;
    return !rotary_ && before * step < 0 && after * step < 0;
  }

  void name_jump(std::int64_t frame, double step) {
    if (++jumps_ > kMostNamed) return;
    out_.warnings.push_back(fmt::format(
        "frame {}: the travel jumps by {:.6g} {} (usual step {:.3g}); if the counter began anew or was "
        "reset there, correct the table",
        frame, step, unit(), steps_.usual));
  }

  /// False where the reading is left out.
  bool explain(std::size_t i, double step, double frames) {
    const std::int64_t frame = in_[i].first;
    if (const std::size_t errors = errors_at(i); errors > 0) {
      for (std::size_t k = i; k < i + errors; ++k) left_out_.add(in_[k].first);
      first_error_ = left_out_.count == static_cast<std::int64_t>(errors) ? in_[i].second : first_error_;
      skip_ = errors - 1;
      return false;
    }
    const auto length = rotary_ ? std::nullopt
                                : wrap_length(out_.readings.back().second - added_, in_[i].second, steps_,
                                              frames, resolution_);
    if (length) {
      added_ += *length;
      out_.warnings.push_back(fmt::format(
          "frame {}: the counter has begun anew after {:.6g} mm; this is undone in all frames from there on",
          frame, std::abs(*length)));
    } else {
      name_jump(frame, step);
    }
    return true;
  }

  void say_left_out() {
    if (left_out_.count == 0) return;
    out_.warnings.push_back(fmt::format(
        "{} that no rig can have reached (the first: {:.10g} {}) {} left out, {} {}",
        counted(left_out_.count, "reading"), first_error_, unit(), noun_of(left_out_.count, "is", "are"),
        noun_of(left_out_.count, "frame"), left_out_.text()));
  }

  void say_stuck() {
    constexpr std::size_t kFewest = 3;
    FrameRanges stuck;
    for (std::size_t i = 0; i < out_.readings.size();) {
      std::size_t end = i + 1;
      while (end < out_.readings.size() && out_.readings[end].second == out_.readings[i].second) ++end;
      if (end - i > kFewest)
        for (std::size_t k = i + 1; k < end; ++k) stuck.add(out_.readings[k].first);
      i = end;
    }
    if (stuck.count > 0)
      out_.warnings.push_back(
          fmt::format("{} the very travel of the frame before them: the rig stood still, or the "
                      "counter was stuck and their sections lie in one place: frames {}",
                      counted(stuck.count, "frame has", "frames have"), stuck.text()));
  }

  static constexpr int kMostNamed = 5;
  Steps steps_;
  bool rotary_;
  TravelReadings in_;
  CheckedReadings out_;
  std::int64_t resolution_ = 0;
  double added_ = 0, first_error_ = 0;
  FrameRanges left_out_;
  std::size_t skip_ = 0;
  int jumps_ = 0;
};

}  // namespace

CheckedReadings check_encoder(TravelReadings readings, MotionType motion) {
  return Check(std::move(readings), motion).run();
}

}  // namespace lightstripe

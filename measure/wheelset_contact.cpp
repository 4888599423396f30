// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/wheelset_contact.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace lightstripe {
namespace {

/// One wheel moved over its rail: outwards by `out_mm`, its outer side lifted by `lift_rad`.
struct Pose {
  double out_mm = 0, lift_rad = 0;
};

/// The gap over a place of the wheel. The turn is below a milliradian: cosine 1.
double gap_at(const WheelOnRail& side, const Pose& pose, double y) {
  const double z = side.wheel.at(y), out = side.wheel_datum_mm + y;
  const double over = out - pose.lift_rad * z + pose.out_mm - side.rail_origin_mm;
  return z + pose.lift_rad * out - side.rail.at(over);
}

double rail_place(const WheelOnRail& side, const Pose& pose, double y) {
  return side.wheel_datum_mm + y - pose.lift_rad * side.wheel.at(y) + pose.out_mm - side.rail_origin_mm;
}

struct Touch {
  double y = 0, gap = 0;
};

/// The bottom of the valley about a place by parabolas that narrow.
Touch refine(const WheelOnRail& side, const Pose& pose, Touch touch, double reach) {
  for (const double h : {reach, reach / 2, reach / 4}) {
    const double before = gap_at(side, pose, touch.y - h), here = gap_at(side, pose, touch.y),
                 after = gap_at(side, pose, touch.y + h);
    const double bend = before - 2 * here + after;
    if (bend > 0) touch.y += std::clamp(h * (before - after) / (2 * bend), -h, h);
  }
  touch.gap = gap_at(side, pose, touch.y);
  return touch;
}

struct Range {
  double from, to;
};

/// The places of the wheel over which its rail is known.
Range common_range(const WheelOnRail& side, const Pose& pose) {
  const double shift = side.rail_origin_mm - side.wheel_datum_mm - pose.out_mm, rail_step = side.rail.step_mm,
               wheel_step = side.wheel.step_mm;
  return {std::max(side.wheel.first_mm + wheel_step, side.rail.first_mm + rail_step + shift),
          std::min(side.wheel.last_mm() - wheel_step, side.rail.last_mm() - rail_step + shift)};
}

Touch lowest(const WheelOnRail& side, const Pose& pose, const Range& range, double spacing) {
  Touch best{range.from, 1e300};
  for (double y = range.from; y <= range.to; y += spacing)
    if (const double gap = gap_at(side, pose, y); gap < best.gap) best = {y, gap};
  return refine(side, pose, best, spacing);
}

/// Whether the gap rises anywhere on the way from an old contact down to the new one.
bool over_a_ridge(const WheelOnRail& side, const Pose& pose, double from, double to) {
  constexpr double kStepMm = 0.05, kRidgeMm = 1e-6;
  const int steps = static_cast<int>(std::abs(to - from) / kStepMm);
  double lowest_so_far = gap_at(side, pose, from);
  for (int i = 1; i <= steps; ++i) {
    const double gap = gap_at(side, pose, from + (to - from) * i / steps);
    if (gap > lowest_so_far + kRidgeMm) return true;
    lowest_so_far = std::min(lowest_so_far, gap);
  }
  return false;
}

struct Step {
  WheelsetPlace place;
  bool outside = false, flange = false;
};

Pose pose_of(std::size_t side, double shift, double roll) {
  return side == 1 ? Pose{shift, roll} : Pose{-shift, -roll};
}

/// Both wheels at one shift; the roll starts from that of the place before, if there is one.
Step settle(const std::array<WheelOnRail, kSides>& sides, double shift, const WheelsetPlace* before,
            const ContactOptions& options) {
  double roll = before ? before->roll_rad : 0;
  constexpr int kRounds = 3;
  const double apart = sides[0].wheel_datum_mm + sides[1].wheel_datum_mm;
  std::array<Touch, kSides> touch;
  std::array<Range, kSides> range{};
  for (std::size_t s = 0; s < kSides; ++s) {
    range[s] = common_range(sides[s], pose_of(s, shift, roll));
    touch[s] = lowest(sides[s], pose_of(s, shift, roll), range[s], options.search_mm);
  }
  for (int round = 0; round < kRounds; ++round) {
    roll -= (touch[1].gap - touch[0].gap) / apart;
    for (std::size_t s = 0; s < kSides; ++s)
      touch[s] = refine(sides[s], pose_of(s, shift, roll), touch[s], options.search_mm / 2);
  }
  Step out;
  out.place.shift_mm = shift, out.place.roll_rad = roll;
  for (std::size_t s = 0; s < kSides; ++s) {
    const double y = touch[s].y, on_rail = rail_place(sides[s], pose_of(s, shift, roll), y);
    const bool jumped =
        before && over_a_ridge(sides[s], pose_of(s, shift, roll), before->contact[s].wheel_y_mm, y);
    out.place.contact[s] = {y, on_rail, sides[s].rail.slope_at(on_rail), jumped, -sides[s].wheel.at(y)};
    out.outside |= y < range[s].from + options.margin_mm || y > range[s].to - options.margin_mm;
    out.flange |= std::abs(sides[s].wheel.slope_at(y)) > options.steepest;
  }
  return out;
}

/// From the middle to one side, the middle left out.
std::vector<WheelsetPlace> walk(const std::array<WheelOnRail, kSides>& sides, const WheelsetPlace& middle,
                                double direction, const ContactOptions& options, ContactEnd& end) {
  std::vector<WheelsetPlace> places;
  const WheelsetPlace* before = &middle;
  const int steps = static_cast<int>(std::lround(options.farthest_mm / options.step_mm));
  end = ContactEnd::kFarthest;
  places.reserve(static_cast<std::size_t>(std::max(0, steps)));
  for (int i = 1; i <= steps; ++i) {
    const Step step = settle(sides, direction * i * options.step_mm, before, options);
    if (step.flange || step.outside) {
      end = step.flange ? ContactEnd::kFlange : ContactEnd::kOutside;
      break;
    }
    places.push_back(step.place);
    before = &places.back();
  }
  return places;
}

}  // namespace

WheelsetWalk walk_wheelset(const std::array<WheelOnRail, kSides>& sides, const ContactOptions& options) {
  LIGHTSTRIPE_CHECK(options.step_mm > 0 && options.search_mm > 0, "steps of a contact search are positive");
  WheelsetWalk out;
  for (const WheelOnRail& side : sides) {
    const Range range = common_range(side, {});
    if (side.wheel.height_mm.size() < 8 || side.rail.height_mm.size() < 8 || range.to - range.from < 2)
      return out;
  }
  const Step middle = settle(sides, 0, nullptr, options);
  if (middle.outside) return out;
  out.places = walk(sides, middle.place, -1, options, out.left_end);
  std::reverse(out.places.begin(), out.places.end());
  out.places.push_back(middle.place);
  const std::vector<WheelsetPlace> right = walk(sides, middle.place, 1, options, out.right_end);
  out.places.insert(out.places.end(), right.begin(), right.end());
  return out;
}

double overlap_centre_mm(const WheelOnRail& side, const WheelsetPlace& place, TrackSide which,
                         double approach_mm) {
  constexpr double kStepMm = 0.02;
  const auto s = static_cast<std::size_t>(which);
  const Pose pose = pose_of(s, place.shift_mm, place.roll_rad);
  const Range range = common_range(side, pose);
  const double touching = gap_at(side, pose, place.contact[s].wheel_y_mm);
  double sum = 0, weight = 0;
  for (double y = range.from; y <= range.to; y += kStepMm) {
    const double depth = std::max(0.0, approach_mm - (gap_at(side, pose, y) - touching));
    sum += depth * rail_place(side, pose, y), weight += depth;
  }
  return weight > 0 ? sum / weight : place.contact[s].rail_y_mm;
}

std::vector<ContactJump> find_jumps(const WheelsetWalk& walk) {
  std::vector<ContactJump> jumps;
  for (std::size_t i = 0; i < walk.places.size(); ++i)
    for (std::size_t s = 0; s < kSides; ++s) {
      const WheelsetPlace& here = walk.places[i];
      if (!here.contact[s].jumped) continue;
      const WheelsetPlace& before = walk.places[here.shift_mm > 0 ? i - 1 : i + 1];
      jumps.push_back({s == 0 ? TrackSide::kLeft : TrackSide::kRight, (before.shift_mm + here.shift_mm) / 2,
                       before.contact[s].rail_y_mm, here.contact[s].rail_y_mm});
    }
  return jumps;
}

}  // namespace lightstripe

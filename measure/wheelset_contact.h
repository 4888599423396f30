// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where a rigid wheelset touches two rigid rails as it shifts sideways, and its rolling radii there.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "measure/running_surface.h"

namespace lightstripe {

enum class TrackSide { kLeft, kRight };
inline constexpr std::size_t kSides = 2;

/// One wheel over its rail. Both coordinates grow outwards from the track's middle; z up.
struct WheelOnRail {
  HeightTable wheel;          ///< y from the tread datum; 0 there
  HeightTable rail;           ///< in the rail's own frame
  double wheel_datum_mm = 0;  ///< outwards coordinate of the wheel's datum: back to back / 2 + 70
  double rail_origin_mm = 0;  ///< outwards coordinate of the rail's origin
};

struct ContactPoint {
  double wheel_y_mm = 0;  ///< from the tread datum
  double rail_y_mm = 0;   ///< in the rail's own frame
  double slope = 0;       ///< of the rail there, dz/dy outwards
  bool jumped = false;    ///< leapt over a ridge since the shift before, nearer to the middle
  double radius_mm = 0;   ///< of the wheel there, less that at the datum
};

/// At one lateral shift of the wheelset, + to the right.
struct WheelsetPlace {
  double shift_mm = 0;
  double roll_rad = 0;                       ///< + lifts the right wheel
  std::array<ContactPoint, kSides> contact;  ///< by TrackSide
  /// Right rolling radius less the left one.
  double radius_difference_mm() const { return contact[1].radius_mm - contact[0].radius_mm; }
};

struct ContactOptions {
  double step_mm = 0.1;     ///< of the shift: EN 15302 asks for 0.1 or less
  double farthest_mm = 10;  ///< of the shift
  double search_mm = 0.1;   ///< spacing of the search for the nearest place, along the profile
  double steepest = 2.0;    ///< slope of the contact where the flange has run up
  double margin_mm = 0.5;   ///< a contact nearer than this to the end of a profile is not trusted
};

/// What stopped the walk on one side.
enum class ContactEnd { kFarthest, kFlange, kOutside };

struct WheelsetWalk {
  std::vector<WheelsetPlace> places;  ///< shifts ascend in even steps; the middle one is 0
  ContactEnd left_end = ContactEnd::kFarthest, right_end = ContactEnd::kFarthest;
  bool usable() const { return !places.empty(); }
};

/// Shifts the wheelset from 0 to either side. Each wheel touches where its gap to the rail is least; the roll
/// lets both touch at once (about the middle of the track at the datum's height). Empty where even the
/// middle's contact is not within the profiles.
WheelsetWalk walk_wheelset(const std::array<WheelOnRail, kSides>& sides, const ContactOptions& options = {});

/// Where a wheel that is pressed `approach_mm` into its rail overlaps it: the overlap's centre on the rail,
/// weighted by its depth. A loaded wheel's contact patch lies about it, not about the rigid contact point,
/// where the curvatures of both change: with an approach of 0.01 mm S1002 on UIC60 meets the places that
/// CONTACT prints for 10 kN, from which the rigid points differ by up to 1.4 mm.
double overlap_centre_mm(const WheelOnRail& side, const WheelsetPlace& place, TrackSide which,
                         double approach_mm);

/// Between two shifts a contact point leaps from one valley of the gap to another.
struct ContactJump {
  TrackSide side = TrackSide::kLeft;
  double shift_mm = 0;            ///< in the middle of the step
  double from_mm = 0, to_mm = 0;  ///< on the rail, seen from the middle of the track outwards in the shift
};
std::vector<ContactJump> find_jumps(const WheelsetWalk& walk);

}  // namespace lightstripe

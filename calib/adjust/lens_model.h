// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which of OpenCV's distortion terms a calibration may use, by name.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/fields.h"

namespace lightstripe {

enum class LensModel {
  kAuto,
  kPinhole,
  kBrown4,
  kTilted,
  kBrown5,
  kTilted5,
  kRational,
  kTiltedRational,
  kThinPrism
};

constexpr std::array<EnumName<LensModel>, 9> enum_names(LensModel) {
  return {{{LensModel::kAuto, "auto"},
           {LensModel::kPinhole, "pinhole"},
           {LensModel::kBrown4, "brown4"},
           {LensModel::kTilted, "tilted"},
           {LensModel::kBrown5, "brown5"},
           {LensModel::kTilted5, "tilted5"},
           {LensModel::kRational, "rational"},
           {LensModel::kTiltedRational, "tilted-rational"},
           {LensModel::kThinPrism, "thin-prism"}}};
}

/// The free terms of OpenCV's order (Camera::distortion), ascending; the others are 0. Where the sensor's
/// tilt is free p1 and p2 are not: a lens' decentring and a tilted sensor bend the image in nearly the same
/// way.
///   brown4 k1 k2 p1 p2   brown5 and k3   rational and k4 k5 k6   thin-prism and s1 .. s4
///   tilted k1 k2 tau_x tau_y   tilted5 and k3   tilted-rational and k4 k5 k6
/// kAuto has none: choose_lens() names one.
std::vector<int> free_terms(LensModel model);

bool has_tilt(LensModel model);

/// The terms by name, in OpenCV's order.
inline constexpr std::array<std::string_view, 14> kTermNames{"k1", "k2", "p1", "p2", "k3", "k4",    "k5",
                                                             "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y"};

}  // namespace lightstripe

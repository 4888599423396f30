// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/verify_text.h"

#include <fmt/format.h>

#include <cmath>

#include "core/counted.h"

namespace lightstripe {

std::string describe_verification(const Verification& verification) {
  std::string text;
  for (const auto& s : by_sensor(verification))
    text += fmt::format(
        "{}: stripe off the board {:.3f} mm, distances along it {:.3f} mm, corners {:.3f} px (rms, {} "
        "views)\n",
        s.name, s.plane_rms_mm, s.length_error_mm, s.corner_rms_px, s.views);
  for (const auto& s : by_seam(verification))
    text += fmt::format("{} to {}: gap {:.3f} mm, board's place {:.3f} mm (rms, {})\n", s.sensor, s.other,
                        s.gap_mm, s.centre_gap_mm, counted(s.poses, "pose"));
  if (verification.travel_rms_mm)
    text += fmt::format("travel: fixed board within {:.3f} mm rms\n", *verification.travel_rms_mm);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string describe_check(const ArtefactCheck& check) {
  std::string text = fmt::format(
      "{} of {:g} mm: measured {:.4f} mm, error {:+.4f} mm, sigma {:.4f} mm ({}, scatter {:.4f} mm)",
      check.artefact, check.size_mm, check.measured_mm, check.error_mm, check.sigma_mm,
      counted(check.points, "point"), check.scatter_mm);
  if (check.drift_mm)
    text +=
        fmt::format("\nsince the last check: {:+.4f} mm, sigma {:.4f} mm{}", *check.drift_mm,
                    check.drift_sigma_mm.value_or(0),
                    std::abs(*check.drift_mm) > 3 * check.drift_sigma_mm.value_or(0) ? ": it drifts" : "");
  return text;
}

}  // namespace lightstripe

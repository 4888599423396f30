// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/design_text.h"

#include <fmt/format.h>

#include <cmath>

namespace lightstripe {
namespace {

std::string length_text(double mm) { return std::isfinite(mm) ? fmt::format("{:.1f}", mm) : "no end"; }

std::string line_of(const char* name, const DesignPlace& p) {
  if (!std::isfinite(p.height_mm)) return fmt::format("{:<8} {:>10}\n", name, "no end");
  return fmt::format("{:<8} {:>10.1f} {:>10.1f} {:>12.4f} {:>13.4f} {:>11.4f}\n", name, p.height_mm,
                     p.width_mm, p.along_mm_px, p.across_mm_px, p.sigma_mm);
}

}  // namespace

std::string describe_design(const SensorDesign& d, const DesignAnswer& answer) {
  std::string text = fmt::format(
      "distance {:g} mm, angle {:g} deg, focal length {:g} px, image {} x {} px (along x across the stripe), "
      "noise {:g} px\n\n",
      d.distance_mm, d.angle_deg, d.focal_px, d.along_px, d.across_px, d.noise_px);
  text += fmt::format("{:<8} {:>10} {:>10} {:>12} {:>13} {:>11}\n", "", "height mm", "width mm",
                      "along mm/px", "height mm/px", "sigma mm");
  text += line_of("near", answer.near) + line_of("middle", answer.middle) + line_of("far", answer.far);
  return text +
         fmt::format(
             "\nrange      {} mm of height\nresolution {:.4f} mm along the stripe, {:.4f} mm of height a "
             "pixel in the middle\nsigma      {:.4f} mm of height in the middle, by triangulation\n",
             length_text(answer.range_mm), answer.middle.along_mm_px, answer.middle.across_mm_px,
             answer.middle.sigma_mm);
}

}  // namespace lightstripe

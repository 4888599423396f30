// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/calibration_text.h"

#include <fmt/format.h>

#include "core/counted.h"

namespace lightstripe {
namespace {

/// At least two digits that count: a predicted error of 0.0000 mm would be a promise.
std::string millimetres(double value) {
  return value >= 1e-3 ? fmt::format("{:.4f}", value) : fmt::format("{:.2g}", value);
}

std::string describe_rejected(const std::vector<RejectedImage>& rejected) {
  std::string text;
  for (const auto& image : rejected)
    text += fmt::format("  {:<10} {:<16} {}\n", image.sensor, image.image, image.reason);
  return text.empty() ? "" : "left out:\n" + text;
}

std::string describe_views(const std::vector<ViewResidual>& views) {
  std::string text = "  sensor     image             corners  rms px    stripe  rms px  left out\n";
  for (const auto& v : views)
    text += fmt::format("  {:<10} {:<16} {:>8} {:>7.3f}  {:>8} {:>7}  {:>8}\n", v.sensor, v.image, v.corners,
                        v.board_rms_px, v.stripe_points,
                        v.stripe_points > 0 ? fmt::format("{:.3f}", v.stripe_rms_px) : "-", v.left_out);
  return text;
}

std::string describe_lenses(const std::vector<LensChoice>& lenses) {
  std::string text;
  for (const auto& choice : lenses) {
    if (choice.lens == LensModel::kAuto) continue;  // the camera is given, none was chosen
    text += fmt::format("{}: lens model {}", choice.sensor, enum_name(choice.lens));
    std::string tried;
    for (const auto& trial : choice.trials)
      tried +=
          fmt::format("{}{} {:.4f}", tried.empty() ? "" : ", ", enum_name(trial.lens), trial.held_out_rms_px);
    text += tried.empty() ? "\n" : fmt::format(" (error on views left out, px: {})\n", tried);
  }
  return text;
}

}  // namespace

std::string describe_calibration(const SessionObservations& seen, const CalibrationResult& result) {
  std::string text =
      fmt::format("boards: found in {} of {}\n", seen.boards_found, counted(seen.images, "image"));
  for (const auto& [sensor, channel] : seen.channels)
    if (channel != Channel::kGray)
      text += fmt::format("{}: lines are looked for in the channel {}\n", sensor, enum_name(channel));
  text += describe_rejected(seen.rejected);
  text += describe_views(result.summary.views);
  text += describe_lenses(result.summary.lenses);
  const RigQuality& quality = result.rig.quality;
  for (const auto& s : quality.sensors)
    text += fmt::format(
        "{}: corners {:.3f} px rms in {}{}\n", s.name, s.board_rms_px, counted(s.board_views, "view"),
        s.stripe_views > 0
            ? fmt::format(", stripe {:.3f} px rms in {}", s.stripe_rms_px, counted(s.stripe_views, "view"))
            : ", no stripe");
  if (quality.section_shape_sigma_mm > 0)
    text += fmt::format("predicted error of a section: {} mm in shape, {} mm in place\n",
                        millimetres(quality.section_shape_sigma_mm),
                        millimetres(quality.section_absolute_sigma_mm));
  for (const auto& stripes : result.summary.stripes)
    text += fmt::format("{}{}: {} of {} {} in the laser plane\n", stripes.sensor,
                        stripes.plane > 0 ? fmt::format(", laser plane {}", stripes.plane + 1) : "",
                        stripes.agreeing, counted(stripes.found, "stripe"),
                        noun_of(stripes.agreeing, "lies", "lie"));
  if (quality.cross_validation_ratio)
    text += fmt::format("every other view against the rest: sections differ by {:.2f} times the prediction\n",
                        *quality.cross_validation_ratio);
  else if (result.diagnosis)
    text += "every other view against the rest: not compared, " + result.diagnosis->cross_validation.why_not +
            "\n";
  if (!quality.weakest.empty()) text += "weakest: " + quality.weakest + "\n";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace lightstripe

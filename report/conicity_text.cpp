// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/conicity_text.h"

#include <fmt/format.h>

#include "core/counted.h"
#include "pipeline/conicity_job.h"

namespace lightstripe {

Messages describe_conicity(const Conicity& conicity, const std::filesystem::path& table) {
  Messages out;
  if (conicity.at_3_mm) out.say("tan gamma_e at 3 mm: " + conicity_at_3_mm_text(conicity));
  if (conicity.nonlinearity_per_mm)
    out.say(
        fmt::format("nonlinearity (tan gamma_e at 4 mm less that at 2 mm, over 2 mm; our own "
                    "definition): {:.4f} per mm",
                    *conicity.nonlinearity_per_mm));
  for (const ContactJump& jump : conicity.jumps)
    out.say(fmt::format(
        "the contact of the {} wheel jumps at a shift of {:.2f} mm, on the rail from "
        "{:.1f} to {:.1f} mm",
        jump.side == TrackSide::kLeft ? "left" : "right", jump.shift_mm, jump.from_mm, jump.to_mm));
  if (!conicity.note.empty())
    out.say(fmt::format("the table ends at {:.1f} mm: {}",
                        conicity.rows.empty() ? 0.0 : conicity.rows.back().y_mm, conicity.note));
  if (!conicity.verdict.empty()) out.say("verdict: " + conicity.verdict);
  out.say(fmt::format("{} -> {}", counted(conicity.rows.size(), "amplitude"), table.string()));
  return out;
}

}  // namespace lightstripe

// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/explain_extraction.h"

#include <fmt/format.h>

#include "core/counted.h"

namespace lightstripe {
namespace {

std::string decision(const ExtractionOptions& options, const BilevelThresholds& levels) {
  const ThresholdOptions limits;
  const std::string seen = fmt::format("entropy {:.2f} bits (limit {:.1f}), {} histogram peaks (limit 2)",
                                       levels.entropy, limits.entropy_limit, levels.peaks);
  if (options.alpha) return seen + fmt::format(": alpha {:.2f} as given", levels.alpha);
  return seen + (levels.alpha > 0 ? fmt::format(": disturbing light, alpha {:.2f}", levels.alpha)
                                  : std::string(": no disturbing light, alpha 0"));
}

std::string rule(const ExtractionOptions& options) {
  if (options.thresholds == "auto" || options.thresholds == "bilevel") return "bilevel";
  if (options.thresholds == "otsu" || options.thresholds == "rosin") return options.thresholds;
  return "given";
}

}  // namespace

std::string explain_extraction(const std::string& image, Channel channel, const ExtractionOptions& options,
                               const ExtractionResult& result) {
  const BilevelThresholds& t = result.levels;
  return fmt::format(
      "{}\n"
      "  channel      {}\n"
      "  grey levels  T_min {:g} (background), T_rosin {:g}, T_otsu {:g}, T_max {:g}\n"
      "  decision     {}\n"
      "  thresholds   {}: T_l {:g} (background below), T_h {:g} (foreground above)\n"
      "  noise        {:.2f} grey levels\n"
      "  scale        sigma {:.2f} px = stripe width {:.1f} px{}\n"
      "  found        {}",
      image, enum_name(channel), t.t_min, t.t_rosin, t.t_otsu, t.t_max, decision(options, t), rule(options),
      result.threshold_low, result.threshold_high, result.noise, result.sigma,
      result.sigma * 3.4641016151377544, options.sigma || options.stripe_width ? ", as given" : ", estimated",
      counted(result.stripes.size(), "line"));
}

}  // namespace lightstripe

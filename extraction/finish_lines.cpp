// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/finish_lines.h"

#include <cstdint>

#include "extraction/lines/border_ends.h"
#include "extraction/lines/curvature_bias.h"
#include "extraction/lines/end_cuts.h"
#include "extraction/lines/line_asymmetry.h"
#include "extraction/lines/line_ends.h"
#include "extraction/lines/line_fade.h"
#include "extraction/lines/line_junctions.h"
#include "extraction/lines/line_measure.h"
#include "extraction/lines/line_noise.h"
#include "extraction/lines/line_set.h"
#include "extraction/lines/line_spots.h"
#include "extraction/lines/smoothing.h"

namespace lightstripe {
namespace {

bool has_ridges(ExtractionMethod method) {
  return method != ExtractionMethod::kCentroid && method != ExtractionMethod::kExtremum;
}

bool has_grain(const ExtractionWorkspace& w) { return w.errors.common.grain_px > 0; }

/// On a board the print scatters rows like grain, and edges of the print are no laser's profile.
bool weighs_grain(const ExtractionOptions& options, const ExtractionWorkspace& w) {
  return has_grain(w) && has_ridges(options.method) && !options.on_pattern;
}

/// Where the light has grain, by the weights that are best there.
template <class T>
void recentre(ImageView<T> image, ExtractionWorkspace& w) {
  ErrorWorkspace& errors = w.errors;
  errors.by_kernels = errors.differences;
  errors.common_by_kernels = errors.common;
  for (ScaleGroup& group : w.groups.used()) recentre_lines(image, *group.kernels, group.lines, errors);
  errors.common = common_scatter(errors.differences, errors.common_by_kernels.grain_px);
  errors.next = 0;
}

/// What all lines of the picture tell of its scatter.
template <class T>
void look_at_scatter(ImageView<T> image, const ExtractionOptions& options, ExtractionWorkspace& w) {
  ErrorWorkspace& errors = w.errors;
  errors.differences.clear();
  errors.next = 0;
  for (ScaleGroup& group : w.groups.used()) {
    smooth_measures(*group.kernels, group.lines, w.values);
    look_at_scatter(image, *group.kernels, group.lines, errors);
  }
  errors.common = common_scatter(errors.differences);
  errors.by_kernels.clear();
  if (weighs_grain(options, w)) recentre(image, w);
}

/// Ends, fading light and bends draw the ridges of the kernels aside.
template <class T>
void mend_ridges(ImageView<T> image, const ExtractionOptions& options, const DerivativeKernels& kernels,
                 LineSet& lines, ExtractionWorkspace& w) {
  find_fade_errors(kernels, lines, w.values);
  mend_line_ends(kernels, options.on_pattern ? EndsOnPrint::kYes : EndsOnPrint::kNo, lines, w.ends);
  mend_junctions(image, kernels, lines);
  if (options.curvature_correction) correct_curvature_bias(kernels, lines, w.bends);
}

template <class T>
void finish_group(ImageView<T> image, const ExtractionOptions& options, double noise, ScaleGroup& group,
                  ExtractionWorkspace& w) {
  const DerivativeKernels& kernels = *group.kernels;
  LineSet& lines = group.lines;
  predict_errors(image, kernels, noise, lines, w.errors);
  if (has_ridges(options.method)) mend_ridges(image, options, kernels, lines, w);
  if (weighs_grain(options, w)) recentre_ends(image, kernels, w.errors.common.grain_px, lines, w.end_cuts);
  find_border_errors(image, kernels, lines);
  find_spot_errors(lines, w.values);
  find_binning_errors(kernels.sigma, 1 << group.level, lines);
  if (options.smoothing == Smoothing::kAlways || (options.smoothing == Smoothing::kInGrain && has_grain(w)))
    smooth_along_lines(lines, w.smoothing);
  add_systematic_errors(lines);
  // Last: neither bends nor smoothing may take a bias for scatter.
  add_asymmetry(image, kernels, lines, w.asymmetry);
}

}  // namespace

template <class T>
void finish_lines(ImageView<T> image, const ExtractionOptions& options, double noise,
                  ExtractionWorkspace& workspace) {
  look_at_scatter(image, options, workspace);
  for (ScaleGroup& group : workspace.groups.used()) finish_group(image, options, noise, group, workspace);
}

template void finish_lines<std::uint8_t>(ImageView8, const ExtractionOptions&, double, ExtractionWorkspace&);
template void finish_lines<std::uint16_t>(ImageView16, const ExtractionOptions&, double,
                                          ExtractionWorkspace&);

}  // namespace lightstripe

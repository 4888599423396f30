// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The numbers by which lines are looked for at their own scales, each with its
// unit and its reason.
#pragma once

namespace lightstripe {

struct FollowTuning {
  /// Octaves: a line within this of a scale already in use shares it. A kernel
  /// that is off by a third of an octave costs 4 % in accuracy, and one scale
  /// for all keeps a picture's lines alike.
  double shared_scale = 0.4;
  /// Octaves: a line whose own scale is farther off than this is followed again
  /// at it.
  double refollow_scale = 0.4;
  /// Octaves: the same for the first line of a scale, which decides it for
  /// those that come after.
  double first_scale = 0.07;
  /// Octaves: no line is followed again farther off than this from the scale of
  /// its seed.
  double farthest_scale = 2.0;
  /// Of the strength along a line: up to a grain of `fine_grain` its scale is the stripe's width, from
  /// `coarse_grain` on (speckle of contrast 0.3 and more) twice that, which lowers the scatter by half and
  /// holds the line together over dark grains.
  double fine_grain = 0.05, coarse_grain = 0.13;
  /// Sigma, px: below it a line's strength varies with its place between the pixels, which is no grain.
  double thinnest_grained = 1.3;
  /// Of the brightest pixel: from here on a point may be clipped, and its strength tells nothing of grain.
  double clipped_level = 0.96;
  /// Of the length before: a line followed again must keep so much, else the
  /// first try stands.
  double kept_length = 0.8;
  /// Octaves, and the same for a line whose own scale is finer by more than that: a kernel so broad joins
  /// pieces which lie beside each other, and each of them is met again by a seed of its own.
  double much_finer_scale = 0.5, kept_length_of_finer = 0.3;
  /// Of the least length: what is shorter is no line at this scale, and leaves
  /// its place to other scales. The exact length is judged later on the
  /// measured line.
  double least_length = 0.4;
  /// Of a line's points: where so many have another line within 1.5 sigma, it
  /// is that line seen once more.
  double most_taken = 0.5;
  /// Sigma, px of the binned image: from twice this on the line is followed in
  /// the next coarser level, where it costs a fraction and loses nothing.
  double binned_sigma = 2.0;
  /// Sigma to both sides of a line that was kept (or rejected), in which no
  /// other line begins: its flanks and its glow.
  double blocked_by_line = 3.0, blocked_by_rejected = 1.5;
  /// Of the strongest line's height: seeds with less contrast are not tried.
  /// The filter of whole lines drops what is fainter than lines.min_contrast
  /// anyway.
  double faintest_seed = 0.05;
  /// Widths and heights of the image: more points than this followed in vain
  /// are a crowd of noise, and the search ends.
  double futile_points = 3;
  /// The same once lines are found that are together as long as the picture's shorter side: seeds come by
  /// falling contrast, so that a dozen crumbs in a row are the picture's texture.
  double futile_points_with_line = 1.0;
  /// The same for what is then tried beside the ends of lines, where a line goes on that a gap or a dark
  /// surface interrupts.
  double futile_points_beside_ends = 0.4;
  /// Of the least length, for a line as bright as the strongest: so much is a line that may go on.
  double evident_line = 0.4;
  /// Full widths: so far from a line's end, straight on, its rest may stand out first.
  double widths_beside_end = 12;
  /// Points of following that a seed costs at which no scale shows a line:
  /// about 2 microseconds.
  double futile_seed = 3;
  /// The same for what is tried at both ends of a line before it ends.
  double futile_line = 50;
};

}  // namespace lightstripe

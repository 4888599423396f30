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
  /// Power of a kernel's scale by which it falls, near the stripe's own.
  double grain_falls = 1.2;
  /// Of the picture's main line's strength, at the stripe's own scale: from such a grain on, single grains
  /// may pass for lines and the line for none.
  double main_grain = 0.1;
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
  /// Times the scale that the grain asks for: only a line so long tells its grain well enough to be looked
  /// for from other places where its middle shows nothing at that scale.
  double worth_other_places = 30;
  /// Of the least length: what is shorter is no line at this scale, and leaves
  /// its place to other scales. The exact length is judged later on the
  /// measured line.
  double least_length = 0.4;
  /// Of the least length, times the strongest line's height: a first try below it is looked at no further.
  /// The filter of whole lines asks for nearly three times as much of a line that goes on where another one
  /// ends, for more of others, and a better scale hardly ever adds that much.
  double hopeless = 0.06;
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
  /// After so many without a line of half the picture's shorter side (what is still missing of it) its bright
  /// things hide the line; rows of seeds are looked at then, none shorter than that part of the side.
  double futile_points_of_crowd = 0.3, missing_in_crowd = 0.5, least_chain = 0.15;
  /// What is tried along the rows until one leads to a line, and again from there.
  double futile_points_along_chains = 0.15;
  /// Of the least length, for a line as bright as the strongest: so much is a line that may go on.
  double evident_line = 0.4;
  /// Full widths: so far from a line's end, straight on, its rest may stand out first.
  double widths_beside_end = 12;
  /// Points of following that a seed costs at which no scale shows a line, or from which none can be
  /// followed: about 2 microseconds.
  double futile_seed = 3;
  /// The same for what is tried at both ends of a line before it ends.
  double futile_line = 50;
};

/// The numbers of a single step along a line.
struct StepTuning {
  /// Sigma to both sides of a line that no other one uses: 3.6 stripe standard deviations less what a
  /// crossing line needs to come near.
  double marked = 2.1;
  /// Radians, to both sides: where a line may leave around a corner, up to about a right angle with the next
  /// step's own turn.
  double corner_angle = 0.6, sharp_corner_angle = 1.2;
  /// Of its angle to the image's border: a line that comes to it more steeply ends there, one that runs along
  /// it may come back.
  double leaving_sine = 0.2;
  /// Of the line's recent strength: around a corner the line stays about as strong, beyond a gap it may be
  /// dimmer.
  double corner_strength = 0.2, landing_strength = 0.02;
  /// Sigma, and steps: another line's mask so near ahead disturbs the ridge already.
  double disturbed_by_line = 2, disturbed_by_line_least = 2;
  /// Sigma: how far ahead a line is looked for behind a crossing, which is as long as a line is wide at 20
  /// degrees.
  double farthest_behind_crossing = 14;
  /// Sigma, and as much more as the line is long: a direction taken from a few points says nothing farther
  /// ahead, and crumbs beside a line are tried over and over.
  double farthest_of_first_points = 7;
  /// Sigma from one place to the next there: the smoothed picture holds nothing finer.
  double step_behind_crossing = 1;
  /// Px: how far from the straight way the line may be, growing by a share of the distance up to the most.
  double landing_reach = 0.75, landing_spread = 0.12, most_landing_reach = 2.5;
  /// Cosine of the turn at a landing (23 degrees), and at the point that has to confirm it (11 degrees).
  double landing_cosine = 0.92, confirmed_cosine = 0.98;
  /// Weight of a point's direction in that of the line: of a clear one, and of one in noise.
  double clear_weight = 0.8, noisy_weight = 0.25;
  /// A step: what remains of the strongest recent point, so that a line may fade over some 50 px.
  double remembered_strength = 0.95;
  /// Sigma, and points besides: before a crossing so many points are drawn aside and given up.
  double doubtful = 1.5, doubtful_least = 1;
  /// Points back from there, over which the direction is taken.
  int base_points = 6;
  /// Plain steps before several columns are taken at once; and the share of the recent strength below which
  /// they are taken singly.
  int steady_steps = 3;
  double stride_strength = 0.5;
  /// Sigma, and steps besides: so long a line may be followed on in another one's disturbance.
  double disturbed_steps = 3, disturbed_steps_least = 2;
  /// Points: a line that comes back to its start after fewer is none that is closed.
  int least_closed = 12;
  /// Points, and the share of them that the line must have got on in a straight way; else it curls up on a
  /// spot.
  int curl_window = 8;
  double curl_advance = 0.4;
};
inline constexpr StepTuning kStepTuning;

}  // namespace lightstripe

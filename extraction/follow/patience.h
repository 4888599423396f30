// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How long lines are looked for in one picture: a crowd of crumbs ends the search, the sooner the more of a
// line is found; beside the ends of what was found it goes on.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/stripe.h"
#include "extraction/follow/follow_tuning.h"

namespace lightstripe {

class SearchPatience {
 public:
  /// For a picture of width x height px.
  void reset(int width, int height, const FollowTuning& tuning);

  /// Points that were followed in vain, or what costs as much.
  void add_futile(double points) { futile_ += points; }
  /// A line that is no crumb; `full_width`: of its stripe, px.
  void add_line(std::span<const StripePoint> points, double full_width);

  /// Enough was looked for everywhere.
  bool is_over() const { return futile_ > most(); }
  /// From here on lines begin beside the ends of other ones only, and that is tried for a while.
  void look_beside_ends() { futile_ = most() - beside_ends_; }
  /// Does so where the search is over, and again as long as that finds lines, which have ends of their own.
  template <class TrySeeds>
  void try_beside_ends(const TrySeeds& try_seeds) {
    if (!is_over()) return;
    look_beside_ends();
    for (std::size_t before = 0; before < lines() && !is_over();) {
      before = lines();
      try_seeds();
    }
  }
  /// A part of the search is done, and what was found is no line of some length: what is bright here hides
  /// it.
  bool sees_crumbs_only() const { return !chains_tried_ && futile_ > crowd_ && missing() > most_missing_; }
  /// From here on seeds that lie in a row are tried for a while.
  void look_along_chains() { futile_ = most() - along_chains_; }
  /// Does so once a picture; what it costs does not count in the search for other lines.
  template <class TryChains>
  void try_chains(const TryChains& try_seeds_of_chains) {
    if (chains_tried_) return;
    chains_tried_ = true;
    const double before = futile_;
    look_along_chains();
    try_seeds_of_chains();
    futile_ = before;
  }
  /// Whether a line that begins at (x, y) px may be the rest of one that was found.
  bool is_beside_end(int x, int y) const;
  std::size_t lines() const { return ends_.size() / 2; }

 private:
  struct End {
    double x = 0, y = 0;              ///< px
    double along_x = 0, along_y = 0;  ///< unit, out of the line
    double width = 0;                 ///< px
  };
  bool is_beside(const End& end, int x, int y) const;
  /// Of the picture's shorter side, what is not yet found.
  double missing() const;
  double most() const;

  double futile_ = 0;
  double found_ = 0;             ///< px, length of the lines
  double shorter_ = 0;           ///< px, side of the picture
  double least_ = 0, most_ = 0;  ///< points, with a whole line and with none
  double beside_ends_ = 0, reach_widths_ = 0;
  double crowd_ = 0, along_chains_ = 0, most_missing_ = 1;
  bool chains_tried_ = false;
  std::vector<End> ends_;
};

}  // namespace lightstripe

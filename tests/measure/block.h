// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A block 40 mm wide and 100 mm high as a rail: every distance to it can be computed by hand.
#pragma once

#include "measure/reference_shape.h"
#include "measure/surface_fit.h"

namespace lightstripe {

inline ReferenceShape block_shape() {
  Outline block;
  const Eigen::Vector2d a(-20, -100), b(20, -100), c(20, 0), d(-20, 0);
  block.segments = {line_segment(a, b), line_segment(b, c), line_segment(c, d), line_segment(d, a)};
  return {"block", ObjectKind::kRail, block};
}

/// A section that lies on the block as it is, its points exact.
class OnBlock {
 public:
  OnBlock() { registration.reason.clear(); }
  void add(double u, double v, int sensor = 0) { section.push_back({{u, v}, sensor, sensor, 0, 1}); }
  PlacedSection placed() const { return place(section, shape, registration); }

  Section section;
  Registration registration;

 private:
  ReferenceShape shape = block_shape();
};

}  // namespace lightstripe

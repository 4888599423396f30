// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "core/stripe.h"

namespace lightstripe {

/// One line seen from one of its ends: point 0 is the last one there.
struct EndView {
  std::span<StripePoint> points;
  bool from_back = false;

  std::size_t size() const { return points.size(); }
  /// Of the i-th point from this end, from the line's begin on.
  std::size_t index(std::size_t i) const { return from_back ? points.size() - 1 - i : i; }
  /// The `count` points next to this end, in the line's order.
  std::span<StripePoint> stretch(std::size_t count) const {
    return from_back ? points.last(count) : points.first(count);
  }
  StripePoint& operator[](std::size_t i) const { return points[index(i)]; }
};

}  // namespace lightstripe

// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Random numbers that depend on (seed, stream, index) only, never on the order of calls or on threads.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace lightstripe {

/// SplitMix64's finalizer (Steele, Lea, Flood 2014): a bijection that scatters neighbouring integers.
inline std::uint64_t scatter_bits(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// A stream of numbers; copies are cheap and start where the original stands.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(scatter_bits(seed ^ scatter_bits(stream))) {}

  std::uint64_t bits() { return scatter_bits(state_++); }
  /// In [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal (Box-Muller).
  double gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace lightstripe

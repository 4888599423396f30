// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A measured quantity: its value and 1-sigma error where they are known, else why not.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace lightstripe {

struct Estimate {
  std::optional<double> value;  ///< missing: `reason` says why
  std::optional<double> sigma;  ///< missing where none can be derived
  std::string reason;

  static Estimate known(double value, double sigma) { return {value, sigma, ""}; }
  static Estimate unknown(std::string reason) { return {std::nullopt, std::nullopt, std::move(reason)}; }
};

}  // namespace lightstripe

// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/limits.h"

#include <algorithm>

namespace lightstripe {

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNone:
      return "";
    case Verdict::kPass:
      return "pass";
    case Verdict::kFail:
      return "fail";
    case Verdict::kUnknown:
      return "unknown";
  }
  return "";
}

Bounds bounds_of(const std::string& quantity, const Limits& limits) {
  const std::string_view right = "right_";
  const std::string name = quantity.starts_with(right) ? quantity.substr(right.size()) : quantity;
  Bounds bounds;
  visit_fields(
      [&](std::string_view key, const std::optional<double>& limit) {
        if (key == name + "_min") bounds.low = limit;
        if (key == name + "_max") bounds.high = limit;
      },
      limits);
  return bounds;
}

Verdict judge(const MeasuredFrame& row, const Limits& limits) {
  Verdict verdict = Verdict::kNone;
  for (const auto* list : {&row.estimates, &row.extras})
    for (const NamedEstimate& one : *list) {
      const Bounds bounds = bounds_of(one.name, limits);
      if (!bounds.low && !bounds.high) continue;
      if (!one.estimate.value) {
        if (verdict != Verdict::kFail) verdict = Verdict::kUnknown;
        continue;
      }
      const double value = *one.estimate.value;
      if ((bounds.low && value < *bounds.low) || (bounds.high && value > *bounds.high))
        verdict = Verdict::kFail;
      if (verdict == Verdict::kNone) verdict = Verdict::kPass;
    }
  return verdict;
}

}  // namespace lightstripe

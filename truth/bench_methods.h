// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How long every extraction method takes on one image, after its lines were held against Steger's.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "extraction/options.h"

namespace lightstripe {

inline constexpr std::string_view kOpenCvSteger = "opencv-steger";
/// The same with its planes kept from run to run, as ours keep theirs.
inline constexpr std::string_view kOpenCvStegerKept = "opencv-steger-kept";

struct MethodTime {
  std::string method;
  double median_ms = 0;
  std::size_t points = 0;
  // Of extraction methods only:
  std::optional<double> found;    ///< part of the reference's points that this method finds
  std::optional<double> besides;  ///< part of its own points that the reference does not have
};

struct MethodTimes {
  std::vector<MethodTime> timings;
  std::vector<std::string> disagreeing;  ///< methods that find other lines than Steger's: no fair times
};

/// Our methods, and the same work by OpenCV (bench_references.h), on one thread; medians of `repeat`. Without
/// a width in the options the measured one is fixed for all, as in a scan whose rig is known.
MethodTimes bench_methods(ImageView8 image, ExtractionOptions options, int repeat);

/// A line for people for each method, its speed beside OpenCV's Steger.
std::vector<std::string> describe_times(const MethodTimes& times);

}  // namespace lightstripe

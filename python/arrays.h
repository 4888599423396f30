// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Memory of lightstripe as numpy arrays and the other way round, without a copy where that is possible.
#pragma once

#include <pybind11/numpy.h>

#include <vector>

#include "core/image.h"
#include "core/profile.h"
#include "core/stripe.h"
#include "reconstruct/cloud.h"

namespace lightstripe::python {

namespace py = pybind11;

/// Record arrays with the fields of StripePoint (x, y, normal_x ...) and ProfilePoint (x, y, z, u, v, sigma
/// ...), which look at the memory of `owner` and keep it alive.
py::array view_of(const std::vector<StripePoint>& points, py::handle owner);
py::array view_of(const std::vector<ProfilePoint>& points, py::handle owner);

/// Copies of record arrays of these layouts; ValueError for another layout.
std::vector<StripePoint> stripe_points(const py::array& records);
std::vector<ProfilePoint> profile_points(const py::array& records);

/// An array that takes over the memory of the picture or of the points.
py::array adopted(Image8 image);
py::array adopted(std::vector<CloudPoint> points);

/// Looks at a picture of rows x columns, uint8 or uint16, whose rows are whole in memory (they may lie apart,
/// as those of a crop); ValueError for another layout.
template <class T>
ImageView<T> image_view(const py::array& image);

}  // namespace lightstripe::python

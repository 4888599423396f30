// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture to look at, wherever its pixels lie.
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/image.h"

namespace lightstripe {

/// Pixels of 8 or 16 bits that are its own, or that lie in a file which stays mapped as long as the picture
/// lives.
class Picture {
 public:
  Picture(GreyImage image)  // NOLINT(google-explicit-constructor): an owner is a picture
      : owned_(std::make_shared<const GreyImage>(std::move(image))) {
    std::visit([&](const auto& pixels) { view_ = pixels.view(); }, *owned_);
  }
  Picture(Image8 image) : Picture(GreyImage(std::move(image))) {}   // NOLINT(google-explicit-constructor)
  Picture(Image16 image) : Picture(GreyImage(std::move(image))) {}  // NOLINT(google-explicit-constructor)
  /// Pixels that `keeper` keeps; `cached`: they are in memory already, not on a disk still.
  Picture(ImageView8 view, std::shared_ptr<const void> keeper, bool cached = true)
      : view_(view), keeper_(std::move(keeper)), cached_(cached) {}

  /// Calls use(ImageView8) or use(ImageView16).
  template <class Use>
  decltype(auto) visit(const Use& use) const {
    return std::visit(use, view_);
  }
  /// The picture as an image: its own, or a copy.
  GreyImage image() const {
    if (owned_) return *owned_;
    return visit([](const auto& view) -> GreyImage {
      using Pixel = std::remove_cv_t<std::remove_pointer_t<decltype(view.data)>>;
      Image<Pixel> copy(view.width, view.height);
      for (int y = 0; y < view.height; ++y) std::copy_n(view.row(y), view.width, copy.row(y));
      return copy;
    });
  }
  bool is_mapped() const { return !owned_; }
  bool is_cached() const { return cached_; }

 private:
  std::shared_ptr<const GreyImage> owned_;
  std::variant<ImageView8, ImageView16> view_;
  std::shared_ptr<const void> keeper_;
  bool cached_ = true;
};

}  // namespace lightstripe

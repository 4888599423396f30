// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/binned_image.h"

namespace lightstripe {

template <class T>
void bin_image(ImageView<T> image, int factor, Image<T>& binned) {
  binned.width = image.width / factor;
  binned.height = image.height / factor;
  binned.pixels.resize(static_cast<std::size_t>(binned.width) * static_cast<std::size_t>(binned.height));
  const auto count = static_cast<std::uint32_t>(factor * factor);
  for (int y = 0; y < binned.height; ++y)
    for (int x = 0; x < binned.width; ++x) {
      std::uint32_t sum = count / 2;
      for (int j = 0; j < factor; ++j) {
        const T* row = image.row(y * factor + j) + x * factor;
        for (int i = 0; i < factor; ++i) sum += row[i];
      }
      binned(x, y) = static_cast<T>(sum / count);
    }
}

template void bin_image<std::uint8_t>(ImageView8, int, Image8&);
template void bin_image<std::uint16_t>(ImageView16, int, Image16&);

}  // namespace lightstripe

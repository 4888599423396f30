// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/band_matrix.h"

#include <algorithm>
#include <cstddef>

namespace lightstripe {
namespace {

/// Entries of row i beside the diagonal, inside the matrix.
std::size_t reach_of(const BandMatrix& matrix, std::size_t i) {
  return std::min<std::size_t>(3, matrix.size() - 1 - i);
}

double entry(const BandMatrix& matrix, std::size_t i, std::size_t j) {
  return matrix[std::min(i, j)].at(std::max(i, j) - std::min(i, j));
}

}  // namespace

void factorise(BandMatrix& matrix) {
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    const std::array<double, 4> row = matrix[i];
    const std::size_t reach = reach_of(matrix, i);
    for (std::size_t m = 1; m <= reach; ++m) {
      const double l = row.at(m) / row[0];
      for (std::size_t k = m; k <= reach; ++k) matrix[i + m].at(k - m) -= l * row.at(k);
      matrix[i].at(m) = l;
    }
  }
}

void solve(const BandMatrix& factor, std::span<double> x) {
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t m = 1; m <= reach_of(factor, i); ++m) x[i + m] -= factor[i].at(m) * x[i];
  for (std::size_t i = x.size(); i-- > 0;) {
    x[i] /= factor[i][0];
    for (std::size_t m = 1; m <= reach_of(factor, i); ++m) x[i] -= factor[i].at(m) * x[i + m];
  }
}

void invert(const BandMatrix& factor, BandMatrix& inverse) {
  inverse.assign(factor.size(), {});
  for (std::size_t i = factor.size(); i-- > 0;) {
    const std::size_t reach = reach_of(factor, i);
    // The diagonal last: it needs the row's others.
    for (std::size_t k = reach + 1; k-- > 0;) {
      double value = k == 0 ? 1 / factor[i][0] : 0.0;
      for (std::size_t m = 1; m <= reach; ++m) value -= factor[i].at(m) * entry(inverse, i + m, i + k);
      inverse[i].at(k) = value;
    }
  }
}

}  // namespace lightstripe

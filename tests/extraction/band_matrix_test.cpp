// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Against Eigen's dense solver.
#include "extraction/lines/band_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/random.h"

namespace lightstripe {
namespace {

TEST(BandMatrix, SolvesAndInvertsAsADenseOneDoes) {
  for (const int size : {1, 2, 3, 4, 5, 40}) {
    Random random(static_cast<std::uint64_t>(size), 1);
    const auto n = static_cast<std::size_t>(size);
    BandMatrix matrix(n);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd right(size);
    for (int i = 0; i < size; ++i) {
      right[i] = random.gaussian();
      for (int m = 0; m < 4 && i + m < size; ++m) {
        const double value = m == 0 ? 9 + random.gaussian() : random.gaussian();
        matrix[static_cast<std::size_t>(i)].at(static_cast<std::size_t>(m)) = value;
        dense(i, i + m) = dense(i + m, i) = value;
      }
    }
    std::vector<double> x(right.data(), right.data() + size);
    BandMatrix inverse;
    factorise(matrix);
    solve(matrix, x);
    invert(matrix, inverse);
    const Eigen::VectorXd expected = dense.ldlt().solve(right);
    const Eigen::MatrixXd whole = dense.inverse();
    for (int i = 0; i < size; ++i) {
      EXPECT_NEAR(x[static_cast<std::size_t>(i)], expected[i], 1e-12) << size;
      for (int m = 0; m < 4 && i + m < size; ++m)
        EXPECT_NEAR(inverse[static_cast<std::size_t>(i)].at(static_cast<std::size_t>(m)), whole(i, i + m),
                    1e-12)
            << size;
    }
  }
}

}  // namespace
}  // namespace lightstripe

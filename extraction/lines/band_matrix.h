// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Symmetric positive matrices with three entries beside the diagonal, as third differences along a line have
// them: solved and inverted, as far as the band goes, in a time that grows as their size.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace lightstripe {

/// Rows, each from the diagonal on: [i][m] is the entry (i, i + m). What would lie beyond the last row is 0.
using BandMatrix = std::vector<std::array<double, 4>>;

/// Puts L D L^T in the matrix's place: [i][0] is D's entry, [i][m] that of L at (i + m, i).
void factorise(BandMatrix& matrix);

/// The right-hand side becomes the solution. `factor`: by factorise(), of as many rows.
void solve(const BandMatrix& factor, std::span<double> x);

/// The inverse's entries within the band, by Takahashi's equations (Erisman, Tinney, Commun. ACM 18, 1975):
/// from the last row on, each by those behind it.
void invert(const BandMatrix& factor, BandMatrix& inverse);

}  // namespace lightstripe

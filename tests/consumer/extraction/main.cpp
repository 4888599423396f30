// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Who wants the extraction only links it only.
#include "extraction/extract_stripes.h"

int main() { return lightstripe::extract_stripes(lightstripe::Image8(64, 48)).stripes.empty() ? 0 : 1; }

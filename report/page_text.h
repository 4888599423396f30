// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What our small HTML pages share.
#pragma once

#include <string>

namespace lightstripe {

/// The style sheet of our pages.
std::string page_style();

/// A whole page in our style around its body.
std::string page(const std::string& title, const std::string& body);

}  // namespace lightstripe

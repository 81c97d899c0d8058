// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace crackle {

/// Asks the system to keep arrays that a loop runs through again and again in large pages (2 MiB on x86-64),
/// so that their addresses are looked up seldom. Nothing but speed changes; where it cannot be had nothing
/// happens. A page is taken if a quarter of it belongs to the arrays: small ones that lie close together
/// count together.
void use_large_pages(const std::vector<std::span<const std::byte>>& arrays);

}  // namespace crackle

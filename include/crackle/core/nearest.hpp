// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace crackle {

/// Number of letters to insert, delete, replace or swap with a neighbour to make `b` of `a`
/// (Damerau 1964, restricted: optimal string alignment), case ignored.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The same, but 1 where `name` goes on after `word` with "_...".
std::size_t letters_off(std::string_view word, std::string_view name);

/// The candidate the fewest letters_off() `word`, the first of equals; empty if there is none within `most`.
/// For messages on a misspelt key or law.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates,
                         std::size_t most = std::string_view::npos);

}  // namespace crackle

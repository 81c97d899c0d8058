// SPDX-License-Identifier: GPL-3.0-or-later
#include "crackle/core/nearest.hpp"

#include <algorithm>
#include <vector>

namespace crackle {
namespace {

/// Longer words are cut: a name is short, and the work is the product of the lengths.
constexpr std::size_t longest_name = 64;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Whether a name begins with a word: "length" is rather the beginning of length_mean than a misspelt
/// density.
bool goes_on(std::string_view word, std::string_view name) {
  return !word.empty() && name.size() > word.size() && name[word.size()] == '_' &&
         std::ranges::equal(word, name.substr(0, word.size()), {}, lower, lower);
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  a = a.substr(0, longest_name);
  b = b.substr(0, longest_name);
  std::vector<std::size_t> above2(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(above2, above);
    std::swap(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1])) {
        row[j] = std::min(row[j], above2[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

std::size_t letters_off(std::string_view word, std::string_view name) {
  return goes_on(word, name) ? 1 : edit_distance(word, name);
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates,
                         std::size_t most) {
  std::string_view best;
  std::size_t within = most == std::string_view::npos ? most : most + 1;
  for (const std::string_view candidate : candidates) {
    // The difference in length is a bound that costs nothing.
    const std::size_t a = std::min(word.size(), longest_name), b = std::min(candidate.size(), longest_name);
    if ((a > b ? a - b : b - a) >= within && !goes_on(word, candidate)) continue;
    const std::size_t off = letters_off(word, candidate);
    if (off >= within) continue;
    within = off;
    best = candidate;
  }
  return best;
}

}  // namespace crackle

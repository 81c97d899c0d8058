// SPDX-License-Identifier: GPL-3.0-or-later
// Lines and cells of a table in a text. Private to io.
#pragma once

#include <string_view>
#include <vector>

namespace crackle {

/// The next line of the text, without its line end; the text loses it.
std::string_view take_line(std::string_view& text);

/// The cells of a line, as they stand.
std::vector<std::string_view> split_cells(std::string_view line, char separator);

}  // namespace crackle

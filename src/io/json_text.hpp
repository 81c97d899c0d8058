// SPDX-License-Identifier: GPL-3.0-or-later
// A flat JSON object, written key by key (RFC 8259). Private to io.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace crackle {

class JsonObject {
 public:
  /// A value that is not a finite number becomes null: JSON has neither NaN nor infinity.
  void add(std::string_view key, double value);
  void add(std::string_view key, std::int64_t value);
  void add(std::string_view key, bool value) { add_raw(key, value ? "true" : "false"); }
  void add(std::string_view key, const std::string& text);
  /// The whole object with its line end.
  std::string text() const { return members_ + "\n}\n"; }

 private:
  void add_raw(std::string_view key, const std::string& value);

  std::string members_;
};

}  // namespace crackle

// SPDX-License-Identifier: GPL-3.0-or-later
#include "json_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace crackle {

namespace {

/// Quoted and escaped (RFC 8259, section 7).
std::string quoted(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      json += '\\';
      json += c;
    } else if (c == '\n') {
      json += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      json += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      json += c;
    }
  }
  return json + '"';
}

}  // namespace

void JsonObject::add_raw(std::string_view key, const std::string& value) {
  members_ += fmt::format("{}  \"{}\": {}", members_.empty() ? "{\n" : ",\n", key, value);
}

void JsonObject::add(std::string_view key, double value) {
  add_raw(key, std::isfinite(value) ? fmt::format("{}", value) : "null");
}

void JsonObject::add(std::string_view key, std::int64_t value) { add_raw(key, fmt::format("{}", value)); }

void JsonObject::add(std::string_view key, const std::string& text) { add_raw(key, quoted(text)); }

}  // namespace crackle

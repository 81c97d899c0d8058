// SPDX-License-Identifier: GPL-3.0-or-later
#include "status_json.hpp"

#include <unistd.h>

#include <array>

#include "json_text.hpp"
#include "utc_time.hpp"

namespace crackle {

std::string status_json(const RunStatus& status) {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  JsonObject json;
  json.add("state", status.state);
  json.add("reason", status.reason);
  json.add("time_s", status.time);
  json.add("end_time_s", status.end_time);
  json.add("step", status.step);
  json.add("broken_elements", status.broken);
  json.add("wall_s", status.wall);
  json.add("wall_left_s", status.wall_left);
  json.add("updated", wall_clock());
  json.add("host", std::string(host.data()));
  json.add("process", static_cast<std::int64_t>(getpid()));
  return json.text();
}

}  // namespace crackle

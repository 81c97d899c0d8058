// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr std::streamsize largest_file = 16 << 20;  ///< [byte]; a case has some kilobytes
constexpr std::size_t deepest_include = 16;
constexpr int most_files = 256;

/// @param asked where the file is asked for
std::string read_text(const std::string& path, const Place& asked) {
  const auto refuse = [&](std::string_view reason) {
    fail(asked, asked.line ? fmt::format("cannot include {}: {}", shown(path), reason) : std::string(reason));
  };
  std::error_code error;
  if (fs::is_directory(path, error)) refuse("this is a folder, not a case file");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(fmt::format("cannot be read: {}", std::strerror(errno ? errno : EIO)));
  std::string text;
  std::vector<char> block(1 << 16);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (std::ssize(text) > largest_file) refuse("too large for a case file (over 16 MiB)");
  }
  return text;
}

void set_layer(TomlNode& node, int layer) {
  node.place.layer = node.key_place.layer = layer;
  for (TomlNode& child : node.children) set_layer(child, layer);
}

/// Tables are merged, anything else is replaced.
void merge(TomlNode& below, TomlNode&& above) {
  for (TomlNode& child : above.children) {
    TomlNode* old = below.find(child.key);
    if (!old) {
      below.children.push_back(std::move(child));
    } else if (old->kind == TomlNode::Kind::table && child.kind == TomlNode::Kind::table) {
      merge(*old, std::move(child));
    } else {
      *old = std::move(child);
    }
  }
  below.place = above.place;
  below.key_place = above.key_place;
}

class Loader {
 public:
  TomlNode file(const std::string& path, const Place& asked) {
    std::error_code error;
    const std::string identity = fs::weakly_canonical(path, error).string();
    const auto seen = std::ranges::find(open_, identity, &Open::identity);
    if (seen != open_.end()) {
      std::string chain;
      for (auto at = seen; at != open_.end(); ++at) chain += at->path + " -> ";
      fail(asked, "files include each other: " + chain + path);
    }
    if (open_.size() > deepest_include || ++files_ > most_files) fail(asked, "too many included files");
    return text(read_text(path, asked), path, identity);
  }

  TomlNode text(const std::string& content, const std::string& path, const std::string& identity) {
    TomlNode own = parse_toml(content, path);
    open_.push_back({path, identity});
    TomlNode merged = includes(own, fs::path(path).parent_path());
    open_.pop_back();
    set_layer(own, ++layer_);
    merge(merged, std::move(own));
    return merged;
  }

 private:
  struct Open {
    std::string path;
    std::string identity;
  };

  /// The included files of a tree, merged in their order; takes `include` out of the tree.
  TomlNode includes(TomlNode& own, const fs::path& folder) {
    TomlNode merged;
    const TomlNode* include = own.find("include");
    if (!include) return merged;
    const bool list = include->kind == TomlNode::Kind::array;
    for (const TomlNode& name : list ? include->children : std::vector<TomlNode>{*include}) {
      if (name.kind != TomlNode::Kind::text) {
        fail(name.place,
             fmt::format("include must be a file name or a list of them, not {}", kind_name(name.kind)));
      }
      if (name.text.empty()) fail(name.place, "include names no file");
      if (name.text.find('\0') != std::string::npos) fail(name.place, "a file name cannot hold a zero byte");
      merge(merged, file((folder / name.text).string(), name.place));
    }
    std::erase_if(own.children, [](const TomlNode& child) { return child.key == "include"; });
    return merged;
  }

  std::vector<Open> open_;  ///< the chain of files that are being read
  int files_ = 0;
  int layer_ = 0;
};

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// The table or row that `part` names in `node`; made if it is not there.
TomlNode& step_into(TomlNode& node, const std::string& part, bool is_row, const Place& place) {
  TomlNode fresh{.key = part, .key_place = place, .place = place};
  if (node.kind == TomlNode::Kind::array) {
    const bool digits =
        !part.empty() && part.size() < 7 && part.find_first_not_of("0123456789") == std::string::npos;
    const std::size_t row = digits ? std::stoul(part) : 0;
    if (!digits || row > node.children.size()) {
      fail(place,
           fmt::format("\"{}\" is no row: write 0 to {} after a list of tables", part, node.children.size()));
    }
    fresh.key.clear();
    if (row == node.children.size()) node.children.push_back(fresh);
    return node.children[row];
  }
  if (node.kind != TomlNode::Kind::table)
    fail(place, fmt::format("\"{}\" is a value, not a table", node.key));
  if (TomlNode* child = node.find(part)) return *child;
  if (is_row) fresh.kind = TomlNode::Kind::array;
  node.children.push_back(fresh);
  return node.children.back();
}

}  // namespace

TomlNode load_case_file(const std::string& path) { return Loader().file(path, {path, 0, 0, 0}); }

TomlNode load_case_text(const std::string& text, const std::string& name) {
  std::error_code error;
  return Loader().text(text, name, std::filesystem::weakly_canonical(name, error).string());
}

void apply_override(TomlNode& root, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  const auto trim = [](std::string text) {
    text.erase(0, text.find_first_not_of(" \t"));
    text.erase(text.find_last_not_of(" \t") + 1);
    return text;
  };
  const std::string path = trim(assignment.substr(0, equals));
  const Place place{"--set " + path, 0, 0, std::numeric_limits<int>::max()};
  if (equals == std::string::npos || path.empty()) fail(place, "write --set table.key=value");
  if (path == "include") fail(place, "include can only be written in a case file");
  const std::vector<std::string> parts = split(path);
  if (parts.size() > deepest_include) fail(place, "a key of too many parts");
  TomlNode* node = &root;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    const bool row_follows =
        !parts[i + 1].empty() && std::isdigit(static_cast<unsigned char>(parts[i + 1][0]));
    node = &step_into(*node, parts[i], row_follows, place);
  }
  TomlNode value = parse_toml_value(trim(assignment.substr(equals + 1)), place);
  TomlNode& target = step_into(*node, parts.back(), false, place);
  value.key = target.key;
  target = std::move(value);
}

}  // namespace crackle

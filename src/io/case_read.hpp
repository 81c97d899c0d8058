// SPDX-License-Identifier: GPL-3.0-or-later
// From a tree to a Case: each key by its line of the table in case_schema.cpp. Private to io.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "crackle/io/case.hpp"
#include "toml_tree.hpp"

namespace crackle {

/// Where the keys of a case were given: "rock.density", "fluid.pump.0.rate", "fluid.pump".
class GivenKeys {
 public:
  void add(const std::string& path, const Place& place) { places_[path] = place; }
  void set_file(const std::string& file) { file_.file = file; }
  bool has(const std::string& path) const { return places_.contains(path); }
  /// Of the key; of the table it belongs to if the case leaves the key out; else the file alone.
  Place place(std::string path) const;
  /// Of the key that was given in the highest layer, the first of equals: the one to change.
  Place latest(std::initializer_list<std::string_view> paths) const;

 private:
  std::map<std::string, Place> places_;
  Place file_;
};

/// A case as its file says it, each value in its range, and where it says so.
struct ReadCase {
  Case scene;
  GivenKeys given;
};

/// Refuses keys that contradict one another, and fills in the defaults that follow from other keys.
/// @throws CaseError
void finish_case(ReadCase& read);

/// The part of finish_case() on [[joints]] and [[joint_sets]], after all other defaults.
void finish_joints(ReadCase& read);

/// Gives every layer what it does not say itself, before defaults are filled in.
void inherit_rock(ReadCase& read);
/// The part of finish_case() on [[layers]], after all other defaults.
void finish_layers(ReadCase& read);

/// A path in a case file, made absolute: relative to that file, one given to --set to the working folder.
std::string resolved_path(const std::string& path, const Place& place);

}  // namespace crackle

// The keys, in one table: what they do is looked up here, and shown from here.
#pragma once

#include <optional>
#include <span>

#include "src/viewer/window.h"

namespace stipple {

enum class Command {
  method_unstructured,
  method_hierarchical,
  method_hybrid,
  method_brute_force,
  method_lod,
  method_subsample,
  split,
  blink,
  two_eyes,
  compare,
  again,
  freeze,
  boxes,
  home,
  view_top,
  view_bottom,
  view_front,
  view_back,
  view_left,
  view_right,
  next_color,
  larger_points,
  smaller_points,
  larger_splats,
  smaller_splats,
  shade,
  hide_class,
  clear_picks,
  panel,
  keys,
  record,
  replay,
  screenshot,
  build_tree,
  copy_command,
  cancel,
  quit,
};

struct KeyEntry {
  const char* keys;  // as shown
  const char* what;
  std::optional<Command> command{};  // none: the mouse, or keys that are held
  int key = 0;                       // as GLFW numbers it; 0: none
  bool control = false;
  int character = 0;  // typed, whatever the keyboard's layout; 0: none
};

// In the order in which they are shown.
std::span<const KeyEntry> key_table();

// What this key or character means.
std::optional<Command> command_of(const InputEvent& event);

}  // namespace stipple

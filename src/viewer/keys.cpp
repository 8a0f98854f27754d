#include "src/viewer/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

namespace stipple {
namespace {

constexpr auto kTable = std::to_array<KeyEntry>({
    {"left drag", "turn around the pivot"},
    {"right drag", "move with the points (also shift and left)"},
    {"middle drag", "look around (also alt and left)"},
    {"wheel", "towards what is under the cursor, and away"},
    {"double click", "turn around this point from now on"},
    {"divider", "drag it; F1 to F6 with shift are for the right side"},
    {"click", "what point this is; two give their distance"},
    {"W S A D", "fly ahead, back, left, right; as fast as it is far"},
    {"E Q", "fly up and down"},
    {"H", "the whole cloud again", Command::home, GLFW_KEY_HOME, false, 'h'},
    {"1 2", "from above, from below", Command::view_top, 0, false, '1'},
    {"", "", Command::view_bottom, 0, false, '2'},
    {"3 4", "from the front (south), from behind", Command::view_front, 0, false, '3'},
    {"", "", Command::view_back, 0, false, '4'},
    {"5 6", "from the left (west), from the right", Command::view_left, 0, false, '5'},
    {"", "", Command::view_right, 0, false, '6'},
    {"F1", "method unstructured", Command::method_unstructured, GLFW_KEY_F1},
    {"F2", "method hierarchical", Command::method_hierarchical, GLFW_KEY_F2},
    {"F3", "method hybrid", Command::method_hybrid, GLFW_KEY_F3},
    {"F4", "method brute force", Command::method_brute_force, GLFW_KEY_F4},
    {"F5", "method lod", Command::method_lod, GLFW_KEY_F5},
    {"F6", "method subsample", Command::method_subsample, GLFW_KEY_F6},
    {"V", "two methods side by side, one camera", Command::split, 0, false, 'v'},
    {"B", "of two methods the left one, the right one, both", Command::blink, 0, false, 'b'},
    {"Y", "two eyes side by side, for stereo displays", Command::two_eyes, 0, false, 'y'},
    {"G", "difference to the reference, the reference, the picture", Command::compare, 0, false, 'g'},
    {"N", "draw this view anew, from nothing", Command::again, 0, false, 'n'},
    {"F", "keep these points and no others, to look at them from outside", Command::freeze, 0, false, 'f'},
    {"O", "boxes of what the method draws from", Command::boxes, 0, false, 'o'},
    {"C", "colour by the next attribute", Command::next_color, 0, false, 'c'},
    {"+ -", "larger points, smaller points", Command::larger_points, 0, false, '+'},
    {"", "", Command::smaller_points, 0, false, '-'},
    {"] [", "near points as larger round splats, as smaller ones or none", Command::larger_splats, 0, false, ']'},
    {"", "", Command::smaller_splats, 0, false, '['},
    {"K", "hide the class of the picked point; without one, show all", Command::hide_class, 0, false, 'k'},
    {"L", "eye-dome lighting: shape by depth", Command::shade, 0, false, 'l'},
    {"X", "forget the picked points", Command::clear_picks, 0, false, 'x'},
    {"P", "show or hide the panel", Command::panel, 0, false, 'p'},
    {"R", "record a camera path, and write it", Command::record, 0, false, 'r'},
    {"T", "fly the path recorded last, or that of --camera", Command::replay, 0, false, 't'},
    {"F12", "screenshot, when nothing is left to draw", Command::screenshot, GLFW_KEY_F12},
    {"U", "build an octree of the open files, beside them", Command::build_tree, 0, false, 'u'},
    {"Ctrl C", "copy the command that renders this view", Command::copy_command, GLFW_KEY_C, true},
    {"Esc", "cancel loading or building, close this list", Command::cancel, GLFW_KEY_ESCAPE},
    {"?", "this list", Command::keys, 0, false, '?'},
    {"Ctrl Q", "quit", Command::quit, GLFW_KEY_Q, true},
});

}  // namespace

std::span<const KeyEntry> key_table() {
  return kTable;
}

std::optional<Command> command_of(const InputEvent& event) {
  for (const KeyEntry& entry : kTable) {
    if (!entry.command) continue;
    const bool control = (event.modifiers & GLFW_MOD_CONTROL) != 0;
    if (event.kind == InputEvent::Kind::key && entry.key != 0 && entry.key == event.code && control == entry.control)
      return entry.command;
    if (event.kind == InputEvent::Kind::character && entry.character != 0 &&
        (entry.character == event.code || entry.character == event.code + ('a' - 'A')))
      return entry.command;
  }
  return std::nullopt;
}

}  // namespace stipple

// What lies over the picture beside the panel: marks, the divider's names, the last note, the list of keys.
#pragma once

#include "src/viewer/panel.h"

namespace stipple {

void show_overlays(const PanelFacts& facts, PanelWishes& wishes);

}  // namespace stipple

// The parts of the panel that write files: pictures of any size, and octrees.
#pragma once

#include "src/viewer/panel.h"

namespace stipple {

void show_pictures(const PanelFacts& facts, PanelWishes& wishes);
// What there is to build, or how far it is.
void show_building(const PanelFacts& facts, PanelWishes& wishes);

}  // namespace stipple

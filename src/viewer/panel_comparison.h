// The parts of the panel that look at how a picture comes about: what is selected for it, and how far it is.
#pragma once

#include "src/viewer/panel.h"

namespace stipple {

// Freezing, and which boxes mean what.
void show_selection(const PanelFacts& facts, PanelWishes& wishes);
// What the colours of the difference mean, and the error of each side over time.
void show_comparison(const PanelFacts& facts, PanelWishes& wishes);

}  // namespace stipple

// Several pictures in one, as engines return them: drawn with their names, or taken apart into channels.
#pragma once

#include "petzval/defocus.h"
#include "petzval/develop.h"
#include "petzval/image.h"

#include <string>
#include <vector>

namespace petzval::cli {

// A picture as it is shown, display-linear: what may be drawn on before it is written.
Picture shown(const Picture& light, const DevelopSettings& settings);

// All panels, display-linear. Light is developed; numbers become colours that colour-blind readers tell
// apart: 0 white, below it blues, above it oranges, four tones of each in turn, no number black.
Picture drawn_panels(const Picture& atlas, const std::vector<Panel>& panels, const DevelopSettings& settings);

// "LEVEL 0: 960 x 540 at 0,0; …"
std::string places_of(const std::vector<Panel>& panels);

struct PanelPlane {
    std::string channel;
    Plane values;
};
// Channels of one picture that hold what the panels show; none if one of them names no layer.
std::vector<PanelPlane> planes_of(const Picture& atlas, const std::vector<Panel>& panels);

}  // namespace petzval::cli

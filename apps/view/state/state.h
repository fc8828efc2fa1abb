// All that is chosen in the window. Changed by commands alone (commands.h); pictures follow from it.
#pragma once

#include "live_scene.h"
#include "timeline.h"
#include "view.h"

#include <array>
#include <optional>
#include <string>

namespace petzval::view {

enum class Channel { Colour, Red, Green, Blue, Alpha };

// Content of one side of the window.
struct Side {
    std::string shown = "result";  // one of shown_names()
    std::string engine;            // another than the look's; empty: the look's
    bool on_cpu = false;           // in place of the session's device

    bool operator==(const Side&) const = default;
};

struct State {
    Choice choice;
    Side left, right;  // right: beyond the wipe
    Timeline timeline;
    Orbit orbit;  // of a scene's camera
    CameraPath path;
    bool following = false;  // the focus stays on what the scene is about
    bool wiping = false;
    double wipe = 0.5;  // where, share of the canvas's width
    Channel channel = Channel::Colour;
    bool overlay = false;  // what is in focus, near and far, tinted
    bool final_quality = false;
    bool opening = false;                            // a file is being chosen
    bool help = false, panels = true, lens = false;  // lens: in section, with its discs
    // A place in the disc of the picked pixel, pixels from its middle: rays that land there are lit.
    std::optional<std::array<double, 2>> lit;
    double zoom = 0;                    // display pixels per pixel of the picture; 0: all of it fits
    double centre_x = 0, centre_y = 0;  // of what is seen, in pixels of the frame; where zoom > 0
    std::optional<PixelPosition> pick;  // what was clicked last, in pixels of the frame
};

}  // namespace petzval::view

// Pictures that explain the result: maps of the blur, panels with intermediate pictures of an engine, and
// their captions.
#pragma once

#include "petzval/develop.h"
#include "petzval/engine_report.h"
#include "petzval/image.h"

#include <string>
#include <vector>

namespace petzval {

// Two display-linear pictures of the blur, 0…1, of the same size as `coc_radius_px` (signed, + is far; NaN:
// no surface, drawn black).
//
// Both use blue for near and orange for far, a pair that people with any common form of colour blindness
// distinguish (after Okabe and Ito, "Color universal design", 2008). Both have a legend unless the picture
// is too small. The overlay shows `display`, itself a display-linear picture, dimmed and tinted, with
// surfaces in focus in white. The map is black where the radius is 0 and has full colour at the largest
// radius. Radii below permissible_radius_px count as in focus.
Picture focus_overlay(View<const Rgba> display, View<const float> coc_radius_px, float permissible_radius_px,
                      const std::string& title);
Picture coc_map(View<const float> coc_radius_px, const std::string& title);
// Their blue and orange, display-linear: sRGB #2b8fe0 and #f39c12.
inline constexpr Rgba kNearColour{0.024f, 0.275f, 0.745f, 1}, kFarColour{0.896f, 0.332f, 0.006f, 1};

// A picture as displayed, display-linear, to be drawn on before it is written.
Picture shown(const Picture& light, const DevelopSettings& settings);

// The display-linear colour of a panel's number, also for colour-blind readers: 0 is white, numbers below
// are blue, above orange, in four alternating tones; NaN is black.
Rgba colour_of_number(float number);
// All panels, display-linear: light is developed, numbers become colours, and every panel has its name.
Picture drawn_panels(const Picture& atlas, const std::vector<Panel>& panels, const DevelopSettings& settings);

// "LEVEL 0: 960 x 540 at 0,0; …"
std::string places_of(const std::vector<Panel>& panels);

struct PanelPlane {
    std::string channel;  // name in a file: "layer.R"
    Plane values;
};
// Channels of one picture with the content of the panels; empty if a panel names no layer.
std::vector<PanelPlane> planes_of(const Picture& atlas, const std::vector<Panel>& panels);

// Small letters drawn into a picture: capitals, digits and a few signs, 5 x 7 pixels times scale >= 1. The
// top left corner is at (x0, y0); parts outside the picture are not drawn.
void draw_text(View<Rgba> picture, int x0, int y0, const std::string& text, int scale, Rgba colour);
int text_width_px(const std::string& text, int scale);
int text_height_px(int scale);

// Errors of 0…1 as a heat map, display-linear: black below a tenth of a code of 255, then blue, orange and
// white on a logarithmic scale, with a legend in codes unless the picture is too small; the places are
// outlined and numbered from 1.
Picture heat_map(View<const float> error, const std::vector<Rect>& places);

// Each pixel is the mean light of the pixels that it covers; a larger picture repeats pixels.
Picture resized(const Picture& from, int width, int height);
// A caption at the top left of a picture, display-linear, as large as its width allows.
void draw_caption(View<Rgba> picture, const std::string& text);
// Pictures of one size beside each other with thin black gaps, row by row. columns 0: a sheet about as wide
// as high. Requires: a picture.
Picture contact_sheet(const std::vector<Picture>& cells, int columns = 0);

}  // namespace petzval

// Makes and writes each view: EXR covers the data window of the input, PNG its display window.
#pragma once

#include "petzval/defocus.h"
#include "petzval/depth.h"
#include "petzval/develop.h"
#include "petzval/display_files.h"
#include "petzval/files.h"
#include "petzval/image.h"
#include "petzval/look.h"
#include "petzval/result.h"
#include "petzval/shot_run.h"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace petzval::sequence {

struct ViewSource {
    Plane coc_radius_px;        // for Coc and Focus; for Beauty where its channels hold radii, and no light
    std::vector<Panel> panels;  // for Levels, Layers, Highlights
    DeepPicture hidden;         // for Hidden
    // For Beauty as PNG: its display window developed. Empty: the frame's colour is still to be.
    std::vector<std::uint16_t> codes;
};

struct ViewSettings {
    std::string output;
    bool overwrite = true;
    DevelopSettings develop;
    // Display transform of Beauty as PNG, as in ShotRunHost; may be empty.
    std::function<Status(Picture&, DevelopSettings&, std::string&, std::vector<std::string>&)> to_display;
    std::function<void(const std::string&)> note;
    FoundCamera camera;
    double permissible_radius_px = 1;
    DepthReport depth;
    std::vector<std::pair<std::string, std::string>> attributes;  // of an EXR
    std::vector<std::pair<std::string, std::string>> png_texts;
    std::vector<const Frame*> other_views;         // of the same file, written beside it
    std::vector<std::string>* warnings = nullptr;  // what writing had to change
};

// The number that an engine put into every channel.
Plane red_of(const Picture& picture);
// The picture of this look holds radii there.
bool shows_radii(const Look& look);

// `frame` holds what the engine made where is_rendered(view), else the sharp colour, and planar depth. It is
// used up. Errors: OutputFailed.
Status write_view(ShotView view, Frame& frame, const ViewSource& source, const ViewSettings& settings);

}  // namespace petzval::sequence

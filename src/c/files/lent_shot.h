// A shot of ours as C hosts read it: a petzval_shot that points into our pictures.
#pragma once

#include "petzval/petzval_c.h"
#include "petzval/shot.h"

#include <string>
#include <vector>

namespace petzval::c {

// Requires: it is filled once and stays where it is, as the shot points into it.
struct LentShot {
    petzval_shot shot{};
    petzval_pixels colour{};
    petzval_plane depth{}, mask{};
    petzval_camera camera{};
    petzval_deep deep{}, behind{}, holdout{};
    std::vector<petzval_light> lights;
    std::vector<petzval_pixels> layer_colours;
    std::vector<petzval_layer> layers;
    std::vector<const petzval_layer*> layer_pointers;

    LentShot() = default;
    LentShot(const LentShot&) = delete;
    LentShot& operator=(const LentShot&) = delete;
    // The shot is borrowed. Camera numbers that are missing are 0.
    void fill(const Shot& from);
};

petzval_pixels pixels_of(const Picture& picture);

}  // namespace petzval::c

// An engine's view of a frame: samples, windows, the mounted lens, its own options, services. It edits none
// of them; memory that it may take is moved in beside (Spare).
#pragma once

#include "petzval/image.h"
#include "petzval/light_point.h"

#include "base/parallel.h"
#include "base/progress.h"
#include "engine/waist/coc_samples.h"
#include "engine/waist/lens_on_picture.h"
#include "engine/waist/options.h"

#include <cstddef>
#include <span>
#include <vector>

namespace petzval::device {
class Canvas;
class Device;
class Memory;
}  // namespace petzval::device

namespace petzval::engine {

// Another picture of the same things, drawn alike. Light: a share of the picture's; else of its coverage.
struct SampleLayer {
    View<const Rgba> colour;
    bool is_light = true;
    bool marks_guesses = false;  // alone, in place of `colour`: 1 where a surface was guessed, else 0
};

// Background of a picture without the objects in front; then Samples::deep holds them both. Empty: no plate.
struct CleanPlate {
    View<const Rgba> colour;
    View<const float> coc_px;
    View<const unsigned char> is_stated;  // 0: the picture's own pixel, of which the plate says nothing
    static constexpr unsigned char kOutOfSight = 2;  // of is_stated: no ray through the lens reaches it
    bool covers = true;  // the frame or a crop of it; else it is patches, such as what other frames show
    bool empty() const { return coc_px.empty(); }
    bool is_out_of_sight(int x, int y) const { return is_stated(x, y) == kOutOfSight; }
    CleanPlate part(const Rect& r) const {
        return {colour.part(r), coc_px.part(r), is_stated.part(r), covers};
    }
};

// The rendered input, with radii instead of depths. All pictures have one size.
struct Samples {
    View<const Rgba> colour;   // premultiplied; the front view of `deep` where that is given
    View<const float> coc_px;  // signed radius, + behind focus
    // If `colour` is a layer of a picture: that picture. Empty otherwise.
    View<const Rgba> picture;
    bool is_light = true;  // of a layer: as in SampleLayer
    // Every sample of every pixel, when more is known than its front view (deep files, hidden layers); then
    // colour and coc_px are not all there is to hit. Empty otherwise.
    CocSamplesView deep;
    // Meaning of a coverage below 1 in `deep`. True: as in deep files, each sample dims the samples behind it
    // in its pixel, like thin fog. False: it is the share of the pixel's area that a surface fills, and
    // others lie beside it.
    bool deep_dims_itself = false;
    CleanPlate plate;
    // Light that lands in a pixel is dimmed by these samples of that pixel that lie in front of where it came
    // from (engine/waist/holdout.h). Coverages as in deep files: each sample dims what is behind it. Empty:
    // none.
    CocSamplesView holdout;
    std::vector<SampleLayer> layers;                // for engines that take them
    std::span<const LightPoint> points;             // checked; coc_px holds the radius of each
    View<const float> depth_m;                      // planar, may hold misses; empty where radii were given
    float nearest_coc_px = 0, farthest_coc_px = 0;  // smallest and largest radius anywhere in the frame

    // The picture that decisions look at, so that those of all layers agree.
    View<const Rgba> judged() const { return picture.empty() ? colour : picture; }
    // True if `deep` states every surface, apart in every pixel: of a deep file, of hidden layers. A plate
    // leaves the visible ones as they are.
    bool are_stated() const { return !deep.empty() && plate.empty(); }
    // True if hidden surfaces are given: by a deep file, by hidden layers, by a plate that covers the frame.
    bool are_hidden_stated() const { return !deep.empty() && plate.covers; }
    // The plate, where it does not cover the frame; else empty.
    CleanPlate patches() const { return plate.covers ? CleanPlate{} : plate; }
    // Rows y0…y1-1 alone.
    Samples rows(int y0, int y1) const;
};

// Edges of the picture that are merely where the render stopped (the scene continues beyond them), as
// against edges of a data window inside the frame, beyond which there is nothing.
struct OpenEdges {
    bool left = true, top = true, right = true, bottom = true;
};

struct EngineView;

// The visible part of the frame.
struct SeenWindow {
    OpenEdges open_edges;
    // The view that this is a part of, for facts about the whole frame; null: this is all of it.
    const EngineView* whole = nullptr;
};

class KeptSurfaces;  // engine/samples/kept_surfaces.h
struct Services {
    const device::Device* device = nullptr;  // what draws; never null
    // Memory that may outlive this frame, for this lens, size and quality; never null.
    device::Memory* memory = nullptr;
    KeptSurfaces* surfaces = nullptr;  // of the pictures of earlier frames; null: none are kept
    Workers* workers = &one_thread();  // never null
    Progress* progress = nullptr;      // never null
    std::size_t max_memory_bytes = 0;
    std::size_t beside_bytes = 0;  // of the same limit, what others hold while the engine runs
};

struct EngineView {
    Samples samples;
    SeenWindow window;
    LensOnPicture lens;
    EngineOptions options;
    Services services;

    int width() const { return samples.colour.width(); }
    int height() const { return samples.colour.height(); }
    const EngineView& all() const { return window.whole ? *window.whole : *this; }
    // Rows y0…y1-1 as a separate view, while this one lasts. The edges towards the other rows count as open.
    EngineView rows(int y0, int y1) const;
};

// Memory that an engine may put its result in, or give back early, once it no longer reads its contents:
// the pictures that Samples::colour and Samples::coc_px show. Empty: none.
struct Spare {
    Picture colour;
    Plane coc_px;
};

// Every sample that is stated: those of deep, or the one of each pixel.
CocSamples stated_samples(const Samples& samples);

}  // namespace petzval::engine

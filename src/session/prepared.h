// Prepares an engine's view of a requested frame: checks, circles of confusion, samples.
#pragma once

#include "petzval/camera.h"

#include "engine/samples/behind/plate.h"
#include "engine/waist/view.h"
#include "session/request.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

// The radius of every pixel of a depth plane: by the camera, or as given.
class Radii {
public:
    // Errors: those of CircleOfConfusion::make.
    static Result<Radii> make(const FrameRequest& request);
    float operator()(float depth) const;
    // Depths instead of radii that the controls did not change.
    DeepPicture with_depths(DeepPicture of_radii) const;
    float at_infinity_px() const;  // 0 where radii are given
    Plane of(View<const float> depth, Workers& workers) const;

private:
    std::optional<CircleOfConfusion> coc_;
};

// Errors: InvalidArgument naming what is wrong with the sizes, windows or numbers of a request.
Status check_request(const FrameRequest& request);

// An engine's view of a whole frame. Stays where it was made: the view points into it.
class PreparedFrame {
public:
    // lens_reach_px: how far light of a point with a radius of one pixel lands. Requires: check_job(request),
    // request.workers.
    PreparedFrame(const FrameRequest& request, const Radii& radii, double lens_reach_px);
    PreparedFrame(const PreparedFrame&) = delete;
    PreparedFrame& operator=(const PreparedFrame&) = delete;

    engine::EngineView view;
    engine::Spare spare;  // radii that the view shows
    std::vector<std::string> warnings;

private:
    void take_samples(const FrameRequest& request, View<const float> depth, const Radii& radii,
                      double lens_reach_px);
    void note_radii();
    void place_in_field(const FrameRequest& request);
    void take_options(const FrameRequest& request);

    Picture repaired_;  // stays empty for a picture that needs no repair
    std::vector<Picture> repaired_layers_;
    engine::CocSamples samples_, holdout_;
    engine::BackPicture plate_;
    std::vector<LightPoint> points_;
};

}  // namespace petzval

// From a job as a user states it to the input of an engine: checks, circles of confusion, samples.
#pragma once

#include "petzval/camera.h"
#include "petzval/defocus.h"

#include "engine/samples/plate.h"
#include "engine/waist/engine.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

// Whether radii are given instead of depth, and the plane of either.
inline bool has_radii(const DefocusJob& job) { return job.depth_is_coc || !job.coc_px.empty(); }
inline View<const float> depth_or_radii(const DefocusJob& job) {
    return job.coc_px.empty() ? job.depth_m : job.coc_px;
}

// The radius of every pixel of a depth plane: by the camera, or as given.
class Radii {
public:
    // Errors: those of CircleOfConfusion::make.
    static Result<Radii> make(const DefocusJob& job);
    float operator()(float depth) const;
    // Depths in place of radii, which the controls left as they were.
    DeepPicture with_depths(DeepPicture of_radii) const;
    float at_infinity_px() const;  // 0 where radii are given
    Plane of(View<const float> depth, Workers& workers) const;

private:
    std::optional<CircleOfConfusion> coc_;
};

// Errors: InvalidArgument naming what is wrong with the sizes, windows or numbers of a job.
Status check_job(const DefocusJob& job);

// What an engine sees of a whole frame. Stays where it was made: the view points into it.
class PreparedFrame {
public:
    // lens_reach_px: how far light of a point with a radius of one pixel lands. Requires: check_job(job),
    // job.workers.
    PreparedFrame(const DefocusJob& job, const Radii& radii, double lens_reach_px);
    PreparedFrame(const PreparedFrame&) = delete;
    PreparedFrame& operator=(const PreparedFrame&) = delete;

    engine::EngineView view;
    engine::Spare spare;  // radii that the view shows
    // Whether the view shows the picture that the job's owner no longer needs.
    bool shows_spent = false;
    std::vector<std::string> warnings;

private:
    void take_samples(const DefocusJob& job, const Radii& radii, double lens_reach_px);
    void note_radii();
    void place_in_field(const DefocusJob& job);
    void take_options(const DefocusJob& job);

    Picture repaired_;  // stays empty for a picture that needs no repair
    std::vector<Picture> repaired_layers_;
    engine::CocSamples samples_, holdout_;
    engine::BackPicture plate_;
    std::vector<LightPoint> points_;
};

}  // namespace petzval

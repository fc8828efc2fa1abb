// Measures the steadiness of moving pictures: shots of several frames, and how the error of each frame
// changes to the next. Shared by the test and by `./dev bench flicker`.
//
// A constant error is not seen to move. Its change is seen: d = e(t+1) - e(t), e = result - truth, in linear
// light clipped to 0…1:
//   error_db   -20 log10 rms(e) over all pixels and frames
//   change_db  the same of d
//   worst_pop  the largest mean of d over 8 x 8 pixels and three channels: how much a patch changes from one
//              frame to the next beyond the change of the truth
//   shake      rms of the second difference in time of the result against that of the truth; 1 is as smooth
#pragma once

#include "petzval/defocus.h"
#include "petzval/scene.h"
#include "petzval/seen_elsewhere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace petzval::flicker {

struct Steadiness {
    double error_db = 0, change_db = 0, worst_pop = 0, shake = 0;
    int frame = 0, x = 0, y = 0;  // of the worst pop: from `frame` to the next, in the block at x, y
};

using Frames = std::vector<Picture>;

inline float shown(float linear) { return std::clamp(linear, 0.0f, 1.0f); }
inline std::array<float, 3> shown(Rgba c) { return {shown(c.r), shown(c.g), shown(c.b)}; }

namespace internal {

// Sum over channels of the square of a combination of frames, at one pixel.
template <typename Combine>
double square_sum(const Combine& combine) {
    double sum = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double value = double(combine(channel));
        sum += value * value;
    }
    return sum;
}

inline double second_difference_sum(const Frames& f, std::size_t t, int x, int y) {
    const auto a = shown(f[t - 1](x, y)), b = shown(f[t](x, y)), c = shown(f[t + 1](x, y));
    return square_sum([&](std::size_t i) { return a[i] - 2 * b[i] + c[i]; });
}

}  // namespace internal

// Requires: as many frames in both, at least three, all of one size.
inline Steadiness measure(const Frames& result, const Frames& truth) {
    constexpr int kBlock = 8;
    Steadiness found;
    const int width = truth[0].width(), height = truth[0].height();
    double errors = 0, changes = 0, bends = 0, bends_of_truth = 0;
    for (std::size_t t = 0; t < truth.size(); ++t)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto r = shown(result[t](x, y)), seen = shown(truth[t](x, y));
                errors += internal::square_sum([&](std::size_t i) { return r[i] - seen[i]; });
            }
    for (std::size_t t = 0; t + 1 < truth.size(); ++t) {
        Plane pop((width + kBlock - 1) / kBlock, (height + kBlock - 1) / kBlock);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto r0 = shown(result[t](x, y)), r1 = shown(result[t + 1](x, y));
                const auto t0 = shown(truth[t](x, y)), t1 = shown(truth[t + 1](x, y));
                const auto change = [&](std::size_t i) { return (r1[i] - t1[i]) - (r0[i] - t0[i]); };
                changes += internal::square_sum(change);
                pop(x / kBlock, y / kBlock) += (change(0) + change(1) + change(2)) / (3 * kBlock * kBlock);
                if (t == 0) continue;
                bends += internal::second_difference_sum(result, t, x, y);
                bends_of_truth += internal::second_difference_sum(truth, t, x, y);
            }
        for (int y = 0; y < pop.height(); ++y)
            for (int x = 0; x < pop.width(); ++x)
                if (std::abs(double(pop(x, y))) > found.worst_pop)
                    found = {0, 0, std::abs(double(pop(x, y))), 0, int(t), x * kBlock, y * kBlock};
    }
    const double in_frame = 3.0 * double(width) * double(height), frames = double(truth.size());
    found.error_db = -10 * std::log10(errors / (in_frame * frames));
    found.change_db = -10 * std::log10(changes / (in_frame * (frames - 1)));
    found.shake = std::sqrt(bends / bends_of_truth);
    return found;
}

// A shot: sharp pictures with depth, or one for all frames, the camera of each frame, and the ray-traced
// pictures that its lens takes.
struct Shot {
    std::vector<RenderedScene> pictures;
    std::vector<Camera> cameras;
    Frames truth;
    std::vector<DeepPicture> behind = {};  // of each frame, where its neighbours were asked
    const RenderedScene& picture(std::size_t frame) const {
        return pictures[std::min(frame, pictures.size() - 1)];
    }
};

struct Size {
    int width = 128, height = 72;
};

inline SceneSettings settings_of(Size size, int truth_samples) {
    SceneSettings settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.truth_samples = truth_samples;
    return settings;
}

inline Picture truth_of(const std::string& scene, SceneSettings settings, const Camera& camera) {
    settings.camera = camera;
    settings.samples = 1;  // of the sharp picture, which is not used
    settings.want_truth = true;
    return std::move(render_scene(scene, settings).value().truth);
}

// One picture, the focus pulled from `from_m` to `to_m` in equal steps of 1/distance, as an assistant's marks
// lie; the f-number is the scene's divided by `wider`, which makes small pictures' blurs large in pixels.
// Hidden layers are known.
inline Shot focus_pull(const std::string& scene, Size size, int frames, double from_m, double to_m,
                       double wider, int truth_samples) {
    Shot shot;
    SceneSettings settings = settings_of(size, truth_samples);
    settings.want_layers = true;
    shot.pictures.push_back(std::move(render_scene(scene, settings).value()));
    for (int t = 0; t < frames; ++t) {
        const double along = frames > 1 ? double(t) / (frames - 1) : 0;
        Camera camera = shot.pictures[0].camera;
        camera.focus_distance_m = 1 / (1 / from_m + along * (1 / to_m - 1 / from_m));
        camera.f_number /= wider;
        shot.truth.push_back(truth_of(scene, settings_of(size, truth_samples), camera));
        shot.cameras.push_back(camera);
    }
    return shot;
}

// Consecutive frames of a scene that moves. What nearer things hide has to be guessed.
inline Shot camera_move(const std::string& scene, Size size, int first, int frames, int truth_samples,
                        std::uint64_t seed = 1) {
    Shot shot;
    SceneSettings settings = settings_of(size, truth_samples);
    settings.want_truth = true, settings.seed = seed;
    for (settings.frame = first; settings.frame < first + frames; ++settings.frame) {
        shot.pictures.push_back(std::move(render_scene(scene, settings).value()));
        shot.truth.push_back(std::move(shot.pictures.back().truth));
        shot.cameras.push_back(shot.pictures.back().camera);
    }
    return shot;
}

// Each frame is shown what up to `each_side` frames before and after it see behind its silhouettes.
inline void look_around(Shot& shot, int each_side) {
    std::vector<petzval::Shot> frames(shot.pictures.size());
    for (std::size_t t = 0; t < frames.size(); ++t) {
        const RenderedScene& picture = shot.pictures[t];
        frames[t].place = Place::whole(picture.colour.rect());
        frames[t].colour = picture.colour.clone();
        frames[t].depth = DepthMetres{picture.depth_m.clone()};
        frames[t].camera.focal_length_mm = FoundNumber{picture.camera.focal_length_mm, ""};
        frames[t].camera.sensor_width_mm = FoundNumber{picture.camera.sensor_width_mm, ""};
        frames[t].camera.camera_from_world = picture.camera_from_world;
    }
    for (std::size_t t = 0; t < frames.size(); ++t) {
        std::vector<OtherPicture> others;
        for (std::size_t away = 1; away <= std::size_t(each_side); ++away) {
            if (away <= t) others.push_back({&frames[t - away], -int(away)});
            if (t + away < frames.size()) others.push_back({&frames[t + away], int(away)});
        }
        SeenElsewhere seen = seen_elsewhere(frames[t], others, *own_workers()).value();
        for (const SeenElsewhere::Lamp& lamp : seen.lamps)
            shot.pictures[t].depth_m(lamp.x, lamp.y) = lamp.depth_m;
        shot.behind.push_back(std::move(seen.behind));
    }
}

inline DefocusJob job_of(const Shot& shot, std::size_t frame, const std::string& engine) {
    DefocusJob job;
    job.colour = shot.picture(frame).colour;
    job.depth_m = shot.picture(frame).depth_m;
    job.place = Place::whole(shot.picture(frame).colour.rect());
    const DeepPicture& layers = shot.behind.empty() ? shot.picture(frame).layers : shot.behind[frame];
    job.behind = layers.empty() ? nullptr : &layers;
    job.camera = shot.cameras[frame];
    job.engine = engine;
    return job;
}

inline Frames defocused(const Shot& shot, const std::string& engine) {
    Frames frames;
    SessionSettings settings;
    if (engine == "realtime") settings.device = "gpu";
    Session session(settings);
    for (std::size_t t = 0; t < shot.cameras.size(); ++t) {
        DefocusJob job = job_of(shot, t, engine);
        if (engine == "realtime") job.behind = nullptr;  // it takes no hidden layers
        frames.push_back(std::move(session.defocus(job).value().image));
    }
    return frames;
}

}  // namespace petzval::flicker

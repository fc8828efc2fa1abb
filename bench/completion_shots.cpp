#include "completion_shots.h"

#include "petzval/files.h"
#include "petzval/scene.h"

#include "branch.h"
#include "process.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace petzval::bench {
namespace {

constexpr int kWidth = 320, kHeight = 180, kFirstFrame = 11, kFrames = 3;
constexpr int kTruthSamples = 256;

struct Source {
    std::string scene;
    std::uint64_t seed = 1;
    int first = 0, frames = 1;
};

Source source_of(const std::string& name) {
    if (!name.empty() && name.find_first_not_of("0123456789") == std::string::npos) {
        const std::uint64_t seed = std::stoull(name);
        return {"random", seed, kFirstFrame, seed % 5 < 2 ? kFrames : 1};
    }
    for (const SceneSummary& scene : scene_list())
        if (scene.name == name)
            return {name, 1, scene.frames > 1 ? kFirstFrame : 0, scene.frames > 1 ? kFrames : 1};
    fail("no shot " + name + ": a seed, a built-in scene or branch:TILT:FSTOP");
}

void write(const std::string& path, const RenderedScene& scene, bool is_truth) {
    Frame frame;
    frame.colour = is_truth ? scene.truth.clone() : scene.colour.clone();
    frame.place = Place::whole(frame.colour.rect());
    frame.has_alpha = true;
    if (!is_truth) frame.depth = scene.depth_m.clone();
    WriteOptions options;
    options.type = PixelType::Float;
    options.camera.focal_length_mm = FoundNumber{scene.camera.focal_length_mm, ""};
    options.camera.sensor_width_mm = FoundNumber{scene.camera.sensor_width_mm, ""};
    options.camera.f_number = FoundNumber{scene.camera.f_number, ""};
    options.camera.focus_distance_m = FoundNumber{scene.camera.focus_distance_m, ""};
    if (const Status status = write_exr(path, frame, options); !status) fail(status.error().message);
}

SceneSettings settings_of(const Source& source, int frame) {
    SceneSettings settings;
    settings.width = kWidth, settings.height = kHeight;
    settings.seed = source.seed, settings.frame = frame;
    return settings;
}

RenderedScene rendered(const Source& source, const SceneSettings& settings) {
    auto scene = render_scene(source.scene, settings);
    if (!scene) fail(scene.error().message);
    return std::move(*scene);
}

void make(const Source& source, int frame, const Still& still) {
    SceneSettings settings = settings_of(source, frame);
    settings.truth_samples = kTruthSamples, settings.want_truth = true;
    const RenderedScene scene = rendered(source, settings);
    write(still.sharp_file, scene, false);
    write(still.truth_file, scene, true);
}

DeepPicture hidden_layers(const Source& source, int frame) {
    SceneSettings settings = settings_of(source, frame);
    settings.want_layers = true;
    return rendered(source, settings).layers;
}

Frame read(const std::string& path, bool need_depth) {
    ReadOptions options;
    options.need_depth = need_depth;
    auto frame = read_frame(path, options);
    if (!frame) fail(frame.error().message);
    return std::move(*frame);
}

Still still_of(const Source& source, int frame, const std::string& folder) {
    const std::string stem =
        folder + "/" + source.scene + "_" + std::to_string(source.seed) + "_" + std::to_string(frame);
    Still still;
    still.sharp_file = stem + "_sharp.exr", still.truth_file = stem + "_truth.exr";
    if (!std::filesystem::exists(still.sharp_file) || !std::filesystem::exists(still.truth_file))
        make(source, frame, still);
    Frame sharp = read(still.sharp_file, true), truth = read(still.truth_file, false);
    const FoundCamera& found = sharp.camera;
    if (!found.focal_length_mm || !found.sensor_width_mm || !found.f_number || !found.focus_distance_m)
        fail(still.sharp_file + ": camera numbers are missing");
    still.camera = {found.focal_length_mm->value, found.sensor_width_mm->value, found.f_number->value,
                    found.focus_distance_m->value};
    still.sharp = std::move(sharp.colour), still.depth_m = std::move(sharp.depth);
    still.truth = std::move(truth.colour);
    still.counts = silhouettes_reach(still.depth_m, still.camera);
    return still;
}

}  // namespace

Image<unsigned char> silhouettes_reach(const Plane& depth_m, const Camera& camera) {
    const int width = depth_m.width(), height = depth_m.height();
    Image<unsigned char> reached(width, height);
    const auto coc = CircleOfConfusion::make(camera, width);
    if (!coc) fail(coc.error().message);
    const auto reach = [&](int x, int y) { return std::abs(float(coc->radius_px(double(depth_m(x, y))))); };
    const auto spread = [&](int x, int y, int u, int v) {
        if (u >= width || v >= height) return;
        const float a = depth_m(x, y), b = depth_m(u, v);
        if (!(std::min(a, b) * 1.1f < std::max(a, b))) return;
        const float radius = std::max(reach(x, y), reach(u, v)) + 1;
        const int n = int(radius);
        for (int j = std::max(0, y - n); j <= std::min(height - 1, y + n); ++j)
            for (int i = std::max(0, x - n); i <= std::min(width - 1, x + n); ++i)
                if (float((i - x) * (i - x) + (j - y) * (j - y)) <= radius * radius) reached(i, j) = 1;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) spread(x, y, x + 1, y), spread(x, y, x, y + 1);
    return reached;
}

namespace {

// The exposure a photographer would choose, in whole stops; three at most.
float exposure_of(const Picture& picture) {
    double mean = 0;
    for (std::size_t i = 0; i < picture.size(); ++i)
        mean += double(std::clamp(picture.pixels()[i].g, 0.0f, 1.0f)) / double(picture.size());
    return float(std::exp2(std::clamp(std::round(std::log2(0.18 / std::max(mean, 1e-6))), 0.0, 3.0)));
}

}  // namespace

CompletionShot completion_shot(const std::string& name, const std::string& folder, bool with_hidden) {
    if (name.starts_with("branch:")) {
        if (with_hidden) fail(name + " has no hidden layers");
        double tilt_deg = 0, f_number = 0;
        if (std::sscanf(name.c_str(), "branch:%lf:%lf", &tilt_deg, &f_number) != 2)
            fail(name + ": branch:TILT:FSTOP");
        return branch_shot(tilt_deg, f_number);
    }
    const Source source = source_of(name);
    CompletionShot shot;
    for (int i = 0; i < source.frames; ++i) {
        shot.frames.push_back(still_of(source, source.first + i, folder));
        if (with_hidden) shot.frames.back().hidden = hidden_layers(source, source.first + i);
    }
    shot.exposure = exposure_of(shot.frames[0].sharp);
    return shot;
}

}  // namespace petzval::bench

#ifdef PETZVAL_GLTF

#include "scene/gltf/animation.h"

#include "scene/gltf/numbers.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace petzval::scene {
namespace {

constexpr double kLongest_s = 4000;

// One thing of one node over time.
struct Track {
    GltfNumbers times, values;
    std::string interpolation;
    std::size_t width = 3;  // 4: a rotation

    double time(std::size_t key) const { return times.at(key, 0); }
    // part, of a spline: 0 the tangent that comes in, 1 the value, 2 the tangent that goes out.
    double value(std::size_t key, std::size_t component, std::size_t part = 1) const {
        return values.at(interpolation == "CUBICSPLINE" ? 3 * key + part : key, component);
    }
};

void normalise(std::vector<double>& q) {
    double length = 0;
    for (const double x : q) length += x * x;
    for (double& x : q) x /= std::sqrt(length);
}

// Interpolates unit quaternions along the shorter arc.
std::vector<double> on_arc(const Track& of, std::size_t key, double share) {
    double cosine = 0;
    for (std::size_t k = 0; k < 4; ++k) cosine += of.value(key, k) * of.value(key + 1, k);
    const double angle = std::acos(std::min(1.0, std::abs(cosine)));
    const bool is_short = angle < 1e-4;
    const double a = is_short ? 1 - share : std::sin((1 - share) * angle) / std::sin(angle);
    const double b = is_short ? share : std::sin(share * angle) / std::sin(angle);
    std::vector<double> mixed;
    for (std::size_t k = 0; k < 4; ++k)
        mixed.push_back(a * of.value(key, k) + std::copysign(b, cosine) * of.value(key + 1, k));
    return mixed;
}

std::vector<double> on_spline(const Track& of, std::size_t key, double t, double step_s) {
    const double t2 = t * t, t3 = t2 * t;
    std::vector<double> mixed;
    for (std::size_t k = 0; k < of.width; ++k)
        mixed.push_back(
            (2 * t3 - 3 * t2 + 1) * of.value(key, k) + step_s * (t3 - 2 * t2 + t) * of.value(key, k, 2) +
            (3 * t2 - 2 * t3) * of.value(key + 1, k) + step_s * (t3 - t2) * of.value(key + 1, k, 0));
    return mixed;
}

std::vector<double> value_at(const Track& of, double at_s) {
    const std::size_t last = of.times.count - 1;
    std::size_t key = 0;
    while (key < last && of.time(key + 1) <= at_s) ++key;
    std::vector<double> now;
    const double share = key < last ? (at_s - of.time(key)) / (of.time(key + 1) - of.time(key)) : 0.0;
    if (key == last || share <= 0 || of.interpolation == "STEP")
        for (std::size_t k = 0; k < of.width; ++k) now.push_back(of.value(key, k));
    else if (of.interpolation == "CUBICSPLINE")
        now = on_spline(of, key, share, of.time(key + 1) - of.time(key));
    else if (of.width == 4)
        now = on_arc(of, key, share);
    else
        for (std::size_t k = 0; k < of.width; ++k)
            now.push_back(std::lerp(of.value(key, k), of.value(key + 1, k), share));
    if (of.width == 4) normalise(now);
    return now;
}

Result<Track> track_of(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler,
                       std::size_t width, const std::string& path) {
    const auto broken = [&](const char* why) { return Error{ErrorCode::InvalidFile, path + ": " + why}; };
    const auto times = gltf_numbers(model, sampler.input, TINYGLTF_TYPE_SCALAR, path);
    if (!times) return times.error();
    const auto values =
        gltf_numbers(model, sampler.output, width == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, path);
    if (!values) return values.error();
    const Track track{*times, *values, sampler.interpolation, width};
    const std::size_t a_key = track.interpolation == "CUBICSPLINE" ? 3 : 1;
    if (values->count / a_key < times->count) return broken("an animation with fewer values than times");
    for (std::size_t i = 0; i < times->count; ++i) {
        const double before = i > 0 ? track.time(i - 1) : -1;
        if (!(track.time(i) > before && track.time(i) <= kLongest_s))
            return broken("an animation with times that do not ascend, or longer than an hour");
    }
    return track;
}

// The node's property that a channel moves; null: not supported.
std::vector<double>* moved_by(const tinygltf::AnimationChannel& channel, tinygltf::Node& node) {
    return channel.target_path == "translation" ? &node.translation
           : channel.target_path == "rotation"  ? &node.rotation
           : channel.target_path == "scale"     ? &node.scale
                                                : nullptr;
}

}  // namespace

Result<double> pose(tinygltf::Model& model, double at_s, const std::string& path,
                    std::vector<std::string>& warnings) {
    double ends_s = 0;
    std::set<const void*> moved;
    bool has_more = !model.skins.empty() && !model.animations.empty();
    for (const tinygltf::Animation& animation : model.animations)
        for (const tinygltf::AnimationChannel& channel : animation.channels) {
            if (channel.target_node < 0) continue;  // of an extension
            const bool is_there = std::size_t(channel.target_node) < model.nodes.size() &&
                                  channel.sampler >= 0 &&
                                  std::size_t(channel.sampler) < animation.samplers.size();
            if (!is_there)
                return Error{ErrorCode::InvalidFile, path + ": an animation of a node that is missing"};
            auto* place = moved_by(channel, model.nodes[std::size_t(channel.target_node)]);
            has_more |= !place;
            if (!place || !moved.insert(place).second) continue;
            const auto track = track_of(model, animation.samplers[std::size_t(channel.sampler)],
                                        channel.target_path == "rotation" ? 4 : 3, path);
            if (!track) return track.error();
            *place = value_at(*track, at_s);
            ends_s = std::max(ends_s, track->time(track->times.count - 1));
        }
    if (has_more) warnings.push_back(path + ": its skins and morph targets do not move");
    return ends_s;
}

}  // namespace petzval::scene

#endif

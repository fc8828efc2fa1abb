#include "petzval/display_files.h"
#include "petzval/shots/scene_files.h"

#include <algorithm>
#include <cstdint>

namespace petzval {
namespace {

Error invalid(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

// A glTF file is not among them.
const SceneSummary* built_in(const std::string& name) {
    for (const SceneSummary& scene : scene_list())
        if (scene.name == name) return &scene;
    return nullptr;
}

Status check_outputs(const SceneFiles& files) {
    std::vector<std::string> names = outputs_of(files);
    for (const std::string& name : names) {
        const auto kind = kind_of_output(name);
        if (!kind || *kind != FileKind::Exr) return invalid(name + ": the name must end in .exr");
    }
    std::sort(names.begin(), names.end());
    if (std::adjacent_find(names.begin(), names.end()) != names.end())
        return invalid("scene.output, scene.truth and scene.layers must be different files");
    return Done{};
}

}  // namespace

Status check(const SceneFiles& files) {
    if (const Status known = check_scene(files.scene, files.settings.own_camera); !known) return known;
    if (const Status fine = check_outputs(files); !fine) return fine;
    const SceneSummary* const known = built_in(files.scene);
    if (files.settings.want_motion && (!known || known->frames == 1))
        return invalid("scene.want_motion has no effect: " + files.scene + " does not move");
    return Done{};
}

void set_size(SceneSettings& settings, std::optional<int> width, std::optional<int> height) {
    const auto other = [](int side, int of, int to) {
        return std::max(1, int((std::int64_t(side) * to + of / 2) / of));
    };
    const int wide = settings.width, high = settings.height;
    settings.width = width.value_or(height ? other(*height, high, wide) : wide);
    settings.height = height.value_or(width ? other(*width, wide, high) : high);
}

}  // namespace petzval

#include "effect.h"
#include "rules.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace ofx_check {

EffectLies effect_lies;
Counts counts;
thread_local const char* action_now = nullptr;
thread_local FrameState* frame_now = nullptr;

FrameState& state_of(const ofx::Effect& effect) {
    static FrameState none;
    if (frame_now) return *frame_now;
    FrameState* const last = effect.frame;
    return last ? *last : none;
}

namespace {

// Images that are fetched and not yet released, with their memory.
struct OpenImage {
    std::unique_ptr<ofx::PropertySet> properties;
    std::shared_ptr<GuardedImage> memory;
    bool is_output;
};
std::mutex mutex;
std::map<const ofx::PropertySet*, OpenImage>& open_images() {
    static std::map<const ofx::PropertySet*, OpenImage> images;
    return images;
}
// Ended sets, kept so that their addresses are not used again.
std::vector<OpenImage>& closed_images() {
    static std::vector<OpenImage> images;
    return images;
}

bool checked(const ofx::Effect* effect) {
    held("handles.valid");
    if (effect) return true;
    broken("handles.valid", "a null effect");
    return false;
}

int get_properties(ofx::Effect* effect, ofx::PropertySet** set) {
    if (!checked(effect) || !set) return ofx::kBadHandle;
    *set = &effect->properties;
    return ofx::kOk;
}

int get_params(ofx::Effect* effect, ofx::ParamSet** set) {
    if (!checked(effect) || !set) return ofx::kBadHandle;
    *set = &effect->params;
    return ofx::kOk;
}

int define_clip(ofx::Effect* effect, const char* name, ofx::PropertySet** set) {
    if (!checked(effect) || !name) return ofx::kBadHandle;
    if (effect->find(name)) return ofx::kExists;
    auto clip = std::make_unique<ofx::Clip>(name, "clip description", true);
    clip->properties.label = name;
    clip->properties.with(ofx::kName, std::vector<std::string>{name});
    if (set) *set = &clip->properties;
    effect->clips.push_back(std::move(clip));
    return ofx::kOk;
}

int clip_handle(ofx::Effect* effect, const char* name, ofx::Clip** clip, ofx::PropertySet** set) {
    if (!checked(effect) || !name) return ofx::kBadHandle;
    ofx::Clip* found = effect->find(name);
    held("clips.declared");
    if (!found) {
        broken("clips.declared", std::string("the clip '") + name + "' was never defined");
        return ofx::kBadHandle;
    }
    if (clip) *clip = found;
    if (set) *set = &found->properties;
    return ofx::kOk;
}

int clip_properties(ofx::Clip* clip, ofx::PropertySet** set) {
    if (!clip || !set) return ofx::kBadHandle;
    *set = &clip->properties;
    return ofx::kOk;
}

constexpr const char* depth_name(Depth depth) {
    if (depth == Depth::Float) return ofx::kFloat;
    return depth == Depth::Short ? ofx::kShort : ofx::kByte;
}

// Lies of the check over the truth.
void lie_about(const ofx::Clip& clip, ofx::PropertySet& image) {
    if (effect_lies.bad_image_of != clip.name) return;
    using Bad = EffectLies::Bad;
    if (effect_lies.bad == Bad::WrongDepth)
        image.with(ofx::kPixelDepth, std::vector<std::string>{ofx::kHalf});
    if (effect_lies.bad == Bad::NoData) image.with(ofx::kData, nullptr);
    if (effect_lies.bad == Bad::NoSize) image.with(ofx::kBounds, std::vector<int>{0, 0, 0, 0});
}

std::unique_ptr<ofx::PropertySet> describe_image(const ofx::Clip& clip, const Picture& picture,
                                                 const GuardedImage& memory) {
    auto image = std::make_unique<ofx::PropertySet>("image");
    const ofx::RectI& b = picture.bounds;
    const ofx::RectI region = scaled_region(*clip.effect, clip);
    image->label = clip.name;
    image->with(ofx::kType, std::vector<std::string>{ofx::kTypeImage})
        .with(ofx::kPixelDepth, std::vector<std::string>{depth_name(depth_of(*clip.effect))})
        .with(ofx::kComponents, std::vector<std::string>{components_name(picture.channels)})
        .with(ofx::kPreMultiplication,
              std::vector<std::string>{clip.properties.text(ofx::kPreMultiplication)})
        .with(ofx::kRenderScale, std::vector<double>{state_of(*clip.effect).request.scale.x,
                                                     state_of(*clip.effect).request.scale.y})
        .with(ofx::kPixelAspect, std::vector<double>{1})
        .with(ofx::kData, memory.data())
        .with(ofx::kBounds, std::vector<int>{b.x1, b.y1, b.x2, b.y2})
        .with(ofx::kImageRegion, std::vector<int>{region.x1, region.y1, region.x2, region.y2})
        .with(ofx::kRowBytes, std::vector<int>{memory.row_bytes()})
        .with(ofx::kField, std::vector<std::string>{ofx::kFieldNone})
        .with(ofx::kImageId, std::vector<std::string>{clip.name});
    lie_about(clip, *image);
    return image;
}

void check_action() {
    held("images.action");
    const std::string_view action = action_now ? action_now : "";
    if (action == ofx::action::kRender || action == ofx::action::kChanged ||
        action == ofx::action::kEndChanged)
        return;
    broken("images.action",
           "an image is fetched by " + (action.empty() ? std::string("no action") : std::string(action)));
}

int clip_image(ofx::Clip* clip, ofx::Time, const ofx::Rect*, ofx::PropertySet** image) {
    if (!clip || !image) return ofx::kBadHandle;
    check_action();
    *image = nullptr;
    if (effect_lies.no_image_of == clip->name) return ofx::kFailed;
    const bool is_output = clip->name == ofx::kOutput;
    if (!is_output && clip->picture.values.empty()) return ofx::kFailed;
    ofx::Effect& effect = *clip->effect;
    FrameState& frame = state_of(effect);
    const Picture picture =
        is_output ? Picture(frame.output_bounds, output_channels(effect)) : input_of(effect, *clip);
    const std::lock_guard lock(mutex);
    OpenImage open{nullptr, nullptr, is_output};
    if (is_output && frame.output) {
        open.memory = frame.output;
    } else {
        open.memory =
            std::make_shared<GuardedImage>(picture, depth_of(effect), frame.request.layout, is_output);
        if (is_output) frame.output = open.memory;
        if (!is_output) open.memory->make_read_only();
    }
    open.properties = describe_image(*clip, picture, *open.memory);
    *image = open.properties.get();
    ++counts.images_open;
    open_images().emplace(*image, std::move(open));
    return ofx::kOk;
}

int release_image(ofx::PropertySet* image) {
    const std::lock_guard lock(mutex);
    const auto found = open_images().find(image);
    held("images.released");
    if (found == open_images().end()) {
        broken("images.released",
               image ? "an image is released that is not open; it may have been released before"
                     : "null is released");
        return ofx::kBadHandle;
    }
    --counts.images_open;
    if (!found->second.is_output) found->second.memory->give_back();
    closed_images().push_back(std::move(found->second));
    open_images().erase(found);
    closed_images().back().properties.reset();
    return ofx::kOk;
}

int clip_region(ofx::Clip* clip, ofx::Time, ofx::Rect* bounds) {
    if (!clip || !bounds) return ofx::kBadHandle;
    if (clip->picture.values.empty()) return ofx::kFailed;
    const ofx::RectI& b = clip->picture.bounds;
    *bounds = {double(b.x1), double(b.y1), double(b.x2), double(b.y2)};
    return ofx::kOk;
}

int is_aborted(ofx::Effect* effect) {
    if (!checked(effect)) return 0;
    const int asked = counts.aborts_asked++;
    return effect_lies.abort_after >= 0 && asked >= effect_lies.abort_after ? 1 : 0;
}

// Memory of images, never moved.
int memory_alloc(ofx::Effect*, std::size_t bytes, ofx::ImageMemory** memory) {
    if (!memory) return ofx::kBadHandle;
    *memory = reinterpret_cast<ofx::ImageMemory*>(new (std::nothrow) char[bytes]);
    return *memory ? ofx::kOk : ofx::kMemory;
}
int memory_free(ofx::ImageMemory* memory) {
    if (!memory) return ofx::kBadHandle;
    delete[] reinterpret_cast<char*>(memory);
    return ofx::kOk;
}
int memory_lock(ofx::ImageMemory* memory, void** pointer) {
    if (!memory || !pointer) return ofx::kBadHandle;
    *pointer = memory;
    return ofx::kOk;
}
int memory_unlock(ofx::ImageMemory* memory) { return memory ? ofx::kOk : ofx::kBadHandle; }

}  // namespace

const ofx::ImageEffectSuite& image_effect_suite() {
    static const ofx::ImageEffectSuite suite{
        get_properties, get_params, define_clip,  clip_handle, clip_properties, clip_image,   release_image,
        clip_region,    is_aborted, memory_alloc, memory_free, memory_lock,     memory_unlock};
    return suite;
}

}  // namespace ofx_check

ofx::Clip* ofx::Effect::find(const std::string& name) const {
    for (const auto& clip : clips)
        if (clip->name == name) return clip.get();
    return nullptr;
}

// A sound OpenFX plug-in, a box blur, into which PLANTED_FAULT plants one fault.
#include "ofx.h"
#include "ofx_names.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <thread>

namespace {

using namespace ofx;

const Host* host = nullptr;

// Functions of the host. A host may load the plug-in again while other threads render.
template <typename Functions>
class Suite {
public:
    Suite& operator=(const Functions* functions) {
        functions_ = functions;
        return *this;
    }
    const Functions* operator->() const { return functions_; }
    explicit operator bool() const { return functions_ != nullptr; }

private:
    std::atomic<const Functions*> functions_{nullptr};
};
Suite<PropertySuite> props;
Suite<ImageEffectSuite> effects;
Suite<ParameterSuite> params;
Suite<MessageSuite> messages;
bool was_unloaded = false;
std::atomic<int> renders{0}, instances{0};
float shared_value = 0;

bool fault(std::string_view name) {
    const char* planted = std::getenv("PLANTED_FAULT");
    return planted && name == planted;
}

void set(PropertySet* set, const char* name, const char* value, int index = 0) {
    props->set_string(set, name, index, value);
}

struct Image {
    PropertySet* handle = nullptr;
    char* data = nullptr;
    int bounds[4] = {};
    int row_bytes = 0;

    Image(Effect* effect, const char* name) {
        Clip* clip = nullptr;
        effects->clip_handle(effect, name, &clip, nullptr);
        if (!clip || effects->clip_image(clip, 1, nullptr, &handle) != kOk) handle = nullptr;
        if (!handle) return;
        void* pixels = nullptr;
        props->get_pointer(handle, kData, 0, &pixels);
        props->get_ints(handle, kBounds, 4, bounds);
        props->get_int(handle, kRowBytes, 0, &row_bytes);
        if (fault("trusts_properties") && row_bytes == 0) std::abort();
        char* depth = nullptr;
        const bool known =
            props->get_string(handle, kPixelDepth, 0, &depth) == kOk && std::strcmp(depth, kFloat) == 0;
        data = known || fault("trusts_format") ? static_cast<char*>(pixels) : nullptr;
        if (fault("ignores_row_bytes")) row_bytes = (bounds[2] - bounds[0]) * 16;
        if (fault("positive_rows")) row_bytes = std::abs(row_bytes);
    }
    void release() {
        if (handle) effects->release_image(handle);
        if (!fault("after_release") && !fault("stale_handle") && !fault("releases_twice")) handle = nullptr;
    }
    float* at(int x, int y) const {
        return reinterpret_cast<float*>(data + std::ptrdiff_t(y - bounds[1]) * row_bytes +
                                        std::ptrdiff_t(x - bounds[0]) * 16);
    }
    bool holds(int x, int y) const {
        return x >= bounds[0] && x < bounds[2] && y >= bounds[1] && y < bounds[3];
    }
};

double radius_of(Effect* effect) {
    ParamSet* set_of = nullptr;
    Param* param = nullptr;
    double radius = 0;
    effects->param_set(effect, &set_of);
    if (fault("undeclared_param")) params->handle(set_of, "strength", &param, nullptr);
    if (params->handle(set_of, "radius", &param, nullptr) == kOk) params->value_at_time(param, 1, &radius);
    if (fault("sets_in_render")) params->set_value(param, radius);
    if (fault("shared_state")) return std::max(0.0, radius - instances.load() + 1);
    return radius;
}

int silently_or_not(Effect* effect) {
    if (!fault("silent_failure") && messages)
        messages->message(effect, "OfxMessageError", "", "%s", "no pixels");
    return kFailed;
}

// Mean of the pixels around, 0 beyond the image.
void blur_pixel(const Image& source, const Image& like, int x, int y, int radius, float* to) {
    static const bool same_bounds = fault("same_bounds");
    float sum[4] = {};
    for (int v = y - radius; v <= y + radius; ++v)
        for (int u = x - radius; u <= x + radius; ++u) {
            const Image& where = same_bounds ? like : source;
            if (!source.holds(u, v)) continue;
            const char* row = source.data + std::ptrdiff_t(v - where.bounds[1]) * source.row_bytes;
            const float* from =
                reinterpret_cast<const float*>(row + std::ptrdiff_t(u - where.bounds[0]) * 16);
            for (int c = 0; c < 4; ++c) sum[c] += from[c];
        }
    const float count = float(2 * radius + 1) * float(2 * radius + 1);
    for (int c = 0; c < 4; ++c) to[c] = sum[c] / count;
}

void spoil(const Image& source, const Image& output, const int* window) {
    if (fault("writes_input")) *source.at(source.bounds[0], source.bounds[1]) = 1;
    if (fault("overruns"))
        *(output.at(output.bounds[2] - 1, output.bounds[3] - 1) + 4 + output.row_bytes / 4) = 1;
    if (fault("random")) *output.at(window[0], window[1]) += float(++renders);
    if (fault("local_window")) *output.at(window[0], window[1]) = 0.123f;
    if (fault("thread_unsafe")) {
        const float mine = float(++renders);
        shared_value = mine;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (shared_value != mine) *output.at(window[0], window[1]) = -1;
    }
}

// Faults with clips and images of the host.
void misuse(Effect* effect, Image& source) {
    Clip* clip = nullptr;
    PropertySet* of_clip = nullptr;
    if (fault("undeclared_clip")) effects->clip_handle(effect, "Matte", &clip, nullptr);
    if (fault("writes_host")) {
        effects->clip_handle(effect, kSource, &clip, &of_clip);
        props->set_int(of_clip, kConnected, 0, 1);
    }
    if (fault("releases_twice") && source.handle) effects->release_image(source.handle);
    if (fault("crashes")) std::abort();
    if (fault("hangs")) std::this_thread::sleep_for(std::chrono::hours(1));
}

void wait_a_while(Effect* effect) {
    const bool deaf = fault("never_aborts");
    for (int i = 0; i < (deaf ? 70 : 0); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    effects->abort(effect);
}

bool lacks_mask(Effect* effect) {
    Clip* clip = nullptr;
    PropertySet* set_of = nullptr;
    int connected = 0;
    if (effects->clip_handle(effect, "Mask", &clip, &set_of) == kOk)
        props->get_int(set_of, kConnected, 0, &connected);
    return !connected;
}

bool is_filter(Effect* effect) {
    PropertySet* set_of = nullptr;
    char* context = nullptr;
    effects->property_set(effect, &set_of);
    return props->get_string(set_of, kContext, 0, &context) == kOk &&
           std::strcmp(context, kContextFilter) == 0;
}

int radius_px(Effect* effect, PropertySet* in) {
    double scale = 1;
    props->get_double(in, kRenderScale, 0, &scale);
    return int(radius_of(effect) * (fault("ignores_scale") ? 1 : scale));
}

int render(Effect* effect, PropertySet* in) {
    if (fault("render_default")) return kReplyDefault;
    if (fault("filter_fails") && is_filter(effect)) return kFailed;
    if (fault("needs_mask") && lacks_mask(effect)) return kFailed;
    int window[4] = {};
    props->get_ints(in, kRenderWindow, 4, window);
    Image source(effect, kSource), output(effect, kOutput);
    const int radius = radius_px(effect, in);
    if (fault("extreme") && radius >= 16) std::abort();
    const bool fails =
        !output.data || (source.handle && !source.data) || (fault("silent_failure") && radius >= 16);
    if (!fails) {
        wait_a_while(effect);
        if (fault("beyond_window")) std::copy_n(output.bounds, 4, window);
        for (int y = window[1]; y < window[3] - (fault("misses_row") ? 1 : 0); ++y)
            for (int x = window[0]; x < window[2]; ++x) {
                if (source.data)
                    blur_pixel(source, output, x, y, radius, output.at(x, y));
                else
                    std::memset(output.at(x, y), 0, 16);
            }
        if (fault("trusts_images")) *output.at(window[0], window[1]) += *source.at(0, 0) * 0;
        spoil(source, output, window);
    }
    output.release();
    if (!fault("leaks_image")) source.release();
    misuse(effect, source);
    if (fault("after_release") && source.data) std::memcpy(&shared_value, source.data, 4);
    if (fault("stale_handle") && source.handle) props->get_int(source.handle, kRowBytes, 0, window);
    return fails ? silently_or_not(effect) : int(kOk);
}

int region(PropertySet* in, PropertySet* out, bool of_interest, double radius) {
    double r[4] = {};
    if (fault("bad_region") && !of_interest) {
        const double wrong[4] = {10, 10, 0, 0};
        props->set_doubles(out, kDefinition, 4, wrong);
        return kOk;
    }
    if (fault("wrong_status") && !of_interest) return kBadValue;
    if (!of_interest) return kReplyDefault;
    props->get_doubles(in, kInterest, 4, r);
    const double more = fault("small_region") ? 0 : radius;
    const double wanted[4] = {r[0] - more, r[1] - more, r[2] + more, r[3] + more};
    props->set_doubles(out, "OfxImageClipPropRoI_Source", 4, wanted);
    return kOk;
}

int identity(Effect* effect, PropertySet* out) {
    if (fault("fetch_in_identity")) Image(effect, kSource).release();
    const bool is = radius_of(effect) < 0.5 || fault("bad_identity");
    if (is) set(out, kName, fault("bad_identity") ? "Nothing" : kSource);
    return is ? kOk : kReplyDefault;
}

int overlay(const char* name, const void*, PropertySet* in, PropertySet*) {
    void* context = nullptr;
    props->get_pointer(in, kDrawContext, 0, &context);
    if (fault("overlay_crash") && std::strcmp(name, action::kDraw) == 0)
        static_cast<volatile char*>(context)[0] = 1;
    return kReplyDefault;
}

int describe(Effect* effect) {
    PropertySet* p = nullptr;
    effects->property_set(effect, &p);
    set(p, kLabel, "planted");
    if (!fault("no_contexts"))
        set(p, kContexts, fault("bad_value") ? "OfxImageEffectContextBlur" : kContextFilter);
    if (!fault("no_contexts")) set(p, kContexts, kContextGeneral, 1);
    if (!fault("no_depths")) set(p, kPixelDepths, kFloat);
    if (fault("wrong_object")) props->set_int(p, kOptional, 0, 1);
    if (fault("wrong_type")) props->set_double(p, kTiles, 0, 1);
    if (!fault("wrong_type")) props->set_int(p, kTiles, 0, 1);
    if (fault("bad_index")) set(p, kGrouping, "Filter", 3);
    set(p, kThreadSafety, kFullySafe);
    props->set_pointer(p, kOverlayV2, 0, reinterpret_cast<void*>(&overlay));
    return kOk;
}

void define_clip(Effect* effect, const char* name, bool optional) {
    PropertySet* p = nullptr;
    effects->clip_define(effect, name, &p);
    if (!fault("no_components")) set(p, kComponentsSupported, kRgba);
    if (optional) props->set_int(p, kOptional, 0, 1);
}

int describe_in_context(Effect* effect) {
    define_clip(effect, kSource, false);
    define_clip(effect, "Mask", true);
    if (!fault("no_output")) define_clip(effect, kOutput, false);
    ParamSet* of_effect = nullptr;
    PropertySet* p = nullptr;
    effects->param_set(effect, &of_effect);
    params->define(of_effect, "OfxParamTypeDouble", "radius", &p);
    props->set_double(p, param::kDefault, 0, fault("bad_default") ? 40 : 4);
    props->set_double(p, param::kMin, 0, 0);
    props->set_double(p, param::kMax, 0, 16);
    params->define(of_effect, param::kChoice, "shape", &p);
    set(p, param::kChoiceOption, "square");
    set(p, param::kChoiceOption, "cross", 1);
    if (fault("param_twice")) params->define(of_effect, "OfxParamTypeDouble", "radius", &p);
    return kOk;
}

int load() {
    if (fault("leaves_thread"))
        std::thread([] { std::this_thread::sleep_for(std::chrono::hours(1)); }).detach();
    if (fault("load_resets")) {
        effects = nullptr;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    const auto suite = [](const char* name) { return host->fetch_suite(host->properties, name, 1); };
    props = static_cast<const PropertySuite*>(suite(kPropertySuite));
    effects = static_cast<const ImageEffectSuite*>(suite(kImageEffectSuite));
    params = static_cast<const ParameterSuite*>(suite(kParameterSuite));
    messages = static_cast<const MessageSuite*>(suite(kMessageSuite));
    if (fault("trusts_suites") && !messages) std::abort();
    if (fault("no_reload") && was_unloaded) return kFailed;
    return props && effects && params ? kOk : kMissingHostFeature;
}

int main_entry(const char* name, const void* handle, PropertySet* in, PropertySet* out) {
    const std::string_view a = name;
    // The interface passes all handles as const: NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    auto* effect = static_cast<Effect*>(const_cast<void*>(handle));
    if (a == action::kLoad) return load();
    if (a == action::kUnload) was_unloaded = true;
    if (a == action::kCreate) ++instances;
    if (a == action::kDestroy) --instances;
    if (a == action::kUnload || a == action::kCreate || a == action::kDestroy) return kOk;
    if (a == action::kDescribe) return describe(effect);
    if (a == action::kDescribeInContext) return describe_in_context(effect);
    if (a == action::kRender) return render(effect, in);
    if (a == action::kRegionOfDefinition) return region(in, out, false, 0);
    if (a == action::kRegionsOfInterest) return region(in, out, true, radius_of(effect));
    if (a == action::kIsIdentity) return identity(effect, out);
    if (a == action::kChanged) return fault("refuses_choice") ? kFailed : kReplyDefault;
    return fault("unknown_ok") ? kOk : kReplyDefault;
}

void take_host(Host* given) { host = given; }

}  // namespace

// Names of the specification: NOLINTBEGIN(readability-identifier-naming)
#define EXPORTED extern "C" __attribute__((visibility("default")))

#ifdef PLANTED_EXPORT
EXPORTED int planted_helper() { return 1; }
#endif
EXPORTED int OfxGetNumberOfPlugins() { return 1; }
EXPORTED ofx::Plugin* OfxGetPlugin(int nth) {
    static ofx::Plugin plugin{kImageEffectApi,
                              fault("wrong_version") ? 2 : 1,
                              fault("bad_identifier") ? "a plug-in" : "planted.blur",
                              1,
                              0,
                              take_host,
                              main_entry};
    return nth == 0 ? &plugin : nullptr;
}
// NOLINTEND(readability-identifier-naming)

#include "stage.h"

#include "instances.h"
#include "rules.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

namespace ofx_check {
namespace {

using Texts = std::vector<std::string>;

// Statuses that an action's page lists, beside Failed, Fatal and Memory, which all may return.
bool may_return(std::string_view action, int status) {
    if (status == ofx::kOk || status == ofx::kFailed || status == ofx::kFatal || status == ofx::kMemory)
        return true;
    if (action == ofx::action::kRender) return status == ofx::kUnlicensed || status == ofx::kImageFormat;
    if (action == ofx::action::kBeginSequence || action == ofx::action::kEndSequence)
        return status == ofx::kReplyDefault || status == ofx::kUnlicensed;
    const bool describes = action == ofx::action::kDescribe || action == ofx::action::kDescribeInContext ||
                           action == ofx::action::kLoad;
    if (describes && status == ofx::kMissingHostFeature) return true;
    return status == ofx::kReplyDefault;
}

std::string problem_of(const ofx::Plugin* plugin) {
    if (!plugin) return "OfxGetPlugin gives null";
    if (!plugin->api || std::strcmp(plugin->api, ofx::kImageEffectApi) != 0)
        return "its API is not that of image effects";
    if (plugin->api_version != 1) return "its API version is " + std::to_string(plugin->api_version);
    if (!plugin->identifier || !*plugin->identifier) return "it has no identifier";
    for (const char* c = plugin->identifier; *c; ++c)
        if (!std::isgraph(static_cast<unsigned char>(*c)))
            return "its identifier has characters that are not printable ASCII";
    if (!plugin->main_entry || !plugin->set_host) return "mainEntry or setHost is null";
    return "";
}

ofx::PropertySet& with_frame(ofx::PropertySet& in, const FrameRequest& request) {
    return in.with(ofx::kTime, std::vector<double>{request.time})
        .with(ofx::kRenderScale, std::vector<double>{request.scale.x, request.scale.y});
}

ofx::PropertySet& with_window(ofx::PropertySet& in, const ofx::RectI& w) {
    return in.with(ofx::kRenderWindow, std::vector<int>{w.x1, w.y1, w.x2, w.y2})
        .with(ofx::kFieldToRender, Texts{ofx::kFieldNone});
}

bool is_rectangle(const ofx::Rect& r) { return r.x1 <= r.x2 && r.y1 <= r.y2; }

ofx::Rect rect_of(const ofx::PropertySet& set, const char* name) {
    return {set.number(name, 0, 0), set.number(name, 0, 1), set.number(name, 0, 2), set.number(name, 0, 3)};
}

ofx::RectI in_pixels(const ofx::Rect& r, ofx::Point scale) {
    const auto px = [](double at) { return int(std::clamp(at, -1e6, 1e6)); };
    return {px(std::floor(r.x1 * scale.x)), px(std::floor(r.y1 * scale.y)), px(std::ceil(r.x2 * scale.x)),
            px(std::ceil(r.y2 * scale.y))};
}

// True while the host lies so that no plug-in can make a picture.
bool is_hopeless() {
    return property_lies.know_nothing || effect_lies.bad != EffectLies::Bad::None ||
           effect_lies.abort_after >= 0;
}

ofx::RectI grown(const ofx::RectI& r, int by) { return {r.x1 - by, r.y1 - by, r.x2 + by, r.y2 + by}; }

// The rendered window, with findings about pixels that should or should not have been written.
Picture checked_window(const FrameState& frame, const ofx::RectI& window, bool is_float) {
    if (!frame.output) return Picture(window, 4);
    const Picture all = frame.output->read();
    for (const char* trap : {"images.bounds", "images.input", "images.after_release", "params.write_action"})
        held(trap);
    if (!frame.output->surroundings_are_whole())
        broken("images.bounds", "bytes beside the output's rows were written");
    if (!is_float) return part_of(all, window);
    held("render.complete"), held("render.window");
    int unwritten = 0, beyond = 0;
    for (int y = all.bounds.y1; y < all.bounds.y2; ++y)
        for (int x = all.bounds.x1; x < all.bounds.x2; ++x) {
            const bool inside = x >= window.x1 && x < window.x2 && y >= window.y1 && y < window.y2;
            const bool written = !std::isnan(all.at(x, y, 0));
            unwritten += inside && !written;
            beyond += !inside && written;
        }
    if (unwritten > 0)
        broken("render.complete", std::to_string(unwritten) + " pixels of the window were not written");
    if (beyond > 0)
        broken("render.window", std::to_string(beyond) + " pixels outside of the window were written");
    return part_of(all, window);
}

}  // namespace

Stage::Stage(Setup setup) : setup_(std::move(setup)) {}

Stage::~Stage() { end(); }

int Stage::call(const char* action, const void* handle, ofx::PropertySet* in, ofx::PropertySet* out) {
    const char* before = std::exchange(action_now, action);
    const int status = plugin_->main_entry(action, handle, in, out);
    action_now = before;
    held("process.survives"), held("process.returns"), held("action.status");
    if (!may_return(action, status))
        broken("action.status", std::string(action) + " returned " + std::to_string(status));
    return status;
}

int Stage::tell_change(ofx::Effect& effect, const std::string& param, const FrameRequest& request) {
    ofx::PropertySet around("in"), in("in");
    around.with(ofx::kChangeReason, Texts{ofx::kUserEdited});
    with_frame(in, request)
        .with(ofx::kType, Texts{ofx::kTypeParameter})
        .with(ofx::kName, Texts{param})
        .with(ofx::kChangeReason, Texts{ofx::kUserEdited});
    call(ofx::action::kBeginChanged, &effect, &around, nullptr);
    const int status = call(ofx::action::kChanged, &effect, &in, nullptr);
    call(ofx::action::kEndChanged, &effect, &around, nullptr);
    return status;
}

bool Stage::begin() {
    if (!library_) library_ = std::make_unique<Library>(setup_.library, problem_);
    if (!library_->is_loaded()) return false;
    const int count = library_->plugin_count();
    if (count < 1) problem_ = "it holds no plug-in";
    plugin_ = nullptr;
    for (int i = 0; i < count && !plugin_; ++i) {
        ofx::Plugin* found = library_->plugin(i);
        held("plugin.struct");
        const std::string problem = problem_of(found);
        if (!problem.empty()) {
            broken("plugin.struct", problem);
            problem_ = problem;
            return false;
        }
        if (setup_.plugin.empty() || setup_.plugin == found->identifier) plugin_ = found;
    }
    if (!plugin_) {
        if (problem_.empty()) problem_ = "it holds no plug-in '" + setup_.plugin + "'";
        return false;
    }
    if (!setup_.host.empty()) the_host()->properties->with(ofx::kName, Texts{setup_.host});
    plugin_->set_host(the_host());
    const int loaded = call(ofx::action::kLoad, nullptr, nullptr, nullptr);
    is_loaded_ = loaded == ofx::kOk || loaded == ofx::kReplyDefault;
    if (!is_loaded_) problem_ = "OfxActionLoad returned " + std::to_string(loaded);
    if (!is_loaded_) return false;
    descriptor_ = std::make_unique<ofx::Effect>(false);
    descriptor_->properties.with(ofx::kType, Texts{ofx::kTypeEffect})
        .with(ofx::kFilePath, Texts{setup_.library});
    const int described = call(ofx::action::kDescribe, descriptor_.get(), nullptr, nullptr);
    if (described != ofx::kOk) problem_ = "OfxActionDescribe returned " + std::to_string(described);
    return described == ofx::kOk;
}

void Stage::end() {
    if (is_loaded_) call(ofx::action::kUnload, nullptr, nullptr, nullptr);
    is_loaded_ = false;
    described_.clear();
    descriptor_.reset();
}

std::vector<std::string> Stage::contexts() const {
    const Texts theirs = descriptor_->properties.texts(ofx::kContexts);
    std::vector<std::string> both;
    for (const char* ours : {ofx::kContextGeneral, ofx::kContextFilter, "OfxImageEffectContextGenerator"})
        if (std::find(theirs.begin(), theirs.end(), ours) != theirs.end()) both.emplace_back(ours);
    return both;
}

const ofx::Effect* Stage::described_in(const std::string& context) {
    std::unique_ptr<ofx::Effect>& described = described_[context];
    if (described) return described.get();
    described = std::make_unique<ofx::Effect>(false);
    described->properties.slots = descriptor_->properties.slots;
    ofx::PropertySet in("in");
    in.with(ofx::kContext, Texts{context});
    const int status = call(ofx::action::kDescribeInContext, described.get(), &in, nullptr);
    if (status == ofx::kOk) return described.get();
    problem_ = "OfxImageEffectActionDescribeInContext returned " + std::to_string(status) + " for " + context;
    described.reset();
    return nullptr;
}

std::unique_ptr<ofx::Effect> Stage::create(const Cast& cast) {
    const std::vector<std::string> known = contexts();
    if (known.empty()) return nullptr;
    const std::string& context = cast.context.empty() ? known[0] : cast.context;
    const ofx::Effect* described = described_in(context);
    if (!described) return nullptr;
    auto effect = instance_of(*descriptor_, *described, context, cast, setup_);
    const int status = call(ofx::action::kCreate, effect.get(), nullptr, nullptr);
    if (status != ofx::kOk && status != ofx::kReplyDefault) {
        problem_ = "OfxActionCreateInstance returned " + std::to_string(status);
        return nullptr;
    }
    take_preferences(*effect);
    return effect;
}

void Stage::destroy(std::unique_ptr<ofx::Effect> effect) {
    if (effect) call(ofx::action::kDestroy, effect.get(), nullptr, nullptr);
}

void Stage::take_preferences(ofx::Effect& effect) {
    ofx::PropertySet out("out", true);
    for (const auto& clip : effect.clips) {
        out.with((std::string(ofx::kComponentsOf) + clip->name).c_str(),
                 Texts{clip->properties.text(ofx::kComponents)});
        out.with((std::string(ofx::kDepthOf) + clip->name).c_str(),
                 Texts{clip->properties.text(ofx::kPixelDepth)});
        out.with((std::string(ofx::kAspectOf) + clip->name).c_str(), std::vector<double>{1});
        out.with((std::string(ofx::kColourspacesFor) + clip->name).c_str(), Texts{});
    }
    out.with(ofx::kPreMultiplication, Texts{ofx::kPreMultiplied});
    if (call(ofx::action::kClipPreferences, &effect, nullptr, &out) != ofx::kOk) return;
    for (const auto& clip : effect.clips) {
        const std::string wanted = out.text((std::string(ofx::kComponentsOf) + clip->name).c_str());
        const bool fits = wanted == ofx::kRgba || wanted == ofx::kRgb || wanted == ofx::kAlpha;
        if (fits && clip->name == ofx::kOutput) clip->properties.with(ofx::kComponents, Texts{wanted});
    }
}

ofx::RectI Stage::window_of(ofx::Effect& effect, const FrameRequest& request) {
    ofx::PropertySet in("in"), out("out", true);
    with_frame(in, request);
    const ofx::Clip* source = effect.find(ofx::kSource);
    const ofx::PropertySet& p = effect.properties;
    ofx::Rect region{p.number(ofx::kProjectOffset), p.number(ofx::kProjectOffset, 0, 1),
                     p.number(ofx::kProjectExtent), p.number(ofx::kProjectExtent, 0, 1)};
    if (source && !source->picture.values.empty()) {
        const ofx::RectI& b = source->picture.bounds;
        region = {double(b.x1), double(b.y1), double(b.x2), double(b.y2)};
    }
    out.with(ofx::kDefinition, std::vector<double>{region.x1, region.y1, region.x2, region.y2});
    if (call(ofx::action::kRegionOfDefinition, &effect, &in, &out) == ofx::kOk) {
        held("regions.valid");
        const ofx::Rect theirs = rect_of(out, ofx::kDefinition);
        if (!is_rectangle(theirs)) broken("regions.valid", "the region of definition ends before it begins");
        // An effect may reach beyond the project; this host renders its frame.
        region = {std::max(region.x1, theirs.x1), std::max(region.y1, theirs.y1),
                  std::min(region.x2, theirs.x2), std::min(region.y2, theirs.y2)};
    }
    return request.window ? *request.window : in_pixels(region, request.scale);
}

void Stage::ask_interest(ofx::Effect& effect, const FrameRequest& request, const ofx::RectI& w) {
    ofx::PropertySet in("in"), out("out", true);
    const std::vector<double> wanted{w.x1 / request.scale.x, w.y1 / request.scale.y, w.x2 / request.scale.x,
                                     w.y2 / request.scale.y};
    with_frame(in, request).with(ofx::kInterest, wanted);
    const auto name = [](const ofx::Clip& clip) { return std::string(ofx::kInterestOf) + clip.name; };
    for (const auto& clip : effect.clips)
        if (clip->name != ofx::kOutput) out.with(name(*clip).c_str(), wanted);
    call(ofx::action::kRegionsOfInterest, &effect, &in, &out);
    for (const auto& clip : effect.clips) {
        if (clip->name == ofx::kOutput) continue;
        const ofx::Rect needed = rect_of(out, name(*clip).c_str());
        held("regions.valid");
        if (!is_rectangle(needed))
            broken("regions.valid", "the region of interest in " + clip->name + " ends before it begins");
        state_of(effect).needed[clip.get()] = in_pixels(needed, request.scale);
    }
}

bool Stage::ask_identity(ofx::Effect& effect, const FrameRequest& request, const ofx::RectI& window,
                         Rendered& rendered) {
    ofx::PropertySet in("in"), out("out", true);
    with_window(with_frame(in, request), window);
    out.with(ofx::kName, Texts{""}).with(ofx::kTime, std::vector<double>{request.time});
    if (call(ofx::action::kIsIdentity, &effect, &in, &out) != ofx::kOk) return false;
    held("identity.valid");
    const std::string name = out.text(ofx::kName);
    const ofx::Clip* clip = effect.find(name);
    if (!clip || name == ofx::kOutput || clip->picture.values.empty()) {
        broken("identity.valid", "IsIdentity returned OK with the clip '" + name + "'");
        return false;
    }
    rendered.is_identity = true;
    rendered.picture = part_of(scaled(clip->picture, request.scale), window);
    return true;
}

int Stage::render_window(ofx::Effect& effect, const FrameRequest& request, const ofx::RectI& window) {
    ofx::PropertySet sequence("in"), in("in");
    const std::vector<int> no{0}, interactive{request.interactive};
    with_frame(sequence, request)
        .with(ofx::kFrameRange, std::vector<double>{request.time, request.time})
        .with(ofx::kFrameStep, std::vector<double>{1})
        .with(ofx::kIsInteractive, interactive)
        .with(ofx::kSequential, no)
        .with(ofx::kInteractive, interactive);
    call(ofx::action::kBeginSequence, &effect, &sequence, nullptr);
    with_window(with_frame(in, request), window)
        .with(ofx::kSequential, no)
        .with(ofx::kInteractive, interactive)
        .with(ofx::kDraft, interactive);
    const int open = counts.images_open, said = counts.messages;
    const int status = call(ofx::action::kRender, &effect, &in, nullptr);
    if (status == ofx::kReplyDefault) broken("action.status", "Render returned ReplyDefault");
    held("images.released");
    if (counts.images_open > open && !effect_lies.at_once) {
        broken("images.released",
               std::to_string(counts.images_open - open) + " images are still open after Render");
        counts.images_open = open;
    }
    const bool can_say = effect_lies.missing_suite != ofx::kMessageSuite && !property_lies.know_nothing;
    if (can_say && (status == ofx::kFailed || status == ofx::kImageFormat)) {
        held("errors.message");
        if (counts.messages == said)
            broken("errors.message", "Render returned " + std::to_string(status) + " and posted nothing");
    }
    call(ofx::action::kEndSequence, &effect, &sequence, nullptr);
    return status;
}

Rendered Stage::render(ofx::Effect& effect, const FrameRequest& request) {
    FrameState frame{request, nullptr, {}, {}};
    FrameState* before = std::exchange(frame_now, &frame);
    effect.frame = &frame;
    Rendered rendered;
    const ofx::RectI window = window_of(effect, request);
    ask_interest(effect, request, window);
    if (!ask_identity(effect, request, window, rendered)) {
        frame.output_bounds = grown(window, request.output_margin);
        rendered.status = render_window(effect, request, window);
        if (rendered.fine() && !is_hopeless())
            rendered.picture = checked_window(frame, window, depth_of(effect) == Depth::Float);
    }
    frame_now = before;
    effect.frame = nullptr;
    return rendered;
}

}  // namespace ofx_check

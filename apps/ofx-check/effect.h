// Effects, their clips and parameters, as the host keeps them; and the suites that give them to plug-ins.
#pragma once

#include "pixels.h"
#include "property_set.h"

#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace ofx_check {

// A frame as the host asks for it.
struct FrameRequest {
    double time = 1;
    ofx::Point scale{1, 1};
    std::optional<ofx::RectI> window;  // pixels; empty: all of the output's region
    Layout layout;
    int output_margin = 0;     // pixels of the output image beyond the window
    bool only_needed = false;  // inputs are given as far as the region of interest reaches
    bool interactive = false;
};

// Faults of this host, for one check.
struct EffectLies {
    std::string missing_suite;
    std::string no_image_of;   // this clip has none
    std::string bad_image_of;  // this clip's images are lies of the kind below
    enum class Bad { None, WrongDepth, NoData, NoSize } bad = Bad::None;
    int abort_after = -1;  // abort() answers 1 from that call on; -1: never
    bool at_once = false;  // several actions are under way: images of one are not told from another's
};
extern EffectLies effect_lies;

// Counted over one action.
struct Counts {
    std::atomic<int> aborts_asked{0}, messages{0}, images_open{0};
    std::string last_message;
    std::mutex mutex;
};
extern Counts counts;

// A frame under way.
struct FrameState {
    FrameRequest request;
    std::shared_ptr<GuardedImage> output;  // kept to be read
    ofx::RectI output_bounds{};
    std::map<const ofx::Clip*, ofx::RectI> needed{};  // pixels of inputs that the regions of interest gave
};

// The action that this thread's plug-in is in; null: none. And its frame, which threads of its own do not
// know.
extern thread_local const char* action_now;
extern thread_local FrameState* frame_now;
FrameState& state_of(const ofx::Effect& effect);

const void* fetch_suite(ofx::PropertySet* host, const char* name, int version);
ofx::Host* the_host();

const ofx::ImageEffectSuite& image_effect_suite();
const ofx::ParameterSuite& parameter_suite();

}  // namespace ofx_check

struct ofx::Param {
    std::string name, type;
    PropertySet properties{"param", true};
    std::array<double, 4> numbers{};
    std::string text;
};

struct ofx::ParamSet {
    PropertySet properties{"params", true};
    std::vector<std::unique_ptr<Param>> params;  // in the order of their definition

    Param* find(const std::string& name) const;
};

struct ofx::Clip {
    std::string name;
    PropertySet properties;
    ofx_check::Picture picture;  // at render scale 1; empty: not connected
    Effect* effect = nullptr;

    Clip(std::string clip_name, const char* object, bool plugin_writes)
        : name(std::move(clip_name)), properties(object, plugin_writes) {}
};

struct ofx::Effect {
    bool is_instance;
    PropertySet properties;
    ParamSet params;
    std::vector<std::unique_ptr<Clip>> clips;
    std::atomic<ofx_check::FrameState*> frame{nullptr};  // the last that was begun, by any thread

    explicit Effect(bool instance)
        : is_instance(instance), properties(instance ? "instance" : "effect", !instance) {}
    Clip* find(const std::string& name) const;
};

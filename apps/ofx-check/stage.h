// A plug-in on the stage: loaded, described, instances made, frames rendered, each action checked.
#pragma once

#include "effect.h"
#include "library.h"
#include "scenes.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ofx_check {

struct Setup {
    std::string library;
    std::string plugin;                         // identifier; empty: the first
    std::map<std::string, std::string> params;  // values over the defaults
    std::string host;                           // name that this host gives itself; empty: its own
    int width = 96, height = 64;
};

// Choices for a new instance.
struct Cast {
    std::string context;                           // empty: the first that both know
    bool only_mandatory = false;                   // optional clips are not connected
    ofx::Point origin{0, 0};                       // bottom left corner of the project and all clips
    std::map<std::string, Picture> pictures = {};  // by clip, instead of test pictures
};

struct Rendered {
    int status = ofx::kOk;
    bool is_identity = false;
    Picture picture;  // of the window
    bool fine() const { return status == ofx::kOk; }
};

class Stage {
public:
    explicit Stage(Setup setup);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    // Loads and describes. False, with findings where a rule is broken, if the plug-in cannot be used.
    bool begin();
    void end();  // unloads; the library stays open
    const ofx::Plugin* plugin() const { return plugin_; }
    const ofx::Effect& descriptor() const { return *descriptor_; }
    // Contexts of the plug-in that this host has.
    std::vector<std::string> contexts() const;
    const ofx::Effect* described_in(const std::string& context);
    bool supports_tiles() const { return descriptor_->properties.integer(ofx::kTiles, 1) != 0; }
    const std::string& problem() const { return problem_; }

    std::unique_ptr<ofx::Effect> create(const Cast& cast = {});
    void destroy(std::unique_ptr<ofx::Effect> effect);
    // All actions of a frame, as the page "Rendering" orders them.
    Rendered render(ofx::Effect& effect, const FrameRequest& request = {});
    // The three actions of a user's change of a parameter, whose value is set already. The status is that of
    // OfxActionInstanceChanged.
    int tell_change(ofx::Effect& effect, const std::string& param, const FrameRequest& request = {});
    // One action, its status checked.
    int call(const char* action, const void* handle, ofx::PropertySet* in, ofx::PropertySet* out);

private:
    void take_preferences(ofx::Effect& effect);
    ofx::RectI window_of(ofx::Effect& effect, const FrameRequest& request);
    void ask_interest(ofx::Effect& effect, const FrameRequest& request, const ofx::RectI& window);
    bool ask_identity(ofx::Effect& effect, const FrameRequest& request, const ofx::RectI& window,
                      Rendered& rendered);
    int render_window(ofx::Effect& effect, const FrameRequest& request, const ofx::RectI& window);

    Setup setup_;
    std::string problem_;
    std::unique_ptr<Library> library_;
    ofx::Plugin* plugin_ = nullptr;
    bool is_loaded_ = false;
    std::unique_ptr<ofx::Effect> descriptor_;
    std::map<std::string, std::unique_ptr<ofx::Effect>> described_;
};

}  // namespace ofx_check

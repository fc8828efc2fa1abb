// The three functions that hosts call, and the actions behind them.
#include "petzval/version.h"

#include "describe.h"
#include "host.h"
#include "params.h"
#include "render.h"

#include <exception>
#include <mutex>
#include <new>
#include <string_view>

namespace {

using namespace petzval::plugin;

// MLT loads again for each instance, while other threads render: only the first call between two unloads may
// write the suites and the session.
std::mutex loading;
bool is_loaded = false;

int load() {
    const std::lock_guard lock(loading);
    if (is_loaded) return ofx::kOk;
    if (!fetch_suites()) return ofx::kMissingHostFeature;
    open_session();
    is_loaded = true;
    return ofx::kOk;
}

int unload() {
    const std::lock_guard lock(loading);
    close_session();
    is_loaded = false;
    return ofx::kOk;
}

int changed(ofx::Effect* effect, const Properties& in) {
    if (in.text(ofx::kChangeReason) != ofx::kUserEdited) return ofx::kReplyDefault;
    return take_word_of_menu(effect, in.text(ofx::kName), in.number(ofx::kTime)) ? ofx::kOk
                                                                                 : ofx::kReplyDefault;
}

int about_frames(std::string_view action, ofx::Effect* effect, const Properties& in, const Properties& out) {
    if (action == ofx::action::kRender) return render(effect, in);
    if (action == ofx::action::kIsIdentity) return is_identity(effect, in, out);
    if (action == ofx::action::kRegionsOfInterest) return regions_of_interest(effect, in, out);
    if (action == ofx::action::kRegionOfDefinition) return region_of_definition(effect, in, out);
    if (action == ofx::action::kClipPreferences) return clip_preferences(effect, out);
    return ofx::kReplyDefault;
}

int act(std::string_view action, const void* handle, const Properties& in, const Properties& out) {
    if (action == ofx::action::kLoad) return load();
    if (action == ofx::action::kUnload) return unload();
    // All others are about an effect, and need the suites of kLoad.
    // The interface passes all handles as const: NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    auto* effect = static_cast<ofx::Effect*>(const_cast<void*>(handle));
    if (!suites().property || !suites().effect || !suites().parameter) return ofx::kMissingHostFeature;
    if (action == ofx::action::kCreate || action == ofx::action::kDestroy) return ofx::kOk;
    if (!effect) return ofx::kReplyDefault;
    if (action == ofx::action::kDescribe) return describe(effect);
    if (action == ofx::action::kDescribeInContext) return describe_in_context(effect);
    if (action == ofx::action::kChanged) return changed(effect, in);
    return about_frames(action, effect, in, out);
}

// Nothing is thrown into a host.
int main_entry(const char* action, const void* handle, ofx::PropertySet* in, ofx::PropertySet* out) {
    if (!action) return ofx::kReplyDefault;
    try {
        return act(action, handle, Properties(in), Properties(out));
    } catch (const std::bad_alloc&) {
        return ofx::kMemory;
    } catch (const std::exception&) {
        return ofx::kFailed;
    }
}

void take_host(ofx::Host* host) { set_host(host); }

}  // namespace

// Names of the specification: NOLINTBEGIN(readability-identifier-naming)
extern "C" {

#define PETZVAL_OFX_EXPORT __attribute__((visibility("default")))

PETZVAL_OFX_EXPORT int OfxSetHost(const ofx::Host* host) {
    set_host(host);
    return ofx::kOk;
}

PETZVAL_OFX_EXPORT int OfxGetNumberOfPlugins() { return 1; }

PETZVAL_OFX_EXPORT ofx::Plugin* OfxGetPlugin(int nth) {
    static ofx::Plugin plugin{ofx::kImageEffectApi,  1,         "petzval.defocus", PETZVAL_VERSION_MAJOR,
                              PETZVAL_VERSION_MINOR, take_host, main_entry};
    return nth == 0 ? &plugin : nullptr;
}
}
// NOLINTEND(readability-identifier-naming)

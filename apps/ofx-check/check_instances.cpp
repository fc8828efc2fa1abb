// Several instances, several threads, several lives, menus and the overlay.
#include "checks.h"
#include "rules.h"

#include <algorithm>
#include <array>
#include <dlfcn.h>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <thread>
#include <utility>

namespace ofx_check {
namespace {

// Another value for the first number that a slider shows. False if the effect has none.
bool change_a_number(ofx::Effect& effect) {
    for (const auto& param : effect.params.params) {
        if (param->type != ofx::param::kDouble) continue;
        for (const char* end : {ofx::param::kDisplayMax, ofx::param::kDisplayMin, ofx::param::kMax}) {
            const std::vector<double> value = param->properties.numbers(end);
            if (value.empty() || value[0] == param->numbers[0]) continue;
            param->numbers[0] = value[0];
            return true;
        }
    }
    return false;
}

}  // namespace

void check_instances(const Setup& setup) {
    Scene scene(setup, {"instances.apart"});
    if (!scene) return;
    auto other = scene.stage.create();
    if (!other) return not_tried("instances.apart", scene.stage.problem());
    change_a_number(*other);
    const Rendered theirs = scene.stage.render(*other);
    expect_same("instances.apart", scene.stage.render(*scene.effect), scene.plain.picture,
                "beside another instance");
    if (theirs.fine())
        expect_same("instances.apart", scene.stage.render(*other), theirs.picture, "the other, again");
    scene.stage.destroy(std::move(other));
    expect_same("instances.apart", scene.stage.render(*scene.effect), scene.plain.picture,
                "after the other's end");
}

void check_threads(const Setup& setup) {
    Scene scene(setup, {"threads.same"});
    if (!scene) return;
    const std::string safety = scene.stage.descriptor().properties.text(ofx::kThreadSafety);
    if (safety == ofx::kUnsafe) return not_tried("threads.same", "the plug-in calls itself unsafe");
    const bool shared = safety == ofx::kFullySafe;
    constexpr std::size_t kThreads = 4;
    std::array<std::unique_ptr<ofx::Effect>, kThreads> effects;
    std::array<std::array<Rendered, 3>, kThreads> rendered;
    for (auto& effect : effects)
        if (!shared) effect = scene.stage.create();
    effect_lies.at_once = true;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < kThreads; ++i)
        threads.emplace_back([&, i] {
            for (Rendered& r : rendered[i]) r = scene.stage.render(effects[i] ? *effects[i] : *scene.effect);
        });
    for (std::thread& thread : threads) thread.join();
    held("images.released");
    if (counts.images_open > 0)
        broken("images.released", std::to_string(counts.images_open) + " are open after all threads' frames");
    for (const auto& of_thread : rendered)
        for (const Rendered& r : of_thread)
            expect_same("threads.same", r, scene.plain.picture,
                        shared ? "one instance" : "an instance for each thread");
    for (auto& effect : effects) scene.stage.destroy(std::move(effect));
}

namespace {

int threads_of_process() {
    std::error_code none;
    const std::filesystem::directory_iterator tasks("/proc/self/task", none), end;
    return none ? 0 : int(std::distance(tasks, end));
}

// A host may close the library after OfxActionUnload: HostSupport of OpenFX does after it has described a
// plug-in.
void expect_no_threads(const Setup& setup, int before) {
    held("reload.threads");
    const int more = threads_of_process() - before;
    if (more <= 0) return;
    if (void* kept = dlopen(setup.library.c_str(), RTLD_LAZY | RTLD_NOLOAD)) {
        dlclose(kept);
        return;
    }
    broken("reload.threads",
           std::to_string(more) + " threads run after OfxActionUnload in a library that dlclose unmaps");
}

}  // namespace

void check_reload(const Setup& setup) {
    Picture before;
    const int threads = threads_of_process();
    {
        Scene scene(setup, {"reload.same", "reload.threads"});
        if (!scene) return;
        before = scene.plain.picture;
        held("reload.same");
        scene.stage.destroy(std::move(scene.effect));
        scene.stage.end();
        if (!scene.stage.begin())
            return broken("reload.same", "after OfxActionUnload: " + scene.stage.problem());
        scene.effect = scene.stage.create();
        if (!scene.effect) return broken("reload.same", "after OfxActionUnload: " + scene.stage.problem());
        expect_same("reload.same", scene.stage.render(*scene.effect), before, "loaded again");
    }
    expect_no_threads(setup, threads);
    Scene again(setup, {"reload.same"});  // the library itself was closed
    if (again) expect_same("reload.same", again.plain, before, "the library opened again");
}

void check_menus(const Setup& setup) {
    Scene scene(setup, {"params.chosen"});
    if (!scene) return;
    bool has_menu = false;
    for (const auto& param : scene.effect->params.params) {
        const std::size_t words = param->properties.texts(ofx::param::kChoiceOption).size();
        for (std::size_t i = 0; param->type == ofx::param::kChoice && i < words; ++i) {
            has_menu = true;
            held("params.chosen");
            param->numbers[0] = double(i);
            const int status = scene.stage.tell_change(*scene.effect, param->name);
            if (status != ofx::kOk && status != ofx::kReplyDefault)
                broken("params.chosen", "word " + std::to_string(i) + " of '" + param->name +
                                            "' gives status " + std::to_string(status));
        }
    }
    if (!has_menu) not_tried("params.chosen", "the plug-in has no menu");
}

namespace {

struct Overlay {
    ofx::MainEntry entry;
    ofx::PropertySet instance{"interact", true};
    ofx::PropertySet arguments{"in"};
    int call(const char* action) {
        const char* before = std::exchange(action_now, action);
        const int status = entry(action, &instance, &arguments, nullptr);
        action_now = before;
        held("overlay.survives");
        const bool known = status == ofx::kOk || status == ofx::kReplyDefault || status == ofx::kFailed ||
                           status == ofx::kFatal || status == ofx::kMemory;
        if (!known) broken("overlay.survives", std::string(action) + " returned " + std::to_string(status));
        return status;
    }
};

}  // namespace

void check_overlay(const Setup& setup) {
    Scene scene(setup, {"overlay.survives"});
    if (!scene) return;
    const auto& p = scene.stage.descriptor().properties;
    void* entry = p.pointer(ofx::kOverlayV2);
    if (!entry) return not_tried("overlay.survives", "the plug-in has no overlay for the draw suite");
    Overlay overlay{reinterpret_cast<ofx::MainEntry>(entry)};
    overlay.instance.with(ofx::kEffectInstance, scene.effect.get())
        .with(ofx::kPixelScale, std::vector<double>{1, 1});
    overlay.arguments.with(ofx::kEffectInstance, scene.effect.get())
        .with(ofx::kTime, std::vector<double>{1})
        .with(ofx::kPixelScale, std::vector<double>{1, 1})
        .with(ofx::kRenderScale, std::vector<double>{1, 1})
        .with("OfxInteractPropBackgroundColour", std::vector<double>{0, 0, 0})
        .with(ofx::kPenPosition, std::vector<double>{setup.width / 2.0, setup.height / 2.0})
        .with(ofx::kPenPressure, std::vector<double>{1});
    int canvas = 0;
    overlay.call(ofx::action::kDescribe);
    overlay.call(ofx::action::kCreate);
    for (void* context : {static_cast<void*>(nullptr), static_cast<void*>(&canvas)}) {
        overlay.arguments.with(ofx::kDrawContext, context);
        overlay.call(ofx::action::kDraw);
    }
    for (const char* action : {ofx::action::kPenDown, ofx::action::kPenMotion, ofx::action::kPenUp})
        overlay.call(action);
    overlay.call(ofx::action::kDestroy);
}

}  // namespace ofx_check

// Checks by a host without suites, without properties, or with wrong images.
#include "checks.h"
#include "rules.h"

#include <atomic>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace ofx_check {

void check_missing_suite(const Setup& setup, const char* suite) {
    effect_lies.missing_suite = suite;
    Stage stage(setup);
    held("host.missing_suite");
    if (!stage.begin()) return;  // it said so by a status
    auto effect = stage.create();
    if (!effect) return;
    stage.render(*effect);
    stage.destroy(std::move(effect));
}

void check_null_handles(const Setup& setup) {
    Scene scene(setup, {"host.null_handles"});
    if (!scene) return;
    for (const char* action : {ofx::action::kPurgeCaches, ofx::action::kSync, ofx::action::kBeginChanged,
                               ofx::action::kEndChanged}) {
        held("host.null_handles");
        scene.stage.call(action, scene.effect.get(), nullptr, nullptr);
    }
    // A host that knows no property, not even those of images.
    property_lies.know_nothing = true;
    scene.stage.render(*scene.effect);
    property_lies.know_nothing = false;
    held("host.null_handles");
    expect_same("host.null_handles", scene.stage.render(*scene.effect), scene.plain.picture,
                "the frame after");
}

// MLT sends OfxActionLoad for each instance, without OfxActionUnload between, while other threads render.
void check_loads(const Setup& setup) {
    Scene scene(setup, {"host.loads_again"});
    if (!scene) return;
    effect_lies.at_once = true;
    std::atomic<bool> is_over = false;
    std::atomic<int> loads = 0;
    std::vector<Rendered> rendered;
    std::thread other([&] {  // on a busy machine, three frames may be rendered before the first load
        while (rendered.size() < 3 || loads < 3) rendered.push_back(scene.stage.render(*scene.effect));
        is_over = true;
    });
    while (!is_over) {
        ofx::Effect again(false);
        again.properties.with(ofx::kType, std::vector<std::string>{ofx::kTypeEffect});
        scene.stage.call(ofx::action::kLoad, nullptr, nullptr, nullptr);
        scene.stage.call(ofx::action::kDescribe, &again, nullptr, nullptr);
        ++loads;
    }
    other.join();
    for (const Rendered& r : rendered)
        expect_same("host.loads_again", r, scene.plain.picture, "loaded again meanwhile");
    expect_same("host.loads_again", scene.stage.render(*scene.effect), scene.plain.picture,
                "the frame after");
}

void check_no_image(const Setup& setup) {
    Scene scene(setup, {"host.no_image"});
    if (!scene || !scene.effect->find(ofx::kSource)) return;
    effect_lies.no_image_of = ofx::kSource;
    counts.messages = 0;
    const Rendered rendered = scene.stage.render(*scene.effect);
    held("host.no_image");
    if (!rendered.fine() && counts.messages == 0)
        broken("host.no_image", "status " + std::to_string(rendered.status) + " and no message");
}

void check_bad_image(const Setup& setup, EffectLies::Bad bad) {
    Scene scene(setup, {"host.bad_image"});
    if (!scene || !scene.effect->find(ofx::kSource)) return;
    for (const char* clip : {ofx::kSource, ofx::kOutput}) {
        effect_lies.bad_image_of = clip;
        effect_lies.bad = bad;
        held("host.bad_image");
        const Rendered rendered = scene.stage.render(*scene.effect);
        if (rendered.fine() && bad == EffectLies::Bad::WrongDepth)
            broken("host.bad_image", std::string(clip) + " of half floats was taken for something else");
    }
}

}  // namespace ofx_check

// Frames in every form that a host may ask for.
#include "checks.h"
#include "rules.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ofx_check {

void check_contexts(const Setup& setup) {
    Stage stage(setup);
    if (!stage.begin()) return not_tried("render.contexts", stage.problem());
    for (const std::string& context : stage.contexts()) {
        held("render.contexts");
        auto effect = stage.create({context});
        if (!effect) {
            broken("render.contexts", stage.problem());
            continue;
        }
        const Rendered first = stage.render(*effect);
        if (first.fine()) {
            expect_same("render.repeat", stage.render(*effect), first.picture,
                        "the second time in " + context);
        } else if (counts.messages == 0) {
            broken("render.contexts", context + ": status " + std::to_string(first.status));
        } else {
            not_tried("render.repeat", "status " + std::to_string(first.status) + ": " + counts.last_message);
        }
        stage.destroy(std::move(effect));
    }
}

void check_rows(const Setup& setup) {
    Scene scene(setup, {"rows.negative", "rows.padding", "bounds.offset"});
    if (!scene) return;
    FrameRequest request;
    trying("rows.padding");
    for (const int padding : {4, 20}) {
        request.layout = {false, padding};
        expect_same("rows.padding", scene.stage.render(*scene.effect, request), scene.plain.picture,
                    std::to_string(padding) + " bytes after each row");
    }
    trying("rows.negative");
    for (const int padding : {0, 12}) {
        request.layout = {true, padding};
        expect_same("rows.negative", scene.stage.render(*scene.effect, request), scene.plain.picture,
                    "rows from the top down");
    }
    request.layout = {};
    request.output_margin = 3;
    trying("bounds.offset");
    expect_same("bounds.offset", scene.stage.render(*scene.effect, request), scene.plain.picture,
                "an output with 3 pixels more on each side");
    Cast moved;
    moved.origin = {-37, 11};
    auto elsewhere = scene.stage.create(moved);
    if (!elsewhere) return;
    const Rendered there = scene.stage.render(*elsewhere);
    if (!there.fine())
        broken("bounds.offset", "a project that begins at -37,11: status " + std::to_string(there.status));
    scene.stage.destroy(std::move(elsewhere));
}

// Half of the picture's size, compared with the whole picture made smaller: it may differ by half of
// the change that the effect makes.
void check_scale(const Setup& setup) {
    Scene scene(setup, {"scale.half"});
    if (!scene) return;
    FrameRequest request;
    request.scale = {0.5, 0.5};
    const Rendered half = scene.stage.render(*scene.effect, request);
    held("scale.half");
    if (!half.fine()) return broken("scale.half", "status " + std::to_string(half.status));
    const Picture wanted = scaled(scene.plain.picture, request.scale);
    const ofx::Clip* source = scene.effect->find(ofx::kSource);
    if (!source || source->picture.values.size() != scene.plain.picture.values.size()) return;
    const double effect = mean_difference(scaled(source->picture, request.scale), wanted);
    const double wrong = mean_difference(half.picture, wanted);
    if (wrong > 0.5 * effect + 1e-3)
        broken("scale.half", "it is " + std::to_string(wrong) +
                                 " from the smaller whole; the effect itself changes " +
                                 std::to_string(effect));
}

void check_parts(const Setup& setup) {
    Scene scene(setup, {"window.part", "regions.enough"});
    if (!scene) return;
    if (!scene.stage.supports_tiles()) {
        not_tried("window.part", "the plug-in supports no tiles");
        return not_tried("regions.enough", "the plug-in supports no tiles");
    }
    const ofx::RectI& all = scene.plain.picture.bounds;
    FrameRequest request;
    request.window = ofx::RectI{all.x1 + 13, all.y1 + 7, all.x1 + 13 + (all.x2 - all.x1) / 2,
                                all.y1 + 7 + (all.y2 - all.y1) / 2};
    const Picture wanted = part_of(scene.plain.picture, *request.window);
    expect_same("window.part", scene.stage.render(*scene.effect, request), wanted, "a part of the window");
    request.only_needed = true;
    trying("regions.enough");
    expect_same("regions.enough", scene.stage.render(*scene.effect, request), wanted,
                "inputs cut to the region of interest");
}

void check_optional_clips(const Setup& setup) {
    Stage stage(setup);
    if (!stage.begin()) return not_tried("clips.optional", stage.problem());
    Cast cast;
    cast.only_mandatory = true;
    auto effect = stage.create(cast);
    if (!effect) return not_tried("clips.optional", stage.problem());
    const auto optional = [](const auto& clip) { return clip->properties.integer(ofx::kOptional) != 0; };
    if (std::none_of(effect->clips.begin(), effect->clips.end(), optional)) {
        not_tried("clips.optional", "no clip is optional");
    } else {
        held("clips.optional");
        const Rendered rendered = stage.render(*effect);
        if (!rendered.fine() && counts.messages == 0)
            broken("clips.optional", "status " + std::to_string(rendered.status) + " and no message");
    }
    stage.destroy(std::move(effect));
}

void check_abort(const Setup& setup) {
    constexpr double kLong = 0.5;  // seconds
    Scene scene(setup, {"abort.obeyed"});
    if (!scene) return;
    counts.aborts_asked = 0;
    effect_lies.abort_after = 0;
    const double start = seconds_now();
    scene.stage.render(*scene.effect);
    const double took = seconds_now() - start;
    effect_lies.abort_after = -1;
    held("abort.obeyed");
    if (counts.aborts_asked == 0 && scene.plain_seconds > kLong)
        broken("abort.obeyed", "a frame of " + std::to_string(scene.plain_seconds) + " s never asks");
    if (counts.aborts_asked > 0 && took > kLong && took > 0.8 * scene.plain_seconds)
        broken("abort.obeyed", "it asks whether to abort and continues: " + std::to_string(took) + " s");
    expect_same("abort.obeyed", scene.stage.render(*scene.effect), scene.plain.picture, "the frame after");
}

void check_extremes(const Setup& setup) {
    Scene scene(setup, {"params.extremes"});
    if (!scene) return;
    for (const auto& param : scene.effect->params.params) {
        const auto before = param->numbers;
        for (const char* end : {ofx::param::kMin, ofx::param::kMax}) {
            const std::vector<double> numbers = param->properties.numbers(end);
            if (numbers.empty()) continue;
            std::copy_n(numbers.begin(), std::min(numbers.size(), before.size()), param->numbers.begin());
            held("params.extremes");
            counts.messages = 0;
            const Rendered rendered = scene.stage.render(*scene.effect);
            if (!rendered.fine() && counts.messages == 0)
                broken("params.extremes", "'" + param->name + "' at " + std::to_string(numbers[0]) +
                                              ": status " + std::to_string(rendered.status) +
                                              " and no message");
        }
        param->numbers = before;
    }
    expect_same("params.extremes", scene.stage.render(*scene.effect), scene.plain.picture, "the frame after");
}

}  // namespace ofx_check

#include "engine_options.h"

#include "text.h"

#include <algorithm>

namespace petzval::cli {
namespace {

const NameTable<int> kTaps{{"16", 16}, {"22", 22}, {"43", 43}, {"71", 71}};
const NameTable<bool> kCocOfFour{{"mean", false}, {"extreme", true}};
const NameTable<bool> kSwitch{{"off", false}, {"on", true}};

std::optional<GaussianView> gaussian_view(ViewKind view) {
    switch (view) {
        case ViewKind::Sharp:
            return GaussianView::Sharp;
        case ViewKind::BlurSmall:
            return GaussianView::BlurSmall;
        case ViewKind::BlurLarge:
            return GaussianView::BlurLarge;
        case ViewKind::FocusIndex:
            return GaussianView::FocusIndex;
        default:
            return std::nullopt;
    }
}

ScatterView scatter_view(ViewKind view) {
    switch (view) {
        case ViewKind::Layers:
            return ScatterView::Layers;
        case ViewKind::Levels:
            return ScatterView::Levels;
        case ViewKind::Highlights:
            return ScatterView::Highlights;
        default:
            return ScatterView::Result;
    }
}

void require(bool fits, bool given, const std::string& flag, const std::string& needed) {
    if (given && !fits) throw UsageError(flag + " has no effect without " + needed);
}

}  // namespace

void EngineOptionFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Engine gather")
        .choice<GatherStage>(
            "--gather-stage",
            "a stop of the published method in place of the result; final (default) is the engine itself",
            gather_stage)
        .choice("--gather-taps", "samples of the published disc (default 43)", kTaps, gather_taps)
        .choice("--gather-coc", "the radius of 2 x 2 pixels in the published prefilter (default mean)",
                kCocOfFour, gather_extreme_coc)
        .choice("--gather-fill", "continue what near things hide under their soft edges (default on)",
                kSwitch, gather_fill);
    FlagGroup(verb, "Engine gaussian")
        .choice<GaussianStyle>("--gaussian-style",
                               "near and far apart (layered, default), by each pixel's radius (plain), or by "
                               "depth, as published (wgld)",
                               gaussian_style)
        .value("--focus-band", "N",
               "hold radii up to N px sharp (default 0); wgld: the band's share of all depth (default 0.2)",
               parse_not_negative, focus_band)
        .value("--depth-offset", "N",
               "wgld: added to depth of 0 to 1; the default puts the focus into the band", parse_number,
               depth_offset)
        .value("--depth-band-range", "NEAR,FAR",
               "wgld: depths that count as 0 and 1, as 0.1m,30m; default: the picture's", parse_range_m,
               depth_band_range_m);
    FlagGroup(verb, "Engine sprites")
        .value("--points", "FILE.csv",
               "lights to draw: columns x, y, depth or coc, r, g, b, perhaps size, named in its first line",
               parse_text, points)
        .choice<SpriteBackground>("--background", "the engine that draws everything else (default gather)",
                                  background)
        .choice("--find-points", "draw the picture's own bright points as kernels too (default on)", kSwitch,
                find_points)
        .value("--bright-factor", "N", "how many times its surroundings a bright point is (default 3)",
               parse_positive, bright_factor);
}

void EngineOptionFlags::check(const std::string& engine, ViewKind view) const {
    const bool sprites = engine == "sprites";
    const bool over_gaussian = sprites && background == SpriteBackground::Gaussian;
    const bool gather = engine == "gather", gaussian = engine == "gaussian";
    require(gather, gather_stage.has_value(), "--gather-stage", "--engine gather");
    require(gather && gather_stage, gather_taps.has_value(), "--gather-taps", "--gather-stage");
    require(gather && gather_stage, gather_extreme_coc.has_value(), "--gather-coc", "--gather-stage");
    require((gather && !gather_stage) || (sprites && !over_gaussian), gather_fill.has_value(),
            "--gather-fill", "--engine gather");
    require(gaussian || over_gaussian, gaussian_style.has_value(), "--gaussian-style", "--engine gaussian");
    require(gaussian || over_gaussian, focus_band.has_value(), "--focus-band", "--engine gaussian");
    const bool wgld = (gaussian || over_gaussian) && gaussian_style == GaussianStyle::Wgld;
    require(wgld, depth_offset.has_value(), "--depth-offset", "--gaussian-style wgld");
    require(wgld, depth_band_range_m.has_value(), "--depth-band-range", "--gaussian-style wgld");
    require(sprites, !points.empty(), "--points", "--engine sprites");
    require(sprites, background.has_value(), "--background", "--engine sprites");
    require(sprites, find_points.has_value(), "--find-points", "--engine sprites");
    require(sprites && find_points.value_or(true), bright_factor.has_value(), "--bright-factor",
            "--engine sprites and --find-points on");
    if (gaussian_view(view) && !gaussian)
        throw UsageError(std::string("--view ") + name_of(view) + " is a buffer of --engine gaussian");
    if (scatter_view(view) != ScatterView::Result && engine != "scatter")
        throw UsageError(std::string("--view ") + name_of(view) + " shows what --engine scatter does, not " +
                         engine);
    if (wgld && focus_band.value_or(0) > 1)
        throw UsageError("--focus-band " + plain(*focus_band) +
                         ": a share of all depth with --gaussian-style "
                         "wgld, 0 to 1");
}

void EngineOptionFlags::apply(DefocusJob& job, ViewKind view) const {
    job.scatter.view = scatter_view(view);
    job.gather.stage = gather_stage.value_or(job.gather.stage);
    job.gather.taps = gather_taps.value_or(job.gather.taps);
    job.gather.extreme_coc = gather_extreme_coc.value_or(job.gather.extreme_coc);
    job.gather.fill_hidden = gather_fill.value_or(job.gather.fill_hidden);
    job.gaussian.style = gaussian_style.value_or(job.gaussian.style);
    job.gaussian.view = gaussian_view(view).value_or(job.gaussian.view);
    job.gaussian.focus_band = focus_band;
    job.gaussian.depth_offset = depth_offset;
    if (depth_band_range_m) {
        job.gaussian.depth_near_m = depth_band_range_m->low;
        job.gaussian.depth_far_m = depth_band_range_m->high;
    }
    job.sprites.background = background.value_or(job.sprites.background);
    job.sprites.find = find_points.value_or(job.sprites.find);
    job.sprites.bright_factor = bright_factor.value_or(job.sprites.bright_factor);
}

Json EngineOptionFlags::json() const {
    Json given = Json::object();
    if (gather_stage) given["gather_stage"] = name_of(*gather_stage);
    if (gather_taps) given["gather_taps"] = *gather_taps;
    if (gather_extreme_coc) given["gather_coc"] = kCocOfFour[std::size_t(*gather_extreme_coc)].first;
    if (gather_fill) given["gather_fill"] = *gather_fill;
    if (gaussian_style) given["gaussian_style"] = name_of(*gaussian_style);
    if (focus_band) given["focus_band"] = number(*focus_band);
    if (depth_offset) given["depth_offset"] = number(*depth_offset);
    if (depth_band_range_m)
        given["depth_band_range_m"] = {number(depth_band_range_m->low), number(depth_band_range_m->high)};
    if (!points.empty()) given["points"] = points;
    if (background) given["background"] = name_of(*background);
    if (find_points) given["find_points"] = *find_points;
    if (bright_factor) given["bright_factor"] = number(*bright_factor);
    return given;
}

}  // namespace petzval::cli

// petzval_bench_flicker SHOT FOLDER WIDTH FRAMES SAMPLES ENGINE: one shot, by name or as random:SEED-move or
// random:SEED-temporal, through an engine, and its truth by
// a ray tracer with SAMPLES lens samples per pixel. Frames as PNG, a contact sheet of both with the change of
// the error between frames (grey: none), and the measures of tests/flicker/flicker.h as JSON. Without words,
// the names of the shots.
#include "flicker.h"

#include "petzval/develop.h"
#include "petzval/files.h"

#include "process.h"

#include <cstdio>
#include <cstdlib>

namespace {

using namespace petzval;
using bench::fail;
using flicker::Frames;

constexpr int kEachSide = 4;  // of --temporal

struct NamedShot {
    std::string name;
    bool moves;  // the scene; else the focus
    std::string scene;
    double from_m = 0, to_m = 0, wider = 1;
    int temporal = 0;  // frames on each side
    std::uint64_t seed = 1;
};

const NamedShot kShots[] = {
    {"night-pull", false, "night", 8, 3},
    {"table-pull", false, "table", 1.8, 0.8},
    {"fence-pull", false, "fence", 6, 1.5},
    {"night-move", true, "night"},
    {"fence-move", true, "fence"},
    {"post-move", true, "post"},
    {"night-temporal", true, "night", 0, 0, 1, kEachSide},
    {"fence-temporal", true, "fence", 0, 0, 1, kEachSide},
    {"post-temporal", true, "post", 0, 0, 1, kEachSide},
};

NamedShot shot_named(const std::string& name) {
    for (const NamedShot& shot : kShots)
        if (shot.name == name) return shot;
    const std::string start = "random:";
    const std::size_t dash = name.find('-');
    const std::string kind = dash == std::string::npos ? "" : name.substr(dash);
    if (!name.starts_with(start) || (kind != "-move" && kind != "-temporal")) fail("no shot " + name);
    NamedShot shot{name, true, "random"};
    shot.temporal = kind == "-temporal" ? kEachSide : 0;
    shot.seed = std::stoull(name.substr(start.size()));
    return shot;
}

void write(const std::string& path, View<const Rgba> picture, ToneCurve tone) {
    DevelopSettings settings;
    settings.tone = tone;
    settings.dither = false;
    const PngPixels png{picture.width(), picture.height(), 3, 8, develop(picture, settings)};
    if (const Status status = write_png(path, png); !status) fail(status.error().message);
}

// Result above truth above eight times the change of the error since the frame before, on middle grey.
Picture sheet_of(const Frames& result, const Frames& truth) {
    constexpr int kColumns = 6;
    const int width = truth[0].width(), height = truth[0].height();
    const int shown = std::min(int(truth.size()), 2 * kColumns), rows = (shown + kColumns - 1) / kColumns;
    Picture sheet(kColumns * width, rows * 3 * height);
    for (int i = 0; i < shown; ++i) {
        const std::size_t t = std::size_t(i) * truth.size() / std::size_t(shown), before = t > 0 ? t - 1 : 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Rgba change =
                    (result[t](x, y) - truth[t](x, y)) - (result[before](x, y) - truth[before](x, y));
                const int u = i % kColumns * width + x, v = i / kColumns * 3 * height + y;
                sheet(u, v) = result[t](x, y);
                sheet(u, v + height) = truth[t](x, y);
                sheet(u, v + 2 * height) = Rgba{0.2f, 0.2f, 0.2f, 1} + 8 * change;
            }
    }
    return sheet;
}

void write_all(const std::string& folder, const std::string& name, const Frames& result,
               const Frames& truth) {
    const std::string stem = folder + "/" + name + "_";
    for (std::size_t t = 0; t < result.size(); ++t) {
        char ending[16];
        std::snprintf(ending, sizeof ending, "%04d.png", int(t));
        write(stem + ending, result[t], ToneCurve::Filmic);
    }
    write(stem + "sheet.png", sheet_of(result, truth), ToneCurve::None);
}

}  // namespace

int main(int count, char** words) {
    if (count == 1) {
        for (const NamedShot& shot : kShots) std::printf("%s\n", shot.name.c_str());
        return 0;
    }
    if (count != 7) fail("SHOT FOLDER WIDTH FRAMES SAMPLES ENGINE");
    const int width = std::atoi(words[3]), frames = std::atoi(words[4]), samples = std::atoi(words[5]);
    const NamedShot named = shot_named(words[1]);
    const flicker::Size size{width, width * 9 / 16};
    flicker::Shot shot = named.moves ? flicker::camera_move(named.scene, size, 0, frames, samples, named.seed)
                                     : flicker::focus_pull(named.scene, size, frames, named.from_m,
                                                           named.to_m, named.wider, samples);
    if (named.temporal > 0) flicker::look_around(shot, named.temporal);
    const Frames result = flicker::defocused(shot, words[6]);
    const flicker::Steadiness found = flicker::measure(result, shot.truth);
    write_all(words[2], named.name, result, shot.truth);
    std::printf(
        "{\"error_db\": %.2f, \"change_db\": %.2f, \"worst_pop\": %.5f, \"shake\": %.4f, \"frame\": %d, "
        "\"x\": %d, \"y\": %d}\n",
        found.error_db, found.change_db, found.worst_pop, found.shake, found.frame, found.x, found.y);
}

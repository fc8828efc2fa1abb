// petzval_bench_completion FOLDER [--engine NAME] [--quality NAME] [--keep FOLDER] [--known] SHOT…: how close
// results come to the truth where hidden surfaces are estimated or, with --known, supplied as layers of the
// scene. Shots are those of completion_shots.h, their pictures lie in FOLDER. The program prints one line of
// JSON per shot: dB over the whole frame and over the pixels that the blur of silhouettes reaches, shake and
// worst pop if it has three frames (tests/flicker/flicker.h), CPU seconds of drawing one frame, and the worst
// squares. --keep also writes the results, as SHOT.FRAME.exr. --rules: for each number of the
// estimate (engine/samples/completion_model.h), or with --only NAME,NAME… for those named, the same with the
// number switched off, halved and doubled. --set NAME=VALUE,NAME=VALUE…: with other numbers throughout.
#include "petzval/files.h"
#include "petzval/names.h"

#include "completion_shots.h"
#include "engine/samples/completion_model.h"
#include "flicker.h"
#include "process.h"

#include <cctype>
#include <cmath>
#include <cstdio>

namespace {

using namespace petzval;
using bench::CompletionShot;
using bench::fail;
using bench::Still;

struct Asked {
    std::string folder, engine = "scatter", keep;
    Quality quality = Quality::Standard;
    bool known = false, rules = false;
    std::string only;  // with `rules`: ",NAME,NAME,"; empty: all numbers
    std::vector<std::string> shots;
};

float& number(const std::string& name) {
    for (const engine::CompletionNumber& n : engine::completion_numbers())
        if (n.name == name) return engine::completion_model.*n.value;
    fail("no number " + name + " in engine/samples/completion_model.h");
}

// NAME=VALUE,NAME=VALUE…
void set_numbers(const std::string& words) {
    for (std::size_t begin = 0; begin < words.size();) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const std::size_t equals = words.find('=', begin);
        if (equals >= end) fail("--set " + words + ": NAME=VALUE,…");
        number(words.substr(begin, equals - begin)) = std::stof(words.substr(equals + 1, end - equals - 1));
        begin = end + 1;
    }
}

Asked asked_of(int count, char** words) {
    Asked asked;
    if (count < 3) fail("FOLDER [--engine NAME] [--quality NAME] [--keep FOLDER] [--known] SHOT…");
    asked.folder = words[1];
    for (int i = 2; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--known" || word == "--rules") {
            (word == "--known" ? asked.known : asked.rules) = true;
            continue;
        }
        if (!word.starts_with("--")) {
            asked.shots.push_back(word);
            continue;
        }
        if (++i == count) fail(word + " needs a value");
        if (word == "--engine")
            asked.engine = words[i];
        else if (word == "--keep")
            asked.keep = words[i];
        else if (word == "--only")
            asked.only = std::string(",") + words[i] + ",";
        else if (word == "--set")
            set_numbers(words[i]);
        else if (word == "--quality") {
            const Result<Quality> quality = parse<Quality>(words[i]);
            if (!quality) fail(quality.error().message);
            asked.quality = *quality;
        } else
            fail("unknown flag " + word);
    }
    return asked;
}

Picture drawn(const Still& still, const Asked& asked) {
    DefocusJob job;
    job.colour = still.sharp, job.depth_m = still.depth_m;
    job.place = Place::whole(still.sharp.rect());
    job.camera = still.camera;
    job.engine = asked.engine, job.quality = asked.quality;
    if (asked.known) job.behind = &still.hidden;
    auto report = defocus(job);
    if (!report) fail(report.error().message);
    return std::move(report->image);
}

// The picture as it is compared: linear light times the exposure, clipped to 0…1.
Picture shown(const Picture& picture, float exposure) {
    Picture out(picture.width(), picture.height());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto c = flicker::shown(exposure * picture.pixels()[i]);
        out.pixels()[i] = {c[0], c[1], c[2], 1};
    }
    return out;
}

float square_error(Rgba a, Rgba b) {
    const Rgba d = a - b;
    return d.r * d.r + d.g * d.g + d.b * d.b;
}

struct Errors {
    double all = 0, reached = 0, pixels = 0, reached_pixels = 0;
    static double db(double sum, double pixels) {
        return pixels > 0 ? -10 * std::log10(std::max(sum / (3 * pixels), 1e-10)) : 100;
    }
};

void add(Errors& errors, const Picture& result, const Picture& truth, const Still& still) {
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double e = double(square_error(result.pixels()[i], truth.pixels()[i]));
        const bool counts = still.counts.pixels()[i] != 0;
        errors.all += e, errors.pixels += 1;
        errors.reached += counts ? e : 0, errors.reached_pixels += counts;
    }
}

struct Crop {
    int x = 0, y = 0;
    double error = 0;
};

// The two worst squares that do not overlap, by the error where silhouettes' blur reaches.
std::vector<Crop> worst_squares(const Picture& result, const Picture& truth, const Still& still) {
    constexpr int kSquare = 48, kStep = 8;
    std::vector<Crop> all, worst;
    for (int y = 0; y + kSquare <= truth.height(); y += kStep)
        for (int x = 0; x + kSquare <= truth.width(); x += kStep) {
            Crop crop{x, y, 0};
            for (int j = y; j < y + kSquare; ++j)
                for (int i = x; i < x + kSquare; ++i)
                    if (still.counts(i, j)) crop.error += double(square_error(result(i, j), truth(i, j)));
            all.push_back(crop);
        }
    std::stable_sort(all.begin(), all.end(), [](const Crop& a, const Crop& b) { return a.error > b.error; });
    for (const Crop& crop : all)
        if (worst.empty() || (worst.size() < 2 && std::max(std::abs(crop.x - worst[0].x),
                                                           std::abs(crop.y - worst[0].y)) >= kSquare))
            worst.push_back(crop);
    return worst;
}

void keep(const Picture& result, const std::string& path) {
    Frame frame;
    frame.colour = result.clone();
    frame.place = Place::whole(result.rect());
    WriteOptions options;
    options.type = PixelType::Float;
    if (const Status status = write_exr(path, frame, options); !status) fail(status.error().message);
}

// state: further members of the line.
void judge(const std::string& name, const CompletionShot& shot, const Asked& asked,
           const std::string& state = "") {
    flicker::Frames results, truths;
    Errors errors;
    double cpu_s = 0;
    for (std::size_t t = 0; t < shot.frames.size(); ++t) {
        const Still& still = shot.frames[t];
        const double before = bench::cpu_seconds();
        const Picture result = drawn(still, asked);
        cpu_s += bench::cpu_seconds() - before;
        if (!asked.keep.empty()) keep(result, asked.keep + "/" + name + "." + std::to_string(t) + ".exr");
        results.push_back(shown(result, shot.exposure)), truths.push_back(shown(still.truth, shot.exposure));
        add(errors, results.back(), truths.back(), still);
    }
    const std::size_t middle = shot.frames.size() / 2;
    std::printf(
        "{%s\"shot\": \"%s\", \"db\": %.3f, \"edges_db\": %.3f, \"edges_share\": %.4f, \"cpu_s\": %.3f",
        state.c_str(), name.c_str(), Errors::db(errors.all, errors.pixels),
        Errors::db(errors.reached, errors.reached_pixels), errors.reached_pixels / errors.pixels,
        cpu_s / double(shot.frames.size()));
    if (shot.frames.size() >= 3) {
        const flicker::Steadiness found = flicker::measure(results, truths);
        std::printf(", \"shake\": %.4f, \"pop\": %.4f, \"pop_at\": [%d, %d, %d]", found.shake,
                    found.worst_pop, found.frame, found.x, found.y);
    }
    std::printf(", \"exposure\": %g, \"frame\": %d, \"sharp\": \"%s\", \"truth\": \"%s\", \"crops\": [",
                double(shot.exposure), int(middle), shot.frames[middle].sharp_file.c_str(),
                shot.frames[middle].truth_file.c_str());
    const char* separator = "";
    for (const Crop& crop : worst_squares(results[middle], truths[middle], shot.frames[middle])) {
        std::printf("%s[%d, %d, %.4f]", separator, crop.x, crop.y, crop.error);
        separator = ", ";
    }
    std::printf("]}\n");
    std::fflush(stdout);
}

void judge_with(const engine::CompletionNumber& n, const char* variant, float value,
                const std::vector<CompletionShot>& shots, const Asked& asked) {
    float& number = engine::completion_model.*n.value;
    if (!(value != number)) return;
    const float before = std::exchange(number, value);
    const std::string state =
        "\"number\": \"" + std::string(n.name) + "\", \"variant\": \"" + variant + "\", ";
    for (std::size_t i = 0; i < shots.size(); ++i) judge(asked.shots[i], shots[i], asked, state);
    number = before;
}

void judge_rules(const Asked& asked) {
    std::vector<CompletionShot> shots;
    for (const std::string& name : asked.shots)
        shots.push_back(bench::completion_shot(name, asked.folder, asked.known));
    // One frame of each seed: hundreds of variants are drawn. Shake is that of built-in scenes.
    for (std::size_t i = 0; i < shots.size(); ++i)
        if (std::isdigit(asked.shots[i][0])) shots[i].frames.resize(1);
    for (std::size_t i = 0; i < shots.size(); ++i) judge(asked.shots[i], shots[i], asked);
    for (const char* variant : {"off", "half", "double"})
        for (const engine::CompletionNumber& n : engine::completion_numbers()) {
            if (!asked.only.empty() && asked.only.find("," + std::string(n.name) + ",") == std::string::npos)
                continue;
            const float now = engine::completion_model.*n.value;
            const float value = variant[0] == 'o' ? n.off : variant[0] == 'h' ? now / 2 : now * 2;
            if (variant[0] == 'o' ? !std::isnan(value) : value >= n.least && value <= n.most)
                judge_with(n, variant, value, shots, asked);
        }
}

}  // namespace

int main(int count, char** words) {
    const Asked asked = asked_of(count, words);
    if (asked.rules) {
        judge_rules(asked);
        return 0;
    }
    for (const std::string& name : asked.shots)
        judge(name, bench::completion_shot(name, asked.folder, asked.known), asked);
    return 0;
}

#include "script.h"

#include "petzval/files.h"

#include "commands.h"
#include "fields.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

namespace petzval::view {
namespace {

using Clock = std::chrono::steady_clock;
using Words = std::vector<std::string>;

struct Verb {
    const char* name;
    std::size_t least, most;  // words after it
};
constexpr Verb kVerbs[]{{"click", 1, 2}, {"right_click", 1, 2}, {"drag", 2, 4},   {"move", 1, 2},
                        {"wheel", 1, 1}, {"key", 1, 1},         {"wait", 0, 1},   {"until", 2, 2},
                        {"sleep", 1, 1}, {"shot", 1, 2},        {"resize", 2, 2}, {"expect", 1, 7},
                        {"say", 1, 1}};

const Verb* verb_called(const std::string& name) {
    for (const Verb& verb : kVerbs)
        if (name == verb.name) return &verb;
    return nullptr;
}

bool is_command(const std::string& name) {
    const auto same = [&](const Command& command) { return command.name == name; };
    return std::any_of(commands().begin(), commands().end(), same);
}

// Position of a word that begins with '#'; not inside file names such as shot.####.exr.
std::size_t comment_of(const std::string& line) {
    std::size_t at = line.find('#');
    while (at != std::string::npos && at > 0 && line[at - 1] != ' ' && line[at - 1] != '\t')
        at = line.find('#', at + 1);
    return std::min(at, line.size());
}

// Means over by x by pixels; what is left over at the right and below is dropped.
Script::Screen means_of(const Script::Screen& screen, int by) {
    Script::Screen means{screen.width / by, screen.height / by, {}};
    for (int y = 0; y < means.height; ++y)
        for (int x = 0; x < means.width; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                int sum = 0;
                for (int j = y * by; j < (y + 1) * by; ++j)
                    for (int i = x * by; i < (x + 1) * by; ++i)
                        sum += screen.codes[std::size_t(3 * (j * screen.width + i) + channel)];
                means.codes.push_back(std::uint16_t((sum + by * by / 2) / (by * by)));
            }
    return means;
}

std::string why_refused(const Words& words) {
    if (is_command(words[0])) return "";
    const Verb* verb = verb_called(words[0]);
    if (!verb) return "unknown word " + words[0];
    const std::size_t count = words.size() - 1;
    if (count < verb->least || count > verb->most)
        return words[0] + " has too " + (count < verb->least ? "few" : "many") + " words";
    if (words[0] != "key") return "";
    const std::size_t plus = words[1].rfind('+');
    return key_code(plus == std::string::npos ? words[1] : words[1].substr(plus + 1)) == 0
               ? "unknown key " + words[1]
               : "";
}

}  // namespace

Result<Script> Script::read(const std::string& path) {
    std::error_code ignored;
    const bool is_there = std::filesystem::exists(path, ignored);
    if (is_there && !std::filesystem::is_regular_file(path, ignored))
        return Error{ErrorCode::InvalidFile, path + ": is not a regular file"};
    std::ifstream file(path);
    if (!file) return Error{ErrorCode::InvalidFile, path + ": no such script"};
    Script script;
    script.path_ = path;
    int number = 0;
    const auto here = [&] { return path + ":" + std::to_string(number) + ": "; };
    for (std::string text; std::getline(file, text);) {
        ++number;
        text.erase(comment_of(text));
        Words words = words_of(text);
        if (words.empty()) continue;
        if (const std::string why = why_refused(words); !why.empty())
            return Error{ErrorCode::InvalidFile, here() + why};
        script.lines_.push_back({number, std::move(words), text});
    }
    return script;
}

void Script::fail(const std::string& why) {
    const int number = step_ < lines_.size() ? lines_[step_].number : 0;
    failure_ = Error{ErrorCode::InvalidArgument, path_ + ":" + std::to_string(number) + ": " + why};
}

// In pixels of the window: the middle of a pixel of the frame, or of a widget.
std::optional<std::pair<double, double>> Script::place_of(App& app, const Words& words, std::size_t first) {
    const auto x = number_of(words[first]);
    const auto y = words.size() > first + 1 ? number_of(words[first + 1]) : x;
    if (x && y) {
        const Rect frame = app.frame();
        return std::pair(app.mapping.screen_x(frame.x0 + *x + 0.5),
                         app.mapping.screen_y(frame.y0 + *y + 0.5));
    }
    const auto found = app.widgets.find(words[first]);
    if (found == app.widgets.end()) {
        fail("no widget on the screen is named " + words[first]);
        return std::nullopt;
    }
    const Rect& r = found->second;
    const double x_middle = 0.5 * (r.x0 + r.x1), y_middle = 0.5 * (r.y0 + r.y1);
    if (y_middle < 0 || y_middle >= app.screen_height) {
        fail(words[first] + " is not visible: the window is too small, or a panel is scrolled");
        return std::nullopt;
    }
    return std::pair(x_middle, y_middle);
}

void Script::begin_drag(App& app, const Words& words) {
    const auto from = place_of(app, words, 1);
    if (!from) return;
    std::pair<double, double> to = *from;
    if (words.size() == 5) {
        to = *place_of(app, words, 3);
    } else {
        const auto right = number_of(words[2]);
        const auto down = words.size() > 3 ? number_of(words[3]) : Result<double>(0.0);
        if (!right || !down) return fail("drag: not a number of pixels");
        to.first += *right, to.second += *down;
    }
    Hand at;
    at.x = from->first, at.y = from->second;
    moves_.push_back(at);
    for (int i = 0; i <= 8; ++i) {
        at.x = from->first + (to.first - from->first) * i / 8.0;
        at.y = from->second + (to.second - from->second) * i / 8.0;
        at.button = true;
        moves_.push_back(at);
    }
    at.button = false;
    moves_.push_back(at);
}

void Script::begin(App& app, const Line& line) {
    const Words& words = line.words;
    const std::string& verb = words[0];
    Hand next = hand_;
    if (verb == "click" || verb == "right_click" || verb == "move") {
        const auto where = place_of(app, words, 1);
        if (!where) return;
        next.x = where->first, next.y = where->second;
        moves_ = {next, next};
        if (verb == "move") return;
        bool& pressed = verb == "click" ? next.button : next.right;
        pressed = true;
        moves_.push_back(next);
        pressed = false;
        moves_.push_back(next);
    } else if (verb == "drag") {
        begin_drag(app, words);
    } else if (verb == "wheel") {
        next.wheel = number_of(words[1]) ? *number_of(words[1]) : 0;
        moves_ = {next};
    } else if (verb == "key") {
        next.key = words[1];
        moves_ = {next, hand_};
    } else if (verb == "resize") {
        const auto width = number_of(words[1]), height = number_of(words[2]);
        constexpr double kMostOfSide = 16384;  // of a window
        const auto fits = [&](const Result<double>& side) {
            return side && *side >= 1 && *side <= kMostOfSide;
        };
        if (!fits(width) || !fits(height)) return fail("resize needs two numbers, 1 to 16384 pixels");
        next.resize = {int(*width), int(*height)};
        moves_ = {next, hand_, hand_};
    } else if (verb == "expect" && words[1] != "screen") {
        expect(app, words);
    } else if (verb == "say") {
        const auto text = field_text(app, words[1]);
        if (!text) return fail(text.error().message);
        std::printf("%s\n", text->c_str());
        std::fflush(stdout);  // whoever drives the window may wait for it
    } else {
        static_cast<void>(act(app, line.text));
    }
}

Hand Script::tick(App& app) {
    looks_ = false;
    if (is_done() || failure_) return hand_;
    if (!moves_.empty()) {
        hand_ = moves_.front();
        moves_.erase(moves_.begin());
        const Hand now = hand_;
        hand_.wheel = 0, hand_.key.clear(), hand_.resize.reset();
        if (moves_.empty()) ++step_;
        return now;
    }
    const Line& line = lines_[step_];
    if (line.words[0] == "wait" || line.words[0] == "sleep") {
        if (line.words[0] == "wait" ? has_waited(app) : has_slept()) ++step_;
        return hand_;
    }
    if (line.words[0] == "until") {
        if (has_come(app)) ++step_;
        return hand_;
    }
    looks_ = line.words[0] == "shot" || (line.words[0] == "expect" && line.words[1] == "screen");
    if (looks_) return hand_;
    begin(app, line);
    if (moves_.empty()) ++step_;
    return hand_;
}

bool Script::has_waited(App& app) {
    const Words& words = lines_[step_].words;
    if (!waiting_since_) {
        waiting_since_ = Clock::now();
        quiet_ticks_ = 0;
        patience_s_ = words.size() > 1 && number_of(words[1]) ? *number_of(words[1]) : 60;
    }
    quiet_ticks_ = app.is_busy() ? 0 : quiet_ticks_ + 1;
    if (quiet_ticks_ > 3) {
        waiting_since_.reset();
        return true;
    }
    if (std::chrono::duration<double>(Clock::now() - *waiting_since_).count() > patience_s_)
        fail("still busy after " + text_of(patience_s_, 3) + " s");
    return false;
}

bool Script::has_come(App& app) {
    if (!waiting_since_) waiting_since_ = Clock::now();
    const Words& words = lines_[step_].words;
    const auto text = field_text(app, words[1]);
    if (!text) fail(text.error().message);
    if (text && text->find(words[2]) != std::string::npos) {
        waiting_since_.reset();
        return true;
    }
    if (std::chrono::duration<double>(Clock::now() - *waiting_since_).count() > 60)
        fail(words[1] + " did not become " + words[2] + " in 60 s");
    return false;
}

bool Script::has_slept() {
    if (!waiting_since_) waiting_since_ = Clock::now();
    const auto seconds = number_of(lines_[step_].words[1]);
    if (seconds && std::chrono::duration<double>(Clock::now() - *waiting_since_).count() < *seconds)
        return false;
    waiting_since_.reset();
    return true;
}

void Script::expect(App& app, const Words& words) {
    const bool nothing = words[1] == "no";
    if (nothing || (words[1] == "error" && words.size() == 2)) {
        const std::string said = *field_text(app, "error");
        if (nothing != said.empty()) fail(nothing ? "there is an error: " + said : "there is no error");
        return;
    }
    const auto text = field_text(app, words[1]);
    if (!text) return fail(text.error().message);
    if (words.size() < 3) return fail("expect " + words[1] + " needs a value");
    const auto is = number_of(*text), wanted = number_of(words[2]);
    if (is && wanted) {
        const auto share = words.size() > 3 ? number_of(words[3]) : Result<double>(1e-5);
        if (share && std::abs(*is - *wanted) <= *share * std::max(std::abs(*wanted), 1e-12)) return;
    } else if (text->find(words[2]) != std::string::npos) {
        return;
    }
    fail(words[1] + " is " + (text->empty() ? "empty" : *text) + ", not " + words[2]);
}

void Script::expect_screen(App& app, const Screen& screen) {
    const Words& words = lines_[step_].words;
    std::vector<double> numbers;
    for (std::size_t i = 2; i < words.size(); ++i)
        if (const auto number = number_of(words[i])) numbers.push_back(*number);
    if (numbers.size() != words.size() - 2 || numbers.size() < 5)
        return fail("expect screen needs X Y R G B [CODES]");
    const auto where = place_of(app, words, 2);
    const int x = int(where->first), y = int(where->second);
    if (x < 0 || y < 0 || x >= screen.width || y >= screen.height)
        return fail("that pixel is not on the screen");
    const double tolerance = numbers.size() > 5 ? numbers[5] : 2;
    const std::uint16_t* codes =
        screen.codes.data() + 3 * (std::size_t(y) * std::size_t(screen.width) + std::size_t(x));
    for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(double(codes[c]) - numbers[2 + c]) > tolerance)
            return fail("the screen shows " + std::to_string(codes[0]) + " " + std::to_string(codes[1]) +
                        " " + std::to_string(codes[2]) + " there");
}

void Script::seen(App& app, const Screen& screen) {
    looks_ = false;
    const Words& words = lines_[step_].words;
    if (words[0] == "shot") {
        const Result<double> by = words.size() > 2 ? number_of(words[2]) : 1.0;
        if (!by || !(*by >= 1 && *by <= std::min(screen.width, screen.height)))
            return fail("BY is 1 to the pixels of the window's shorter side");
        if (const Status fine = app.may_write(words[1]); !fine) return fail(fine.error().message);
        Screen shown = means_of(screen, int(*by));
        const PngPixels png{.width = shown.width,
                            .height = shown.height,
                            .channels = 3,
                            .bits = 8,
                            .samples = std::move(shown.codes)};
        if (const Status done = write_png(words[1], png); !done) fail(done.error().message);
    } else {
        expect_screen(app, screen);
    }
    ++step_;
}

}  // namespace petzval::view

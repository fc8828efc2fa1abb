// A hand made of text: moves the pointer and presses keys in the window's own event queue, waits, looks.
//
// One step a line, a word that begins with '#' a comment. Besides all commands (commands.h):
//   click X Y | click NAME          a pixel of the frame, or a widget
//   drag X Y X2 Y2 | drag NAME DX [DY]   held down over eight ticks
//   move X Y, wheel N, key KEY      as "key shift+e"
//   wait [SECONDS]                  until nothing is being made (at most so long, 60), or fail
//   sleep SECONDS                   whatever is being made
//   until FIELD TEXT                until the field contains it, 60 s at most, or fail
//   shot FILE.png [BY]              what is on the screen, or its means over BY x BY pixels
//   resize W H
//   expect FIELD VALUE [TOLERANCE]  of numbers, a share of the value; of texts: contained
//   expect screen X Y R G B [CODES] what is on the screen where this pixel of the frame is
//   say FIELD                       to standard output
//   expect error | expect no error  what the last command said
#pragma once

#include "app.h"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace petzval::view {

// Input events of one tick.
struct Hand {
    double x = -1, y = -1, wheel = 0;
    bool right = false;
    bool button = false;
    std::string key;  // "shift+e"
    std::optional<std::pair<int, int>> resize;
};

class Script {
public:
    // Errors: InvalidFile with path and line: missing, an unknown word, too few or too many of them.
    static Result<Script> read(const std::string& path);

    // Called once a tick, before input is taken.
    Hand tick(App& app);
    // Once what the hand asked for was drawn: width and height of the screen, its codes from the top.
    struct Screen {
        int width = 0, height = 0;
        std::vector<std::uint16_t> codes;
    };
    bool looks_at_screen() const { return looks_; }
    void seen(App& app, const Screen& screen);

    bool is_done() const { return step_ >= lines_.size() && moves_.empty(); }
    const std::optional<Error>& failure() const { return failure_; }

private:
    struct Line {
        int number = 0;
        std::vector<std::string> words;
        std::string text;
    };
    void begin(App& app, const Line& line);
    void begin_drag(App& app, const std::vector<std::string>& words);
    void expect(App& app, const std::vector<std::string>& words);
    void expect_screen(App& app, const Screen& screen);
    bool has_waited(App& app);
    bool has_slept();
    bool has_come(App& app);
    std::optional<std::pair<double, double>> place_of(App& app, const std::vector<std::string>& words,
                                                      std::size_t first);
    void fail(const std::string& why);

    std::string path_;
    std::vector<Line> lines_;
    std::size_t step_ = 0;
    std::vector<Hand> moves_;  // of the present line, still to be done
    Hand hand_;
    bool looks_ = false;
    std::optional<std::chrono::steady_clock::time_point> waiting_since_;
    double patience_s_ = 60;
    int quiet_ticks_ = 0;
    std::optional<Error> failure_;
};

}  // namespace petzval::view

// Choices as they were, for undo and redo.
#pragma once

#include "view.h"

#include <map>
#include <optional>
#include <vector>

namespace petzval::view {

// Everything that can be undone.
struct Chosen {
    Choice choice;  // its frame does not count
    std::map<int, double> keys;
    bool easing = false;
    double focus_speed = 0;
};
bool same(const Chosen& a, const Chosen& b);

class History {
public:
    // A step, if something differs from the last settled choice. Called while no widget is held, so that a
    // drag is one step.
    void settle(const Chosen& now);
    // The same without a step: what the frame, not the hand, changed.
    void follow(const Chosen& now) { settled_ = now; }
    void forget();  // all steps
    // The choice before, or after; nothing if there is none.
    std::optional<Chosen> undo();
    std::optional<Chosen> redo();

private:
    std::optional<Chosen> settled_;
    std::vector<Chosen> before_, after_;
};

}  // namespace petzval::view

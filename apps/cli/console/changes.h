// Values of a shot's frames: constant ones, and those that change.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace petzval::cli {

class Changes {
public:
    using Value = std::pair<std::string, std::string>;  // its name, and what it is
    // Every frame has the same names in the same order.
    void add(int frame, std::vector<Value> values);
    // One line of constant values, then a table with one row per frame; empty without frames.
    std::string text() const;

private:
    bool changes(std::size_t column) const;
    std::vector<int> frames_;
    std::vector<std::vector<Value>> rows_;
};

}  // namespace petzval::cli

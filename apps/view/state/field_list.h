// A field of the window by its name: how it is read, set and reset.
#pragma once

#include "app.h"

#include <functional>
#include <string>
#include <vector>

namespace petzval::view {

struct Field {
    std::string name;
    std::function<std::string(const App&)> get;
    std::function<Status(App&, const std::string&)> set;  // null: can only be known
    std::string standard = {};                            // its default, as text; empty: none
};

std::vector<Field> input_fields();

}  // namespace petzval::view

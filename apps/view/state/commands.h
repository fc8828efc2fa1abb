// Everything that can be done in the window, as lines of text: what keys, mouse, panels and scripts say.
#pragma once

#include "app.h"

#include <string>
#include <vector>

namespace petzval::view {

struct Command {
    std::string name, arguments, meaning;
    Status (*run)(App& app, const std::vector<std::string>& arguments);
};
const std::vector<Command>& commands();

// A key and its command. `key`: one of those of key_code(), with shift+ or ctrl+ before it.
struct Binding {
    std::string key, line, meaning;
};
const std::vector<Binding>& bindings();

// GLFW's code of a key: "a" … "z", "0" … "9", "left", "enter", "minus"…; 0: unknown key.
int key_code(const std::string& name);

// Words, with "two words" as one.
std::vector<std::string> words_of(const std::string& line);

// Executes a command line. Errors are also shown in the window: InvalidArgument, with the accepted values.
Status act(App& app, const std::string& line);

}  // namespace petzval::view

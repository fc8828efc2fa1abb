// The command that makes a frame of the window, for people who continue in a terminal.
#pragma once

#include "view.h"

#include <string>

namespace petzval::view {

// "petzval defocus in.exr -o out.exr --fstop 2 …": makes this frame as that file, with the choices of the
// window. Only choices that differ from the defaults are flags.
std::string command_line(const Setup& setup, const Choice& choice, const std::string& output);

}  // namespace petzval::view

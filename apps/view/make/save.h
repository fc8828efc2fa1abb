// A frame of the window as a file, like one of `petzval defocus` with the same choices.
#pragma once

#include "petzval/shot_run.h"

#include "view.h"

namespace petzval::view {

// The settings of the command line, changed by the choices of the window, for one picture.
Result<ShotRunSettings> settings_to_save(ShotRunSettings settings, const Choice& choice,
                                         const std::string& output);
// Errors: those of kind_of_output() and make_picture(), in the words of the host.
Status save_picture(Session& session, const Setup& setup, const Choice& choice, const std::string& output);

}  // namespace petzval::view

// An engine: its input is an EngineView (engine/waist/view.h), its output is here, with its error contract.
//
// The session has checked everything by the time an engine runs: sizes agree, colour is finite, circles of
// confusion are finite, the picture is not empty. An engine checks nothing again. Too little memory is an
// error that it returns; a device that fails and a host that cancels end it by an exception
// (base/ended.h), which it lets pass.
#pragma once

#include "petzval/engine_report.h"
#include "petzval/result.h"

#include "engine/waist/view.h"

#include <memory>
#include <string>
#include <vector>

namespace petzval::engine {

struct Output {
    Picture image;
    std::shared_ptr<device::Canvas> canvas;  // or this in its place: not null where a device drew it
    std::vector<Picture> layers;             // those of the view's samples, in their order
    std::vector<StageTime> stages;
    std::vector<std::string> warnings;
};

// The ways in which engines draw Samples::layers.
enum class Layers {
    None,
    ByPlan,    // drawn by the picture's own plan
    OneByOne,  // decides by depth, alpha and Samples::judged(): each layer is run as the picture
};

struct Engine {
    const char* name;
    const char* purpose;  // one line for help texts
    Result<Output> (*run)(const EngineView&, Spare);
    bool takes_holdout = false;
    Layers layers = Layers::None;
    bool looks_at_front_alone = false;  // deep samples and hidden layers have no effect
};

}  // namespace petzval::engine

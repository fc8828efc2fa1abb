// A frame while it is made: its stages one by one, as a host with a node or a farm task for each wants them,
// or all at once, as Session::take() does.
#pragma once

#include "petzval/defocus.h"
#include "petzval/export.h"
#include "petzval/look.h"
#include "petzval/rendered.h"
#include "petzval/result.h"
#include "petzval/session.h"

#include <memory>
#include <string>
#include <vector>

namespace petzval {

// In pixels of the display window, as the data window is: asked lies within made, made within seen.
struct Windows {
    Rect asked;  // what the result shows
    Rect made;   // what is blurred: all of the frame where glare spreads over it
    Rect seen;   // what an engine looks at for that; known once the frame is blurred
};

// In the order of physics: blur, falloff, glare, codes. A stage may be left out and none comes twice or after
// a later one: that is an error. A stage that the look does not ask for changes nothing. Between stages the
// picture stays where it was drawn. Neither the session nor the pictures of `rendered` may end before it.
class PETZVAL_API FrameStages {
public:
    // spare: the memory of the picture that rendered.colour shows, moved in by an owner who no longer needs
    // it: the result may be put there. Errors: those of check(look); InvalidArgument for sizes, windows and
    // numbers that do not fit; those of Lens::open() and of the session's device.
    static Result<FrameStages> begin(Session& session, Rendered rendered, const Look& look,
                                     const Control& control = {}, Picture spare = {});
    ~FrameStages();
    FrameStages(FrameStages&&) noexcept;
    FrameStages& operator=(FrameStages&&) noexcept;

    const Windows& windows() const;

    // A plate's highlights are given back before it. Errors: those of petzval::defocus().
    Status blur();
    // Instead of blur(): a picture that is blurred already, of the size of windows().made.
    Status take_blurred(Picture picture);
    // Light lost towards the corners. Errors: those of add_falloff().
    Status falloff();
    // Errors: those of add_glare().
    Status glare();
    // Makes Control::codes; on the device that drew the picture, unless its light is changed afterwards.
    Status codes();

    // The picture made so far, brought home and cut to windows().asked: back in the plate's range, limited by
    // the mask. Nothing can be made of the frame afterwards.
    Result<DefocusReport> report() &&;
    // All stages that are left, and the report.
    Result<DefocusReport> take() &&;

private:
    friend class Session;
    struct Making;
    // unused: warnings that are known already.
    static Result<FrameStages> begin_checked(Session& session, Rendered rendered, const Look& look,
                                             const Control& control, Picture spare,
                                             std::vector<std::string> unused);
    explicit FrameStages(std::unique_ptr<Making> making);
    std::unique_ptr<Making> making_;
};

}  // namespace petzval

// A frame in progress. Its stages are made one by one, for a host with a node or farm task per stage, or
// all at once, as in Session::take().
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

// In pixels of the display window, like the data window: asked lies within made, made within seen.
struct Windows {
    Rect asked;  // the part that the result shows
    Rect made;   // the part that is blurred: the whole frame if glare spreads over it
    Rect seen;   // the part that the engine reads; known once the frame is blurred
};

// Stages are called in the order of physics: blur, falloff, glare, codes. A stage may be omitted; calling
// one twice or after a later one is an error. A stage that the look does not use changes nothing. Between
// stages the picture stays on its device. The session and the pictures of `rendered` must outlive the
// frame.
class PETZVAL_API FrameStages {
public:
    // spare: the picture that rendered.colour views, moved in if its owner no longer needs it: its memory
    // may be reused for the result. Errors: those of check(look); InvalidArgument for sizes, windows and
    // numbers that do not fit; those of Lens::open() and of the session's device.
    static Result<FrameStages> begin(Session& session, Rendered rendered, const Look& look,
                                     const Control& control = {}, Picture spare = {});
    ~FrameStages();
    FrameStages(FrameStages&&) noexcept;
    FrameStages& operator=(FrameStages&&) noexcept;

    const Windows& windows() const;

    // Expands a plate's highlights, then blurs. Errors: those of petzval::defocus().
    Status blur();
    // Instead of blur(): takes a picture that is already blurred, of the size of windows().made.
    Status take_blurred(Picture picture);
    // Light lost towards the corners. Errors: those of add_falloff().
    Status falloff();
    // Errors: those of add_glare().
    Status glare();
    // Makes Control::codes; on the device that drew the picture, unless its light is changed afterwards.
    Status codes();

    // The picture made so far, read back and cut to windows().asked, in the plate's range and limited by
    // the mask. The frame cannot be used afterwards.
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

#include "views/plan_view.h"

namespace petzval::views {

std::unique_ptr<PlanView> plan_view(ScatterView view) {
    switch (view) {
        case ScatterView::Result:
        case ScatterView::Guessed:  // the engine draws this one itself
            break;
        case ScatterView::Layers:
            return std::make_unique<LayersView>();
        case ScatterView::Levels:
            return std::make_unique<LevelsView>();
        case ScatterView::Highlights:
            return std::make_unique<HighlightsView>();
        case ScatterView::Hidden:
            return std::make_unique<HiddenView>();
    }
    return nullptr;
}

const char* name_of(ScatterView view) {
    switch (view) {
        case ScatterView::Result:
            break;
        case ScatterView::Layers:
            return "layers";
        case ScatterView::Levels:
            return "levels";
        case ScatterView::Highlights:
            return "highlights";
        case ScatterView::Hidden:
            return "hidden";
        case ScatterView::Guessed:
            return "guessed";
    }
    return "result";
}

}  // namespace petzval::views

// The pictures that a run can write, by name.
#include "petzval/shot_run.h"

namespace petzval {

const std::vector<std::pair<std::string, ShotView>>& shot_views() {
    static const std::vector<std::pair<std::string, ShotView>> table{
        {"beauty", ShotView::Beauty},         {"coc", ShotView::Coc},
        {"focus", ShotView::Focus},           {"depth", ShotView::Depth},
        {"alpha", ShotView::Alpha},           {"sharp", ShotView::Sharp},
        {"blur-small", ShotView::BlurSmall},  {"blur-large", ShotView::BlurLarge},
        {"blur-rows", ShotView::BlurRows},    {"focus-index", ShotView::FocusIndex},
        {"levels", ShotView::Levels},         {"layers", ShotView::Layers},
        {"highlights", ShotView::Highlights}, {"hidden", ShotView::Hidden},
        {"guessed", ShotView::Guessed}};
    return table;
}

std::optional<GaussianView> gaussian_view(ShotView view) {
    switch (view) {
        case ShotView::Sharp:
            return GaussianView::Sharp;
        case ShotView::BlurSmall:
            return GaussianView::BlurSmall;
        case ShotView::BlurLarge:
            return GaussianView::BlurLarge;
        case ShotView::BlurRows:
            return GaussianView::BlurRows;
        case ShotView::FocusIndex:
            return GaussianView::FocusIndex;
        default:
            return std::nullopt;
    }
}

ScatterView scatter_view(ShotView view) {
    switch (view) {
        case ShotView::Layers:
            return ScatterView::Layers;
        case ShotView::Levels:
            return ScatterView::Levels;
        case ShotView::Highlights:
            return ScatterView::Highlights;
        case ShotView::Hidden:
            return ScatterView::Hidden;
        case ShotView::Guessed:
            return ScatterView::Guessed;
        default:
            return ScatterView::Result;
    }
}

const char* name_of(ShotView view) {
    for (const auto& [name, value] : shot_views())
        if (value == view) return name.c_str();
    return "?";
}

bool is_rendered(ShotView view) {
    return view != ShotView::Coc && view != ShotView::Focus && view != ShotView::Depth;
}

bool is_developed(ShotView view) {
    return view != ShotView::Coc && view != ShotView::Depth && view != ShotView::Alpha &&
           view != ShotView::FocusIndex && view != ShotView::Guessed;
}

}  // namespace petzval

#include "engine/samples/found_surfaces.h"

#include "engine/samples/behind/known_surfaces.h"

namespace petzval::engine {

FlatSurfaces found_surfaces(const EngineView& input, View<const unsigned char> connected, const Dim& dim) {
    const LitPicture picture{input.samples.colour, dim, input.samples.patches()};
    const View<const float> coc_px = input.samples.coc_px;
    Workers& workers = *input.services.workers;
    // A draft searches half as much.
    const bool draft = input.options.quality == Quality::Draft;
    const UnmixRule unmix = draft ? UnmixRule::draft() : UnmixRule{};
    FillRule fill = draft ? FillRule::draft() : FillRule{};
    if (input.options.quality == Quality::Final) fill.first_directions = fill.directions;
    FlatSurfaces flat;
    flat.mixtures = unmix_silhouettes(picture, coc_px, connected, workers, unmix);
    if (input.options.fill != Fill::Off)
        flat.hidden = fill_hidden(picture, coc_px, connected, flat.mixtures, input.samples.nearest_coc_px,
                                  input.samples.farthest_coc_px, fill, dim.white, workers);
    unmix_nearer(flat.mixtures, picture, flat.hidden, workers);
    flat.add_plate(input.samples.plate, picture, coc_px, workers);
    return flat;
}

HiddenLamps found_lamps(const EngineView& input, const FlatSurfaces& surfaces, const Dim& dim) {
    if (!dim || input.options.fill != Fill::Full) return {};
    return lamps_behind({input.samples.colour, dim}, input.samples.coc_px, surfaces.mixtures,
                        *input.services.workers);
}

}  // namespace petzval::engine

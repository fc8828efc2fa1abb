#include "engine/samples/found_surfaces.h"

#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/behind/plate.h"
#include "engine/samples/silhouettes/connectivity.h"

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

std::shared_ptr<const FoundSurfaces> surfaces_and_lamps(const EngineView& input,
                                                        View<const unsigned char> connected, const Dim& dim) {
    const std::uint64_t rules =
        1 + 16 * std::uint64_t(input.options.quality) + 256 * std::uint64_t(input.options.fill);
    return kept_or_found(input, input.samples.colour, dim, rules, [&] {
        FoundSurfaces s{found_surfaces(input, connected, dim), {}};
        if (const CleanPlate& plate = input.samples.plate; !plate.empty() && plate.covers) {
            const auto behind = surfaces_and_lamps(picture_of_plate(input),
                                                   connections(plate.coc_px, *input.services.workers), dim);
            s.flat.of_plate = {behind, &behind->flat};
            s.lamps = behind->lamps;
        } else {
            s.lamps = found_lamps(input, s.flat, dim);
        }
        return s;
    });
}

}  // namespace petzval::engine

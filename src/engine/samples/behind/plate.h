// A clean plate: one picture with depth of the background without the objects in front.
#pragma once

#include "petzval/workers.h"

#include "engine/samples/all_samples.h"
#include "engine/samples/hidden.h"
#include "engine/waist/engine.h"
#include "laws/surfaces.h"

namespace petzval::engine {

// The picture without the objects in front of the plate: the plate's pixel if it lies at or behind the
// visible surface, else the visible pixel.
struct BackPicture {
    Picture colour;
    Plane coc_px;
    Image<unsigned char> is_stated;  // by the plate
    bool covers = true;              // as in CleanPlate
    bool empty() const { return coc_px.empty(); }
    // Marks what drop_out_of_sight() left out of picture and plate.
    void mark_out_of_sight(const CocSamples& left);
    CleanPlate view() const { return {colour, coc_px, is_stated, covers}; }
};

// Empty unless `behind` is a plate: no more than one sample in any pixel.
BackPicture back_picture(const StatedPicture& picture, Workers& workers);

// The picture that the input's plate is.
inline EngineView picture_of_plate(EngineView input) {
    const CleanPlate plate = input.samples.plate;
    input.samples.colour = plate.colour, input.samples.coc_px = plate.coc_px, input.samples.plate = {};
    return input;
}

// A surface nearer than the plate by less than this hides next to nothing of it.
inline bool is_before_plate(float coc_px, float plate_px) {
    return laws::is_in_front(coc_px, plate_px, laws::kConnected.step_px);
}

// Separates again the silhouettes in front of the plate, now that the plate gives the background's colour.
void unmix_before_plate(Mixtures& mixtures, const LitPicture& picture, View<const float> coc_px,
                        const CleanPlate& plate, Workers& workers);

}  // namespace petzval::engine

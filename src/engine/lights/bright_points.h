// The picture's bright points, found to be drawn as sprites, and the picture without them.
#pragma once

#include "engine/lights/sprite_kernels.h"
#include "engine/waist/engine.h"

#include <cstddef>
#include <span>
#include <vector>

namespace petzval::engine {

class HighlightSplit;

// Light above `sprites.bright_factor` times its surroundings and above white, out of focus. Layers of a
// picture give the same shares of their light as the picture (Samples::judged()).
class BrightPoints {
public:
    // Bright points of a frame, which outlives this; none unless sprites.find is set. If samples dim each
    // other, only flat pixels have them (is_flat_pixel()), because dimming within a pixel is not searched.
    explicit BrightPoints(const EngineView& frame);

    bool empty() const { return sprites_.empty(); }
    std::span<const Sprite> sprites() const { return sprites_; }
    std::size_t count() const { return sprites_.size(); }
    // Bytes of the points, and of a rest of that many rows.
    std::size_t bytes_beside(int rows) const;

    // Rows of the frame without them.
    class Rest {
    public:
        const EngineView& input() const { return input_; }

    private:
        friend class BrightPoints;
        Picture colour_, picture_, plate_;
        CocSamples samples_;
        EngineView input_;
    };
    Rest rest(int first_row, int last_row) const;

private:
    struct Taken {
        float stays;         // share of the pixel's light, or the sample's, that is not a bright point
        float seen;          // share of the sample that the pixel shows
        std::size_t sample;  // of a picture with hidden layers: that from which it was taken
        bool on_plate = false;
    };
    struct Row {
        std::vector<Sprite> sprites;
        std::vector<Taken> taken;
        void add(int x, int y, float coc_px, Rgba light, const Taken& from);
    };
    Row row(const HighlightSplit& split, int y) const;
    void find_in_samples(const HighlightSplit& split, int x, int y, Row& row) const;
    Picture without(View<const Rgba> picture, std::size_t begin, std::size_t end, int first_row,
                    bool of_plate = false) const;
    CocSamples samples_without(const CocSamplesView& deep, std::size_t begin, std::size_t end) const;

    const EngineView& frame_;
    std::vector<Sprite> sprites_;  // row by row
    std::vector<Taken> taken_;     // of each
};

}  // namespace petzval::engine

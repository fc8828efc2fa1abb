#include "device/vulkan/mix.h"

#include "device/vulkan/canvas.h"
#include "device/vulkan/words.h"
#include "engine/waist/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace petzval::device::vulkan {
namespace {

using engine::Blur;
using engine::GaussianPlan;
using engine::LayeredSample;

struct Push {
    std::uint32_t blur = 0, axis = 0;
    std::uint32_t width = 0, height = 0, first_row = 0;
    std::uint32_t out_row = 0, out_rows = 0;
    std::uint32_t law = 0, view = 0;
    std::uint32_t has_extras = 0;
    std::array<float, 4> near = {}, far = {};
};
static_assert(sizeof(Push) == 72, "as shaders/mix.glsl has it");

// Data of a pixel in the layout of mix_extras.glsl.
struct Extra {
    Rgba light;
    float covered = 0, coc_px = 0, lower = 0, upper_share = 0;
};

struct Span {
    int begin = 0, end = 0;
    int size() const { return end - begin; }
};

class Mixer {
public:
    Mixer(Context& context, const GaussianPlan& plan) : context_(context), plan_(plan) {}

    int height() const { return plan_.colour.height(); }
    int width() const { return plan_.colour.width(); }

    // Rows of the result that are drawn together: as many as fit, but no fewer than surround them, unless
    // the device was out of memory. Else wide blurs would read the picture again for each few rows.
    int band(std::size_t wished_bytes, std::size_t most_bytes) const {
        int rows = height();
        while (rows > 1 && bytes_of({0, rows}) > most_bytes) rows = (rows + 1) / 2;
        const int middle = height() / 2, around = pixels_for({middle, middle + 1}).size();
        return most_bytes < wished_bytes ? rows : std::max(rows, std::min(height(), around));
    }

    void draw(Span rows, Target out) {
        const Span pixels = pixels_for(rows);
        Recording recording(context_);
        Push push;
        push.width = std::uint32_t(width()), push.height = std::uint32_t(height());
        push.first_row = std::uint32_t(pixels.begin);
        push.out_row = std::uint32_t(rows.begin), push.out_rows = std::uint32_t(rows.size());
        push.law = std::uint32_t(plan_.law), push.view = view();
        push.has_extras = plan_.surfaces->empty() ? 0 : 1;
        push.near = plan_.near.numbers(), push.far = plan_.far.numbers();
        words_ = recording.uploaded(std::span<const std::uint32_t>(words_of(rows)));
        upload_pixels(pixels, recording);
        make_cells(rows, push, recording);
        const std::size_t count = std::size_t(rows.size()) * std::size_t(width());
        const Piece result = context_.heap().allocate(Kind::OnDevice, count * sizeof(Rgba));
        recording.pass("mix blurs", context_.program(Shader::MixBlurs),
                       {&words_, &colours_, &values_, &extra_of_, &extras_, &light_, &covered_, &result},
                       push, invocations(count),
                       {count * (2 * sizeof(Rgba) + sizeof(float)) + all_cells_ * kCellBytes,
                        count * plan_.blurs.size() * 9 * kSums});
        Delivery delivery(context_, out);
        delivery.rows(recording, result, rows.begin, rows.begin, rows.end);
        recording.run();
        delivery.finish();
    }

private:
    std::uint32_t view() const {
        switch (plan_.view) {
            case GaussianView::BlurSmall:
                return 1;
            case GaussianView::BlurLarge:
            case GaussianView::BlurRows:
                return 2;
            case GaussianView::FocusIndex:
                return 3;
            default:
                return 0;
        }
    }

    // Rows of a blur's cells that these rows of the result depend on.
    static Span cells_for(const Blur& blur, Span rows) {
        const engine::CellSplines down(blur.level, blur.cells_down());
        return {std::max(0, down.cell(rows.begin, 0) - blur.y.radius()),
                std::min(blur.cells_down(), down.cell(rows.end - 1, 2) + 1 + blur.y.radius())};
    }

    Span pixels_for(Span rows) const {
        Span pixels = rows;
        for (const Blur& blur : plan_.blurs) {
            const Span cells = cells_for(blur, rows);
            const engine::CellSplines down(blur.level, blur.cells_down());
            pixels.begin = std::min(pixels.begin, down.begin(cells.begin));
            pixels.end = std::max(pixels.end, std::min(height(), down.end(cells.end)));
        }
        return pixels;
    }

    static std::size_t cells_of(const Blur& blur, Span rows) {
        return std::size_t(blur.cells_across()) * std::size_t(cells_for(blur, rows).size());
    }

    // Pixels shared down the columns, if cells are wider than pixels.
    std::size_t columns_of(const Blur& blur, Span rows) const {
        return blur.level == 0 ? 0 : std::size_t(width()) * std::size_t(cells_for(blur, rows).size());
    }

    // Bytes of pixels, results and cells, including those between passes.
    std::size_t bytes_of(Span rows) const {
        constexpr std::size_t kOne = sizeof(Rgba) + sizeof(float);
        std::size_t cells = 0, columns = 0;
        for (const Blur& blur : plan_.blurs)
            cells += cells_of(blur, rows), columns = std::max(columns, columns_of(blur, rows));
        const std::size_t extras = plan_.surfaces->empty() ? 0 : sizeof(std::uint32_t) + sizeof(Extra);
        return std::size_t(width()) * (std::size_t(pixels_for(rows).size()) * (kOne + extras) +
                                       std::size_t(rows.size()) * sizeof(Rgba)) +
               (cells + std::max(cells, columns)) * kOne;
    }

    // Words of a span in the layout of mix.glsl.
    std::vector<std::uint32_t> words_of(Span rows) const {
        constexpr std::size_t kBlurWords = 12;
        std::vector<std::uint32_t> words(plan_.blurs.size() * kBlurWords);
        const auto add = [&words](const std::vector<float>& values) {
            const auto first = std::uint32_t(words.size());
            for (const float v : values) words.push_back(bits_of(v));
            return first;
        };
        std::size_t first_cell = 0;
        for (std::size_t k = 0; k < plan_.blurs.size(); ++k) {
            const Blur& blur = plan_.blurs[k];
            const Span cells = cells_for(blur, rows);
            const std::uint32_t x = add(blur.x.weights), x_inside = add(blur.x.inside);
            const std::uint32_t y = add(blur.y.weights), y_inside = add(blur.y.inside);
            const std::array<std::uint32_t, kBlurWords> said{std::uint32_t(blur.level),
                                                             std::uint32_t(blur.cells_across()),
                                                             std::uint32_t(blur.cells_down()),
                                                             std::uint32_t(cells.begin),
                                                             std::uint32_t(cells.size()),
                                                             std::uint32_t(first_cell),
                                                             x,
                                                             std::uint32_t(blur.x.radius()),
                                                             x_inside,
                                                             y,
                                                             std::uint32_t(blur.y.radius()),
                                                             y_inside};
            std::copy(said.begin(), said.end(), words.begin() + std::ptrdiff_t(k * kBlurWords));
            first_cell += cells_of(blur, rows);
        }
        return words;
    }

    // Uploads visible colours and further data of each pixel, in the layout of mix.glsl.
    void upload_pixels(Span rows, Recording& recording) {
        const std::size_t count = std::size_t(rows.size()) * std::size_t(width());
        std::vector<Rgba> colours;
        std::vector<float> values;
        std::vector<std::uint32_t> extra_of;
        std::vector<Extra> extras;
        colours.reserve(count), values.reserve(count);
        for (int y = rows.begin; y < rows.end; ++y)
            for (int x = 0; x < width(); ++x) {
                values.push_back(plan_.law == GaussianPlan::Law::ByDepth ? plan_.depth.index(x, y)
                                                                         : plan_.coc_px(x, y));
                if (plan_.surfaces->empty()) {
                    colours.push_back(plan_.colour(x, y));
                    continue;
                }
                const auto first = std::uint32_t(extras.size());
                std::uint32_t held = 0;
                plan_.for_each_sample(x, y, [&](const LayeredSample& s) {
                    if (s.place == LayeredSample::Seen)
                        return colours.push_back(s.light), void(values.back() = s.coc_px);
                    held |= s.place == LayeredSample::Rim ? 1 : 2;
                    extras.push_back({s.light, s.covered, s.coc_px, float(s.mix.lower), s.mix.upper_share});
                });
                extra_of.push_back(4 * first + held);
            }
        if (extras.empty()) extras.emplace_back(), extra_of.resize(std::max<std::size_t>(1, extra_of.size()));
        colours_ = recording.uploaded(std::span<const Rgba>(colours));
        values_ = recording.uploaded(std::span<const float>(values));
        extra_of_ = recording.uploaded(std::span<const std::uint32_t>(extra_of));
        extras_ = recording.uploaded(std::span<const Extra>(extras));
    }

    // Shares light between them and blurs them, along x and along y.
    void make_cells(Span rows, Push push, Recording& recording) {
        std::size_t most_between = 0;
        all_cells_ = 0;
        for (const Blur& blur : plan_.blurs)
            all_cells_ += cells_of(blur, rows), most_between = std::max(most_between, columns_of(blur, rows));
        most_between = std::max(most_between, all_cells_);
        const auto room = [&](std::size_t count, std::size_t one) {
            return context_.heap().allocate(Kind::OnDevice, count * one);
        };
        light_ = room(all_cells_, sizeof(Rgba)), covered_ = room(all_cells_, sizeof(float));
        light_between_ = room(most_between, sizeof(Rgba)),
        covered_between_ = room(most_between, sizeof(float));
        for (std::size_t k = 0; k < plan_.blurs.size(); ++k) {
            const Blur& blur = plan_.blurs[k];
            const std::size_t cells = cells_of(blur, rows);
            push.blur = std::uint32_t(k);
            spread(blur, rows, push, recording);
            const auto blurred = [&](const engine::BlurAxis& axis) {
                return PassWork{2 * cells * kCellBytes, cells * axis.weights.size() * kSums};
            };
            push.axis = 0;
            recording.pass("blur cells", context_.program(Shader::BlurCells),
                           {&words_, &light_, &covered_, &light_between_, &covered_between_}, push,
                           invocations(cells), blurred(blur.x));
            push.axis = 1;
            recording.pass("blur cells", context_.program(Shader::BlurCells),
                           {&words_, &light_between_, &covered_between_, &light_, &covered_}, push,
                           invocations(cells), blurred(blur.y));
        }
    }

    // Down the columns, then along the rows; where cells are pixels there is one in each.
    void spread(const Blur& blur, Span rows, const Push& push, Recording& recording) {
        const std::size_t pixels = std::size_t(pixels_for(rows).size()) * std::size_t(width());
        const std::size_t cells = cells_of(blur, rows), columns = columns_of(blur, rows);
        const bool wide = blur.level > 0;
        recording.pass("spread columns", context_.program(Shader::SpreadColumns),
                       {&words_, &colours_, &values_, &extra_of_, &extras_, wide ? &light_between_ : &light_,
                        wide ? &covered_between_ : &covered_},
                       push, invocations(wide ? columns : cells),
                       {(pixels + columns) * kCellBytes, pixels * 3 * kSums});
        if (wide)
            recording.pass("spread cells", context_.program(Shader::SpreadCells),
                           {&words_, &light_between_, &covered_between_, &light_, &covered_}, push,
                           invocations(cells), {(columns + cells) * kCellBytes, columns * 3 * kSums});
    }

    Context& context_;
    const GaussianPlan& plan_;
    static constexpr std::size_t kCellBytes = sizeof(Rgba) + sizeof(float), kSums = 5;  // light, covered
    std::size_t all_cells_ = 0;
    Piece words_, colours_, values_, extra_of_, extras_, light_, covered_, light_between_, covered_between_;
};

}  // namespace

void mix_blurs(Context& context, const GaussianPlan& plan, Target out, const Control& control,
               std::size_t most_bytes) {
    Mixer mixer(context, plan);
    for (int y = 0; y < mixer.height() && !control.progress.cancelled();) {
        const int band = mixer.band(most_bytes, context.at_once(most_bytes)),
                  end = std::min(mixer.height(), y + band);
        try {
            mixer.draw({y, end}, out);
            y = end;
        } catch (const Failed& failed) {
            if (band == 1 || !context.halves(failed)) throw;
        }
    }
}

}  // namespace petzval::device::vulkan

// Layered convolution: the picture is cut into layers of one blur size each, every layer is convolved with
// its disc by Fourier transforms, and the layers are composited from the back with "over". After Barsky,
// Tobias, Chu, Horn, "Elimination of artifacts due to occlusion and discretization problems in image space
// blurring techniques", Graphical Models 67 (2005), and the manuals of compositors that work this way. Beyond
// the border the picture counts as empty; what is left uncovered is made up by dividing by the coverage.
#include "baselines/baseline.h"

#include <kissfft/kiss_fftndr.h>
#include <memory>

namespace petzval::baselines {
namespace {

constexpr int kLayers = 16;

using Plan = std::unique_ptr<kiss_fftnd_state, decltype(&std::free)>;
using Values = std::vector<kiss_fft_cpx>;

// Convolves pictures of one size with discs, two channels at once: one as the real, one as the imaginary
// part.
class Convolver {
public:
    Convolver(int width, int height)
        : width_(width), height_(height), forward_(make_plan(0)), inverse_(make_plan(1)) {}

    // The transform of a disc round the origin, wrapped, sum 1.
    Values disc(float radius_px) const {
        Values plane(size());
        const float radius = std::max(radius_px, 0.5f);
        const int reach = std::min(int(std::ceil(radius)), std::min(width_, height_) / 2 - 1);
        float sum = 0;
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                const float cover = std::clamp(radius + 0.5f - std::hypot(float(x), float(y)), 0.0f, 1.0f);
                plane[at((x + width_) % width_, (y + height_) % height_)].r = cover;
                sum += cover;
            }
        for (kiss_fft_cpx& v : plane) v.r /= sum;
        return transformed(forward_, plane);
    }
    Values convolved(const Values& plane, const Values& kernel) const {
        Values s = transformed(forward_, plane);
        const float scale = 1 / float(size());
        for (std::size_t i = 0; i < s.size(); ++i) {
            const kiss_fft_cpx p = s[i], q = kernel[i];
            s[i] = {(p.r * q.r - p.i * q.i) * scale, (p.r * q.i + p.i * q.r) * scale};
        }
        return transformed(inverse_, s);
    }
    std::size_t size() const { return std::size_t(width_) * std::size_t(height_); }
    std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }

private:
    Plan make_plan(int inverse) const {
        const int dims[2] = {height_, width_};
        return {kiss_fftnd_alloc(dims, 2, inverse, nullptr, nullptr), &std::free};
    }
    static Values transformed(const Plan& plan, const Values& in) {
        Values out(in.size());
        kiss_fftnd(plan.get(), in.data(), out.data());
        return out;
    }

    int width_, height_;
    Plan forward_, inverse_;
};

Picture blurred_layer(const Input& input, const LayerRule& rule, int layer) {
    const float radius = std::abs(rule.middle_px(layer));
    const int width = input.colour.width(), height = input.colour.height();
    // Room for a disc, so that nothing wraps round.
    const auto padded = [&](int length) {
        return kiss_fft_next_fast_size(length + 2 * int(std::ceil(radius)) + 2);
    };
    const Convolver convolver(padded(width), padded(height));
    const Values kernel = convolver.disc(radius);
    Picture out(width, height);
    using Channel = float Rgba::*;
    for (const auto& [real, imaginary] :
         {std::pair<Channel, Channel>{&Rgba::r, &Rgba::g}, {&Rgba::b, &Rgba::a}}) {
        Values plane(convolver.size());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                if (rule.layer_of(input.coc_px(x, y)) == layer)
                    plane[convolver.at(x, y)] = {input.colour(x, y).*real, input.colour(x, y).*imaginary};
        plane = convolver.convolved(plane, kernel);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                out(x, y).*real = std::max(0.0f, plane[convolver.at(x, y)].r);
                out(x, y).*imaginary = std::max(0.0f, plane[convolver.at(x, y)].i);
            }
    }
    return out;
}

}  // namespace

Picture layered_fft(const Input& input) { return layer_by_layer(input, kLayers, blurred_layer); }

}  // namespace petzval::baselines

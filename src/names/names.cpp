#include "petzval/names.h"

#include "base/nearest_word.h"

namespace petzval {
namespace {

constexpr Named<Quality> kQualities[]{{Quality::Draft, "draft", "quick"},
                                      {Quality::Standard, "standard", "for most work"},
                                      {Quality::Final, "final", "as exact as the engine allows"}};
constexpr Named<Fill> kFills[]{{Fill::Full, "full", "extends the surroundings, lamps included"},
                               {Fill::Dim, "dim", "extends the surroundings without highlights"},
                               {Fill::Off, "off", "adds nothing"}};
constexpr Named<ScatterView> kScatterViews[]{
    {ScatterView::Result, "result", "the picture"},
    {ScatterView::Layers, "layers", "the surfaces seen and found behind them"},
    {ScatterView::Levels, "levels", "light of each level of detail"},
    {ScatterView::Highlights, "highlights", "light that is spread separately"},
    {ScatterView::Hidden, "hidden", "all surfaces, visible and estimated, as deep samples"},
    {ScatterView::Guessed, "guessed", "a matte of the light from estimated surfaces"}};
constexpr Named<GatherStage> kStages[]{
    {GatherStage::Final, "final", "the engine itself"},
    {GatherStage::Coc, "coc", "the published signed radius"},
    {GatherStage::Prefilter, "prefilter", "colour and radius at half resolution"},
    {GatherStage::Taps, "taps", "a drawing of the samples that reach the middle of the disc"},
    {GatherStage::Disc, "disc", "a disc of samples that ignores their radii"},
    {GatherStage::DiscBlur, "disc-blur", "disc after the four-tap blur"},
    {GatherStage::HardTest, "hard-test", "samples count if their own radius reaches the pixel"},
    {GatherStage::Blur, "blur", "hard-test after the four-tap blur"},
    {GatherStage::Combine, "combine", "blur mixed with the sharp picture"},
    {GatherStage::NearFar, "near-far", "near and far apart"},
    {GatherStage::Cure, "cure", "near and far combined"}};
constexpr Named<GaussianStyle> kStyles[]{
    {GaussianStyle::Layered, "layered", "near and far separated, so light in focus does not bleed"},
    {GaussianStyle::Plain, "plain", "every pixel by its own radius"},
    {GaussianStyle::Wgld, "wgld", "by depth, as published"}};
constexpr Named<GaussianView> kGaussianViews[]{
    {GaussianView::Result, "result", "the picture"},
    {GaussianView::Sharp, "sharp", "the input"},
    {GaussianView::BlurSmall, "blur-small", "the whole picture after the smaller Gaussian"},
    {GaussianView::BlurLarge, "blur-large", "the whole picture after the larger Gaussian"},
    {GaussianView::BlurRows, "blur-rows",
     "after the first pass of the larger Gaussian, which blurs rows only"},
    {GaussianView::FocusIndex, "focus-index", "1 in focus to 0 fully blurred"}};
constexpr Named<SpriteBackground> kBackgrounds[]{{SpriteBackground::Gather, "gather", "engine gather"},
                                                 {SpriteBackground::Gaussian, "gaussian", "engine gaussian"}};
constexpr Named<FocusMode> kFocusModes[]{{FocusMode::Best, "best", "least blur at this aperture"},
                                         {FocusMode::Paraxial, "paraxial", "focus of light near the axis"},
                                         {FocusMode::Shift, "shift", "a distance behind the paraxial focus"}};
constexpr Named<LightSpectrum> kSpectra[]{
    {LightSpectrum::Daylight, "daylight", "all wavelengths"},
    {LightSpectrum::Sodium, "sodium", "street lamps: one wavelength"},
    {LightSpectrum::Mercury, "mercury", "five lines, violet to yellow"},
    {LightSpectrum::Neon, "neon", "signs: lines from yellow to red"},
    {LightSpectrum::Led, "led", "a white diode: blue and its phosphor"}};
constexpr Named<ImageScale> kImageScales[]{
    {ImageScale::Rendered, "rendered", "sensor one focal length behind the pinhole"},
    {ImageScale::ThinLens, "thin-lens", "sensor where a real lens forms the image"}};
constexpr Named<StarQuality> kStarQualities[]{{StarQuality::Draft, "draft", "quick streaks"},
                                              {StarQuality::Final, "final", "diffraction, by wavelength"}};
constexpr Named<LensCoating> kCoatings[]{
    {LensCoating::None, "none", "bare glass"},
    {LensCoating::SingleLayer, "single", "one layer of magnesium fluoride"}};
constexpr Named<ToneCurve> kTones[]{
    {ToneCurve::Filmic, "filmic", "keeps mid-grey, rolls off highlights towards white"},
    {ToneCurve::Reinhard, "reinhard", "n/(1 + n)"},
    {ToneCurve::None, "none", "clip"}};
constexpr Named<Transfer> kTransfers[]{{Transfer::Srgb, "srgb", "the sRGB curve"},
                                       {Transfer::Gamma22, "gamma2.2", "gamma 2.2"},
                                       {Transfer::Gamma20, "gamma2.0", "gamma 2.0"},
                                       {Transfer::Linear, "linear", "no curve: linear codes"}};
constexpr Named<DepthKind> kDepthKinds[]{
    {DepthKind::Planar, "planar", "along the axis"},
    {DepthKind::Ray, "ray", "from the pinhole"},
    {DepthKind::Inverse, "inverse", "1/planar; with a range, disparity between its ends"},
    {DepthKind::Normalized, "normalized", "0 to 1 between the ends of a range"},
    {DepthKind::Device, "device", "z-buffer between the ends of a range"},
    {DepthKind::Mist, "mist", "Blender's mist between the ends of a range, falloff Quadratic"},
    {DepthKind::CocPx, "coc-px", "signed blur radius in pixels"},
    {DepthKind::MistLinear, "mist-linear", "mist, falloff Linear"},
    {DepthKind::MistInverse, "mist-inverse", "mist, falloff Inverse Quadratic"}};
constexpr Named<DepthEdges> kDepthEdges[]{
    {DepthEdges::Auto, "auto", "snap if most silhouettes are ramps"},
    {DepthEdges::Keep, "keep", "never sharpens"},
    {DepthEdges::Snap, "snap", "each pixel of a ramp goes to one side"}};
constexpr Named<ErrorCode> kErrorCodes[]{
    {ErrorCode::InvalidArgument, "invalid-argument", "a flag, a number or a field is wrong or missing"},
    {ErrorCode::InvalidFile, "invalid-file", "an input is missing, damaged or incomplete"},
    {ErrorCode::Unsupported, "unsupported", "not possible in this build or with this engine"},
    {ErrorCode::OutputFailed, "output-failed", "an output could not be written"},
    {ErrorCode::OutOfMemory, "out-of-memory", "the work does not fit the memory limit"},
    {ErrorCode::Cancelled, "cancelled", "a caller stopped the work"},
    {ErrorCode::ReadFailed, "read-failed", "the system failed to read an input"}};

}  // namespace

// clang-format off
template <> std::span<const Named<Quality>> names() { return kQualities; }
template <> std::span<const Named<Fill>> names() { return kFills; }
template <> std::span<const Named<ScatterView>> names() { return kScatterViews; }
template <> std::span<const Named<GatherStage>> names() { return kStages; }
template <> std::span<const Named<GaussianStyle>> names() { return kStyles; }
template <> std::span<const Named<GaussianView>> names() { return kGaussianViews; }
template <> std::span<const Named<SpriteBackground>> names() { return kBackgrounds; }
template <> std::span<const Named<FocusMode>> names() { return kFocusModes; }
template <> std::span<const Named<LightSpectrum>> names() { return kSpectra; }
template <> std::span<const Named<ImageScale>> names() { return kImageScales; }
template <> std::span<const Named<StarQuality>> names() { return kStarQualities; }
template <> std::span<const Named<LensCoating>> names() { return kCoatings; }
template <> std::span<const Named<ToneCurve>> names() { return kTones; }
template <> std::span<const Named<Transfer>> names() { return kTransfers; }
template <> std::span<const Named<DepthKind>> names() { return kDepthKinds; }
template <> std::span<const Named<DepthEdges>> names() { return kDepthEdges; }
template <> std::span<const Named<ErrorCode>> names() { return kErrorCodes; }
// clang-format on

std::string did_you_mean(const std::string& given, const std::vector<std::string>& known) {
    const std::string nearest = nearest_word(given, known);
    return nearest.empty() ? "" : " (did you mean " + nearest + "?)";
}

}  // namespace petzval

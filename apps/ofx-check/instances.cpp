#include "instances.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>

namespace ofx_check {
namespace {

using Texts = std::vector<std::string>;

bool lists(const Texts& words, const char* word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// RGBA where the clip takes it, else the first that it names.
std::string components_of(const ofx::Clip& described) {
    const Texts words = described.properties.texts(ofx::kComponentsSupported);
    if (words.empty() || lists(words, ofx::kRgba)) return ofx::kRgba;
    return words[0];
}

std::string depth_of_all(const ofx::Effect& descriptor) {
    const Texts words = descriptor.properties.texts(ofx::kPixelDepths);
    for (const char* depth : {ofx::kFloat, ofx::kShort, ofx::kByte})
        if (lists(words, depth)) return depth;
    return ofx::kFloat;
}

int channels_of(const std::string& components) {
    if (components == ofx::kAlpha) return 1;
    return components == ofx::kRgb ? 3 : 4;
}

std::unique_ptr<ofx::Clip> clip_like(const ofx::Clip& described, const std::string& depth, bool connected) {
    auto clip = std::make_unique<ofx::Clip>(described.name, "clip", false);
    const std::string components = components_of(described);
    const bool is_output = described.name == ofx::kOutput;
    clip->properties.label = described.name;
    clip->properties.with(ofx::kType, Texts{ofx::kTypeClip})
        .with(ofx::kName, Texts{described.name})
        .with(ofx::kLabel, Texts{described.properties.text(ofx::kLabel)})
        .with(ofx::kComponentsSupported, described.properties.texts(ofx::kComponentsSupported))
        .with(ofx::kOptional, std::vector<int>{described.properties.integer(ofx::kOptional)})
        .with(ofx::kIsMask, std::vector<int>{described.properties.integer(ofx::kIsMask)})
        .with(ofx::kTiles, std::vector<int>{described.properties.integer(ofx::kTiles, 1)})
        .with(ofx::kTemporalAccess, std::vector<int>{0})
        .with(ofx::kConnected, std::vector<int>{connected || is_output})
        .with(ofx::kPixelDepth, Texts{depth})
        .with(ofx::kComponents, Texts{components})
        .with("OfxImageClipPropUnmappedPixelDepth", Texts{depth})
        .with("OfxImageClipPropUnmappedComponents", Texts{components})
        .with(ofx::kPreMultiplication, Texts{ofx::kPreMultiplied})
        .with(ofx::kPixelAspect, std::vector<double>{1})
        .with("OfxImageEffectPropFrameRate", std::vector<double>{24})
        .with("OfxImageEffectPropUnmappedFrameRate", std::vector<double>{24})
        .with(ofx::kFrameRange, std::vector<double>{1, 100})
        .with("OfxImageEffectPropUnmappedFrameRange", std::vector<double>{1, 100})
        .with("OfxImageClipPropFieldOrder", Texts{ofx::kFieldNone})
        .with("OfxImageClipPropContinuousSamples", std::vector<int>{0});
    return clip;
}

void take_default(ofx::Param& param, ofx::Point size, ofx::Point origin) {
    const ofx::PropertySet& p = param.properties;
    param.text = p.text(ofx::param::kDefault);
    const std::vector<double> numbers = p.numbers(ofx::param::kDefault);
    for (std::size_t i = 0; i < param.numbers.size(); ++i)
        param.numbers[i] = i < numbers.size() ? numbers[i] : double(p.integer(ofx::param::kDefault, 0, i));
    if (p.text(ofx::param::kCoordinates) != ofx::param::kNormalised || param.type != ofx::param::kDouble2D)
        return;
    param.numbers[0] = origin.x + param.numbers[0] * size.x;
    param.numbers[1] = origin.y + param.numbers[1] * size.y;
}

void describe_instance(ofx::Effect& effect, ofx::Effect& descriptor, const std::string& context,
                       ofx::Point size, ofx::Point origin) {
    effect.properties.with(ofx::kType, Texts{ofx::kTypeInstance})
        .with(ofx::kContext, Texts{context})
        .with(ofx::kLabel, Texts{descriptor.properties.text(ofx::kLabel)})
        .with(ofx::kPluginHandle, &descriptor)
        .with(ofx::kInstanceData, nullptr)
        .with(ofx::kProjectSize, std::vector<double>{size.x, size.y})
        .with(ofx::kProjectOffset, std::vector<double>{origin.x, origin.y})
        .with(ofx::kProjectExtent, std::vector<double>{origin.x + size.x, origin.y + size.y})
        .with(ofx::kProjectAspect, std::vector<double>{1})
        .with("OfxImageEffectInstancePropEffectDuration", std::vector<double>{100})
        .with("OfxImageEffectInstancePropSequentialRender", std::vector<int>{0})
        .with(ofx::kTiles, std::vector<int>{1})
        .with("OfxImageEffectPropFrameRate", std::vector<double>{24})
        .with(ofx::kIsInteractive, std::vector<int>{0});
}

// Position of a word among a menu's options; -1 if it is none.
int option(const ofx::Param& param, const std::string& word) {
    const Texts options = param.properties.texts(ofx::param::kChoiceOption);
    const auto found = std::find(options.begin(), options.end(), word);
    return found == options.end() ? -1 : int(found - options.begin());
}

}  // namespace

std::unique_ptr<ofx::Effect> instance_of(ofx::Effect& descriptor, const ofx::Effect& described,
                                         const std::string& context, const Cast& cast, const Setup& setup) {
    auto effect = std::make_unique<ofx::Effect>(true);
    const auto source = cast.pictures.find(ofx::kSource);
    ofx::RectI whole{int(cast.origin.x), int(cast.origin.y), int(cast.origin.x) + setup.width,
                     int(cast.origin.y) + setup.height};
    if (source != cast.pictures.end()) whole = source->second.bounds;
    const ofx::Point size{double(whole.x2 - whole.x1), double(whole.y2 - whole.y1)};
    const ofx::Point origin{double(whole.x1), double(whole.y1)};
    describe_instance(*effect, descriptor, context, size, origin);
    const std::string depth = depth_of_all(descriptor);
    unsigned seed = 0;
    for (const auto& from : described.clips) {
        const bool optional = from->properties.integer(ofx::kOptional) != 0;
        const auto given = cast.pictures.find(from->name);
        const bool connected =
            cast.pictures.empty() ? !(optional && cast.only_mandatory) : given != cast.pictures.end();
        auto clip = clip_like(*from, depth, connected);
        clip->effect = effect.get();
        if (connected && from->name != ofx::kOutput)
            clip->picture = given != cast.pictures.end()
                                ? given->second
                                : scene(whole, channels_of(clip->properties.text(ofx::kComponents)), seed++);
        effect->clips.push_back(std::move(clip));
    }
    for (const auto& from : described.params.params) {
        auto param = std::make_unique<ofx::Param>();
        param->name = from->name;
        param->type = from->type;
        param->properties.label = from->name;
        param->properties.param_type = from->properties.param_type;
        param->properties.slots = from->properties.slots;
        take_default(*param, size, origin);
        effect->params.params.push_back(std::move(param));
    }
    for (const auto& [name, value] : setup.params) set_param(*effect, name, value);
    return effect;
}

bool set_param(ofx::Effect& effect, const std::string& name, const std::string& value) {
    ofx::Param* param = effect.params.find(name);
    if (!param) return false;
    if (param->properties.param_type == 's') {
        param->text = value;
        return true;
    }
    if (const int chosen = option(*param, value); chosen >= 0) {
        param->numbers[0] = chosen;
        return true;
    }
    std::istringstream words(value);
    std::string word;
    for (std::size_t i = 0; i < param->numbers.size() && std::getline(words, word, ','); ++i) {
        char* end = nullptr;
        param->numbers[i] = std::strtod(word.c_str(), &end);
        if (end == word.c_str() || *end) return false;
    }
    return !value.empty();
}

}  // namespace ofx_check

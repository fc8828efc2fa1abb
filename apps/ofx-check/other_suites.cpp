// The smaller suites, and the door through which plug-ins fetch all of them.
#include "effect.h"

#include <cstdarg>
#include <cstdio>
#include <new>
#include <string_view>
#include <thread>
#include <vector>

namespace ofx_check {
namespace {

int say(const char* format, va_list arguments) {
    char text[1000] = "";
    std::vsnprintf(text, sizeof text, format ? format : "", arguments);
    ++counts.messages;
    const std::lock_guard lock(counts.mutex);
    counts.last_message = text;
    return ofx::kOk;
}

int message(void*, const char*, const char*, const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int status = say(format, arguments);
    va_end(arguments);
    return status;
}

int set_persistent(void* effect, const char*, const char*, const char* format, ...) {
    if (!effect) return ofx::kBadHandle;
    va_list arguments;
    va_start(arguments, format);
    const int status = say(format, arguments);
    va_end(arguments);
    return status;
}

int clear_persistent(void* effect) {
    if (!effect) return ofx::kBadHandle;
    const std::lock_guard lock(counts.mutex);
    counts.last_message.clear();
    return ofx::kOk;
}

int memory_alloc(void*, std::size_t bytes, void** memory) {
    if (!memory) return ofx::kBadHandle;
    *memory = ::operator new(bytes, std::nothrow);
    return *memory ? ofx::kOk : ofx::kMemory;
}
int memory_free(void* memory) {
    ::operator delete(memory);
    return memory ? ofx::kOk : ofx::kBadHandle;
}

thread_local int spawned_index = -1;

int run_threads(void (*body)(unsigned int, unsigned int, void*), unsigned int count, void* argument) {
    if (!body) return ofx::kFailed;
    if (spawned_index >= 0) return ofx::kExists;
    if (count == 0) count = 2;
    std::vector<std::thread> threads;
    const char* action = action_now;
    for (unsigned int i = 0; i < count; ++i)
        threads.emplace_back([=] {
            spawned_index = int(i), action_now = action;
            body(i, count, argument);
        });
    for (std::thread& thread : threads) thread.join();
    return ofx::kOk;
}

int cpu_count(unsigned int* count) {
    if (!count) return ofx::kBadHandle;
    *count = 2;
    return ofx::kOk;
}

int thread_index(unsigned int* index) {
    if (!index) return ofx::kBadHandle;
    *index = spawned_index >= 0 ? unsigned(spawned_index) : 0;
    return ofx::kOk;
}

int is_spawned() { return spawned_index >= 0; }

std::recursive_mutex* of(ofx::Mutex* mutex) { return reinterpret_cast<std::recursive_mutex*>(mutex); }

int mutex_create(ofx::Mutex** mutex, int lock_count) {
    if (!mutex) return ofx::kBadHandle;
    auto* made = new std::recursive_mutex;
    for (int i = 0; i < lock_count; ++i) made->lock();
    *mutex = reinterpret_cast<ofx::Mutex*>(made);
    return ofx::kOk;
}
int mutex_destroy(ofx::Mutex* mutex) {
    delete of(mutex);
    return mutex ? ofx::kOk : ofx::kBadHandle;
}
int mutex_lock(ofx::Mutex* mutex) {
    if (mutex) of(mutex)->lock();
    return mutex ? ofx::kOk : ofx::kBadHandle;
}
int mutex_unlock(ofx::Mutex* mutex) {
    if (mutex) of(mutex)->unlock();
    return mutex ? ofx::kOk : ofx::kBadHandle;
}
int mutex_try_lock(ofx::Mutex* mutex) {
    if (!mutex) return ofx::kBadHandle;
    return of(mutex)->try_lock() ? ofx::kOk : ofx::kFailed;
}

int progress_start(void* effect, const char*) { return effect ? ofx::kOk : ofx::kBadHandle; }
int progress_update(void* effect, double) { return effect ? ofx::kOk : ofx::kBadHandle; }
int progress_end(void* effect) { return effect ? ofx::kOk : ofx::kBadHandle; }

int redraw(ofx::InteractInstance* interact) { return interact ? ofx::kOk : ofx::kBadHandle; }
int interact_properties(ofx::InteractInstance* interact, ofx::PropertySet** set) {
    if (!interact || !set) return ofx::kBadHandle;
    *set = reinterpret_cast<ofx::PropertySet*>(interact);  // as stage.cpp makes them
    return ofx::kOk;
}

int standard_colour(ofx::DrawContext* context, int, ofx::Colour* colour) {
    if (!context || !colour) return ofx::kBadHandle;
    *colour = {1, 1, 1, 1};
    return ofx::kOk;
}
int set_colour(ofx::DrawContext* context, const ofx::Colour*) { return context ? ofx::kOk : ofx::kBadHandle; }
int set_line_width(ofx::DrawContext* context, float) { return context ? ofx::kOk : ofx::kBadHandle; }
int set_stipple(ofx::DrawContext* context, int) { return context ? ofx::kOk : ofx::kBadHandle; }
int draw(ofx::DrawContext* context, int primitive, const ofx::Point* points, int count) {
    if (!context || !points) return ofx::kBadHandle;
    return primitive < 0 || primitive > ofx::kEllipse || count < 1 ? ofx::kBadValue : ofx::kOk;
}
int draw_text(ofx::DrawContext* context, const char*, const ofx::Point*, int) {
    return context ? ofx::kOk : ofx::kBadHandle;
}

const ofx::MessageSuite kMessages{message, set_persistent, clear_persistent};
const ofx::MemorySuite kMemoryOf{memory_alloc, memory_free};
const ofx::MultiThreadSuite kThreads{run_threads,   cpu_count,  thread_index, is_spawned,    mutex_create,
                                     mutex_destroy, mutex_lock, mutex_unlock, mutex_try_lock};
const ofx::ProgressSuite kProgress{progress_start, progress_update, progress_end};
const ofx::InteractSuite kInteracts{redraw, redraw, interact_properties};
const ofx::DrawSuite kDraws{standard_colour, set_colour, set_line_width, set_stipple, draw, draw_text};

struct SuiteRow {
    const char* name;
    int version;
    const void* suite;
};

}  // namespace

const void* fetch_suite(ofx::PropertySet*, const char* name, int version) {
    if (!name || name == effect_lies.missing_suite) return nullptr;
    const SuiteRow rows[] = {
        {ofx::kPropertySuite, 1, &property_suite()},   {ofx::kImageEffectSuite, 1, &image_effect_suite()},
        {ofx::kParameterSuite, 1, &parameter_suite()}, {ofx::kMessageSuite, 1, &kMessages},
        {ofx::kMessageSuite, 2, &kMessages},           {ofx::kMemorySuite, 1, &kMemoryOf},
        {ofx::kMultiThreadSuite, 1, &kThreads},        {ofx::kProgressSuite, 1, &kProgress},
        {ofx::kInteractSuite, 1, &kInteracts},         {ofx::kDrawSuite, 1, &kDraws}};
    for (const SuiteRow& row : rows)
        if (std::string_view(row.name) == name && row.version == version) return row.suite;
    return nullptr;
}

ofx::Host* the_host() {
    static ofx::PropertySet properties("host");
    static ofx::Host host{&properties, fetch_suite};
    if (properties.slots.empty())
        properties.with(ofx::kType, std::vector<std::string>{ofx::kTypeHost})
            .with(ofx::kName, std::vector<std::string>{"petzval.ofx-check"})
            .with(ofx::kLabel, std::vector<std::string>{"ofx-check"})
            .with(ofx::kApiVersion, std::vector<int>{1, 5})
            .with(ofx::kVersion, std::vector<int>{1, 0, 0})
            .with(ofx::kVersionLabel, std::vector<std::string>{"1.0"})
            .with("OfxImageEffectHostPropIsBackground", std::vector<int>{1})
            .with(ofx::kOverlays, std::vector<int>{1})
            .with(ofx::kMultiResolution, std::vector<int>{1})
            .with(ofx::kTiles, std::vector<int>{1})
            .with(ofx::kTemporalAccess, std::vector<int>{0})
            .with(ofx::kComponentsSupported, std::vector<std::string>{ofx::kRgba, ofx::kRgb, ofx::kAlpha})
            .with(ofx::kContexts, std::vector<std::string>{ofx::kContextGeneral, ofx::kContextFilter,
                                                           "OfxImageEffectContextGenerator"})
            .with("OfxImageEffectPropSupportedPixelDepths",
                  std::vector<std::string>{ofx::kFloat, ofx::kShort, ofx::kByte})
            .with(ofx::kMultipleDepths, std::vector<int>{0})
            .with(ofx::kMultipleAspects, std::vector<int>{0})
            .with("OfxImageEffectPropSetableFrameRate", std::vector<int>{0})
            .with("OfxImageEffectPropSetableFielding", std::vector<int>{0})
            .with("OfxParamHostPropSupportsCustomInteract", std::vector<int>{0})
            .with("OfxParamHostPropSupportsStringAnimation", std::vector<int>{1})
            .with("OfxParamHostPropSupportsChoiceAnimation", std::vector<int>{1})
            .with("OfxParamHostPropSupportsBooleanAnimation", std::vector<int>{1})
            .with("OfxParamHostPropSupportsCustomAnimation", std::vector<int>{0})
            .with("OfxParamHostPropMaxParameters", std::vector<int>{-1})
            .with("OfxParamHostPropMaxPages", std::vector<int>{0})
            .with("OfxParamHostPropPageRowColumnCount", std::vector<int>{0, 0})
            .with("OfxImageEffectHostPropNativeOrigin",
                  std::vector<std::string>{"kOfxImageEffectHostPropNativeOriginBottomLeft"});
    return &host;
}

}  // namespace ofx_check

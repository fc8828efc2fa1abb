// The parts of the OpenFX image effect interface, version 1.5.1, that our plug-in and ofx-check use: facts of
// the published specification (github.com/AcademySoftwareFoundation/openfx, read at 3de640d) in names of our
// own. Each block names the page of its reference manual. All strings and layouts were compared once with the
// published headers.
#pragma once

#include <cstddef>

namespace ofx {

// --- "Status Codes": every function and action returns one.
enum Status : int {
    kOk = 0,
    kFailed = 1,
    kFatal = 2,
    kUnknown = 3,
    kMissingHostFeature = 4,
    kUnsupported = 5,
    kExists = 6,
    kFormat = 7,
    kMemory = 8,
    kBadHandle = 9,
    kBadIndex = 10,
    kBadValue = 11,
    kReplyYes = 12,
    kReplyNo = 13,
    kReplyDefault = 14,
    kUnlicensed = 15,
    kImageFormat = 1000,
};

// Handles belong to the host.
struct PropertySet;
struct Effect;
struct Clip;
struct ImageMemory;
struct ParamSet;
struct Param;
struct InteractInstance;
struct DrawContext;
struct Mutex;

using Time = double;  // frames
struct Point {
    double x, y;
};
struct Range {
    double min, max;
};
struct Rect {
    double x1, y1, x2, y2;  // y up; half-open
};
struct RectI {
    int x1, y1, x2, y2;
};
struct Colour {
    float r, g, b, a;
};

// --- "The OfxHost Struct" and "The OfxPlugin Struct"
struct Host {
    PropertySet* properties;
    const void* (*fetch_suite)(PropertySet* host, const char* name, int version);
};
using MainEntry = int (*)(const char* action, const void* handle, PropertySet* in, PropertySet* out);
struct Plugin {
    const char* api;
    int api_version;
    const char* identifier;
    unsigned int version_major, version_minor;
    void (*set_host)(Host* host);
    MainEntry main_entry;
};

// --- "Property Suite"; N functions come after the single ones, getters after setters.
struct PropertySuite {
    int (*set_pointer)(PropertySet*, const char* name, int index, void* value);
    int (*set_string)(PropertySet*, const char* name, int index, const char* value);
    int (*set_double)(PropertySet*, const char* name, int index, double value);
    int (*set_int)(PropertySet*, const char* name, int index, int value);
    int (*set_pointers)(PropertySet*, const char* name, int count, void* const* values);
    int (*set_strings)(PropertySet*, const char* name, int count, const char* const* values);
    int (*set_doubles)(PropertySet*, const char* name, int count, const double* values);
    int (*set_ints)(PropertySet*, const char* name, int count, const int* values);
    int (*get_pointer)(PropertySet*, const char* name, int index, void** value);
    int (*get_string)(PropertySet*, const char* name, int index, char** value);
    int (*get_double)(PropertySet*, const char* name, int index, double* value);
    int (*get_int)(PropertySet*, const char* name, int index, int* value);
    int (*get_pointers)(PropertySet*, const char* name, int count, void** values);
    int (*get_strings)(PropertySet*, const char* name, int count, char** values);
    int (*get_doubles)(PropertySet*, const char* name, int count, double* values);
    int (*get_ints)(PropertySet*, const char* name, int count, int* values);
    int (*reset)(PropertySet*, const char* name);
    int (*dimension)(PropertySet*, const char* name, int* count);
};

// --- "Image Effect Suite"
struct ImageEffectSuite {
    int (*property_set)(Effect*, PropertySet** set);
    int (*param_set)(Effect*, ParamSet** set);
    int (*clip_define)(Effect*, const char* name, PropertySet** set);
    int (*clip_handle)(Effect*, const char* name, Clip** clip, PropertySet** set);
    int (*clip_property_set)(Clip*, PropertySet** set);
    int (*clip_image)(Clip*, Time time, const Rect* region, PropertySet** image);
    int (*release_image)(PropertySet* image);
    int (*clip_region)(Clip*, Time time, Rect* bounds);
    int (*abort)(Effect*);
    int (*memory_alloc)(Effect*, std::size_t bytes, ImageMemory** memory);
    int (*memory_free)(ImageMemory*);
    int (*memory_lock)(ImageMemory*, void** pointer);
    int (*memory_unlock)(ImageMemory*);
};

// --- "Parameter Suite"; values are passed as arguments of variable number.
struct ParameterSuite {
    int (*define)(ParamSet*, const char* type, const char* name, PropertySet** set);
    int (*handle)(ParamSet*, const char* name, Param** param, PropertySet** set);
    int (*set_property_set)(ParamSet*, PropertySet** set);
    int (*property_set)(Param*, PropertySet** set);
    int (*value)(Param*, ...);
    int (*value_at_time)(Param*, Time time, ...);
    int (*derivative)(Param*, Time time, ...);
    int (*integral)(Param*, Time from, Time to, ...);
    int (*set_value)(Param*, ...);
    int (*set_value_at_time)(Param*, Time time, ...);
    int (*key_count)(Param*, unsigned int* count);
    int (*key_time)(Param*, unsigned int key, Time* time);
    int (*key_index)(Param*, Time time, int direction, int* index);
    int (*delete_key)(Param*, Time time);
    int (*delete_all_keys)(Param*);
    int (*copy)(Param* to, Param* from, Time offset, const Range* frames);
    int (*edit_begin)(ParamSet*, const char* name);
    int (*edit_end)(ParamSet*);
};

// --- "Message Suite"; version 1 has the first function alone.
struct MessageSuite {
    int (*message)(void* effect, const char* type, const char* id, const char* format, ...);
    int (*set_persistent)(void* effect, const char* type, const char* id, const char* format, ...);
    int (*clear_persistent)(void* effect);
};

// --- "Progress Suite", version 1
struct ProgressSuite {
    int (*start)(void* effect, const char* label);
    int (*update)(void* effect, double progress);
    int (*end)(void* effect);
};

// --- "Memory Suite"
struct MemorySuite {
    int (*alloc)(void* effect, std::size_t bytes, void** memory);
    int (*free)(void* memory);
};

// --- "Threading Suite"
struct MultiThreadSuite {
    int (*run)(void (*body)(unsigned int index, unsigned int count, void* argument), unsigned int count,
               void* argument);
    int (*cpu_count)(unsigned int* count);
    int (*index)(unsigned int* index);
    int (*is_spawned)();
    int (*mutex_create)(Mutex** mutex, int lock_count);
    int (*mutex_destroy)(Mutex* mutex);
    int (*mutex_lock)(Mutex* mutex);
    int (*mutex_unlock)(Mutex* mutex);
    int (*mutex_try_lock)(Mutex* mutex);
};

// --- "Interact Suite" and "Draw Suite" (since 1.5)
struct InteractSuite {
    int (*swap_buffers)(InteractInstance*);
    int (*redraw)(InteractInstance*);
    int (*property_set)(InteractInstance*, PropertySet** set);
};
enum StandardColour : int { kOverlayBackground, kOverlayActive, kOverlaySelected, kOverlayDeselected };
enum Primitive : int { kLines, kLineStrip, kLineLoop, kRectangle, kPolygon, kEllipse };
struct DrawSuite {
    int (*standard_colour)(DrawContext*, int which, Colour* colour);
    int (*set_colour)(DrawContext*, const Colour* colour);
    int (*set_line_width)(DrawContext*, float width);
    int (*set_stipple)(DrawContext*, int pattern);
    int (*draw)(DrawContext*, int primitive, const Point* points, int count);
    int (*text)(DrawContext*, const char* text, const Point* at, int alignment);
};

}  // namespace ofx

/* petzval for C, and for every language that calls C: sessions, lenses, looks; a sharp picture with depth
 * in, the picture that a lens would have taken out. docs/reference/library.md shows it in use.
 *
 * - C99. Nothing else is exported by libpetzval.so.
 * - Handles are opaque. What is opened is closed by its own function; null is closed without harm.
 * - Structs begin with their size: set it to sizeof(struct) and everything else to zero first. A program
 * built against an older header keeps working: missing members take their defaults.
 * - Choices are made by name ("gather", "final"), as on the command line; no enum of a look has a number.
 * - Functions that can fail return a petzval_status; petzval_error_text() then has one sentence.
 * - Strings are UTF-8, given and lent; a lent string lives as long as the handle it came from, or as said.
 * - A session may be used by many threads at once. Other handles are constant once made, and so may be, too;
 * a look that is being changed by one thread at a time. */
#ifndef PETZVAL_C_H
#define PETZVAL_C_H

/* This is C: NOLINTBEGIN(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__) && defined(PETZVAL_BUILDS_C)
#define PETZVAL_C_API __attribute__((visibility("default")))
#else
#define PETZVAL_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum petzval_status {
    PETZVAL_OK = 0,
    PETZVAL_INVALID_ARGUMENT = 1, /* an argument, a field of a struct or of a look is wrong or missing */
    PETZVAL_INVALID_FILE = 2,     /* a lens file is missing, damaged or no lens */
    PETZVAL_UNSUPPORTED = 3,      /* understood, but this build or engine cannot do it */
    PETZVAL_OUTPUT_FAILED = 4,
    PETZVAL_OUT_OF_MEMORY = 5, /* of the machine, or more than the session may take */
    PETZVAL_CANCELLED = 6,     /* a callback asked to stop */
    PETZVAL_INTERNAL = 7,      /* a fault of ours */
    PETZVAL_READ_FAILED = 8    /* the system failed to read a file; another try may succeed */
} petzval_status;

/* Why the last call of this thread that failed did; "" if none did. Lives until this thread's next failing
 * call. */
PETZVAL_C_API const char* petzval_error_text(void);
/* "invalid_argument", …; "unknown" for other numbers. Lives for ever. */
PETZVAL_C_API const char* petzval_status_name(petzval_status status);
/* Of the library that is loaded: "0.1.0". Lives for ever. */
PETZVAL_C_API const char* petzval_version(void);

/* JSON made for the caller, who closes it. Infinity is written as 1e999, what is unknown is null. */
typedef struct petzval_text petzval_text;
PETZVAL_C_API const char* petzval_text_json(const petzval_text* text); /* lives as long as the text */
PETZVAL_C_API void petzval_text_close(petzval_text* text);

/* --- Sessions: what outlives a frame
 * ------------------------------------------------------------------------ */

typedef struct petzval_session petzval_session;

/* Threads that a host lends. Both functions are called by any thread that asks for a frame, as long as the
 * session lives; results never depend on who runs what. */
typedef struct petzval_workers {
    size_t size;
    void* host;
    /* How many bodies of one run may be under way at the same time, the calling thread's included: at least
     * 1, and always the same. */
    int (*width)(void* host);
    /* Calls body(context, i) once for each i in 0…count-1, on any threads, in any order, and returns when all
     * have returned. Bodies need no other body to be under way. */
    void (*run)(void* host, int count, void (*body)(void* context, int index), void* context);
} petzval_workers;

typedef struct petzval_session_settings {
    size_t size;
    int threads;                    /* 0: all that this process may use; at most 1024 */
    uint64_t max_memory_bytes;      /* for everything, what is kept between frames included; 0: no limit */
    const char* kernel_folder;      /* kernels that take long are kept here between runs; null: nowhere */
    const petzval_workers* workers; /* instead of `threads`; copied; null: our own */
    /* What draws: "cpu", "gpu", "gpu:1", "auto" (SessionSettings::device); null: the CPU. One that is not
     * there, or cannot be used, is refused when the session is opened. */
    const char* device;
} petzval_session_settings;

/* settings may be null: all threads, no limits. Errors: unsupported. */
PETZVAL_C_API petzval_status petzval_session_open(const petzval_session_settings* settings,
                                                  petzval_session** session);
PETZVAL_C_API void petzval_session_close(petzval_session* session); /* no call may be under way */

typedef struct petzval_usage {
    size_t size;
    uint64_t kept_bytes; /* kernels kept between frames */
    int lenses;          /* mounted on cameras, and kept */
} petzval_usage;

/* usage->size says how much of it is written. */
PETZVAL_C_API petzval_status petzval_session_usage(const petzval_session* session, petzval_usage* usage);
/* Frees kernels, least recently used first, until at most so many bytes are kept. */
PETZVAL_C_API petzval_status petzval_session_trim(petzval_session* session, uint64_t bytes);

/* --- Names
 * ---------------------------------------------------------------------------------------------------- */

/* The engines and the lenses that ship, from 0 on; null behind the last. Live for ever. */
PETZVAL_C_API const char* petzval_engine_name(int index);
PETZVAL_C_API const char* petzval_lens_name(int index);
/* The presets that were there when this was first asked: a user's own, then those that ship. Null, with
 * petzval_error_text(), also if memory runs out while they are listed; a later call tries again. */
PETZVAL_C_API const char* petzval_preset_name(int index);
/* The devices that were there when this was first asked: "cpu", "gpu:0", …. Starts drivers. */
PETZVAL_C_API const char* petzval_device_name(int index);

/* --- Looks: all that an artist chooses
 * ------------------------------------------------------------------------ */

typedef struct petzval_look petzval_look;

PETZVAL_C_API petzval_status petzval_look_new(petzval_look** look); /* the defaults */
/* A look as `petzval defocus --save-look` writes it; its key "preset" names a look to start from. Or a link
 * of the lens lab, the URL or its fragment. Errors: invalid_file. */
PETZVAL_C_API petzval_status petzval_look_from_json(const char* json, petzval_look** look);
/* A preset by name: a user's own, NAME.json in $PETZVAL_PRESETS or ~/.config/petzval/presets, otherwise one
 * that ships. Errors: invalid_argument that lists the names; invalid_file for a broken file. */
PETZVAL_C_API petzval_status petzval_look_from_preset(const char* name, petzval_look** look);
/* Sets one field, as in the JSON: petzval_look_set(look, "engine", "gather"), (look, "lens.blades",
 * "5"). The value is JSON, or a plain word where a name is wanted. The look is unchanged if it is refused. */
PETZVAL_C_API petzval_status petzval_look_set(petzval_look* look, const char* field, const char* value);
/* Lives until the look is changed or closed. */
PETZVAL_C_API petzval_status petzval_look_json(const petzval_look* look, const char** json);
PETZVAL_C_API void petzval_look_close(petzval_look* look);

/* --- Pictures, in the host's memory
 * --------------------------------------------------------------------------- */

typedef enum petzval_sample { PETZVAL_FLOAT = 0, PETZVAL_HALF = 1 } petzval_sample;

/* Pixel (x, y) of a channel lies at base + y * row_stride + x * pixel_stride bytes; strides may be negative
 * (rows bottom-up). Interleaved pictures have one base per channel, a sample apart. Row 0 is the top one. */
typedef struct petzval_pixels {
    size_t size;
    int width, height;
    petzval_sample sample;
    void *r, *g, *b;
    void* a; /* null: 1 everywhere, and not written */
    ptrdiff_t pixel_stride, row_stride;
} petzval_pixels;

typedef struct petzval_plane {
    size_t size;
    int width, height;
    petzval_sample sample;
    void* data;
    ptrdiff_t pixel_stride, row_stride;
} petzval_plane;

typedef struct petzval_rect {
    int x0, y0, x1, y1; /* half-open; y down */
} petzval_rect;

typedef struct petzval_camera {
    size_t size;
    double focal_length_mm, sensor_width_mm, f_number, focus_distance_m;
    int thin_lens; /* 0: the picture's sensor stands one focal length behind the pinhole, as renderers do */
} petzval_camera;

/* One thing seen in one pixel: premultiplied by its own coverage a, from depth to depth_back (equal for a
 * surface); metres, or radii where the shot gives radii. This struct and petzval_light never grow. */
typedef struct petzval_deep_sample {
    float r, g, b, a, depth, depth_back;
} petzval_deep_sample;

/* Any number of samples in each pixel, nearest first, rows top to bottom. Those of pixel i = y * width + x
 * are first[i]…first[i + 1] - 1; first has width * height + 1 entries, the last one being sample_count. */
typedef struct petzval_deep {
    size_t size;
    int width, height;
    const uint64_t* first;
    const petzval_deep_sample* samples;
    uint64_t sample_count;
} petzval_deep;

/* A light for the engine "sprites". Its place is (x, y) in pixels of the picture, centres at +0.5; it may lie
 * outside. Its colour is added to one pixel when in focus. Its depth is in metres; where that is NaN,
 * radius_px is its signed radius. Its own width is diameter_px. */
typedef struct petzval_light {
    float x, y, r, g, b, depth_m, radius_px, diameter_px;
} petzval_light;

/* Another picture of the same view, of the size of the shot's colour, blurred by the same weights. For engine
 * "scatter". */
typedef struct petzval_layer {
    size_t size;
    const petzval_pixels* colour; /* scene-linear, premultiplied; its alpha is not read */
    /* 0: light; layers that sum to the shot's colour sum to it when blurred. 1: a matte, blurred as the
     * coverage of surfaces is. */
    int is_matte;
    /* The lamp of this light: "daylight", "sodium", "mercury", "neon", "led"; null: the lens's own. */
    const char* spectrum;
    const petzval_pixels* out; /* written with the frame, in its size; null: not wanted */
} petzval_layer;

/* What was rendered. Only read. */
typedef struct petzval_shot {
    size_t size;
    const petzval_pixels* colour; /* scene-linear, premultiplied */
    const petzval_plane* depth_m; /* planar metres, +infinity for a miss; or */
    const petzval_plane*
        radii_px; /* signed radii of the circle of confusion, + behind focus. One of both, not both */
    const petzval_camera* camera;             /* may be null with radii_px and an ideal lens */
    petzval_rect display_window, data_window; /* both empty: the picture is the frame */
    double pixel_aspect;                      /* width / height of a pixel; 0: 1 */
    /* All null where there are none; of the picture's size. */
    const petzval_deep* deep;    /* all samples of a deep picture; colour and depth are its front view */
    const petzval_deep* behind;  /* hidden layers: what the visible surfaces hide */
    const petzval_deep* holdout; /* a matte that is not blurred and dims what lies behind it */
    const petzval_light* lights;
    uint64_t light_count;
    /* Where the effect is wanted, of the picture's size: 1 as blurred, 0 as given, a share mixes; null:
     * everywhere. */
    const petzval_plane* mask;
    const petzval_layer* const* layers; /* layer_count of them */
    uint64_t layer_count;
} petzval_shot;

/* --- A frame
 * ------------------------------------------------------------------------------------------------- */

typedef struct petzval_control {
    size_t size;
    void* host;
    /* Share done, 0…1, never falling, one call at a time, from any thread; 0 returned cancels. May be null.
     */
    int (*progress)(void* host, double done);
    /* Asked often, by any thread at any time: 1 cancels. May be null. */
    int (*cancelled)(void* host);
    /* The part of the frame to be made, in pixels as the windows are; empty: all of the data window. It is
     * the crop of the whole, bit for bit. */
    petzval_rect region;
    /* The frame is cancelled once this is not 0; any thread may set it. Read often. May be null. */
    const volatile int* stop;
} petzval_control;

typedef struct petzval_report petzval_report;

/* look null: the defaults; control and report may be null. `out` has the size of the picture, or of the part
 * of the region inside it, and may be the memory of the input. Nothing is written to `out` unless PETZVAL_OK
 * is returned. Errors: invalid_file, unsupported, cancelled. */
PETZVAL_C_API petzval_status petzval_defocus(petzval_session* session, const petzval_shot* shot,
                                             const petzval_look* look, const petzval_control* control,
                                             const petzval_pixels* out, petzval_report** report);
/* How many pixels around a region its result depends on: 175, plus four times the largest radius or the
 * farthest reach of the lens's light. A host that has these pixels gets the same region.
 * Errors: invalid_file, unsupported. */
PETZVAL_C_API petzval_status petzval_region_margin_px(petzval_session* session, const petzval_shot* shot,
                                                      const petzval_look* look, int* margin_px);
/* Engine, lens, device, radii, seconds by stage, warnings. Lives as long as the report. */
PETZVAL_C_API const char* petzval_report_json(const petzval_report* report);
PETZVAL_C_API void petzval_report_close(petzval_report* report);

#ifdef __cplusplus
}
#endif

#include <petzval/petzval_frame_c.h> /* stages of a frame, display codes, comparison */
#include <petzval/petzval_lens_c.h>  /* lenses */

/* NOLINTEND(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#endif

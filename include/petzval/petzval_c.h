/* petzval for C, and for every language that calls C: sessions, lenses, looks, and the function that makes
 * the picture of a lens from a sharp picture with depth. docs/reference/library.md has examples.
 *
 * - C99. libpetzval.so exports nothing else.
 * - Handles are opaque. Each kind of handle has its own function to close it, which accepts null.
 * - Structs begin with their size: set it to sizeof(struct) and everything else to zero first. A program
 *   built against an older header keeps working: missing members take their defaults.
 * - Choices are made by name ("gather", "final"), as on the command line; no enum of a look has a number.
 * - Functions that can fail return a petzval_status; petzval_error_text() then has one sentence.
 * - Strings are UTF-8. A returned string is valid as long as its handle, unless its comment says otherwise.
 * - Several threads may use one session at once. Other handles are constant once made, and may be shared
 *   too; a look may be changed by one thread at a time. */
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
    PETZVAL_UNSUPPORTED = 3,      /* this build or engine cannot do it */
    PETZVAL_OUTPUT_FAILED = 4,
    PETZVAL_OUT_OF_MEMORY = 5, /* of the machine or of the session's limit */
    PETZVAL_CANCELLED = 6,     /* a callback asked to stop */
    PETZVAL_INTERNAL = 7,      /* a fault in petzval */
    PETZVAL_READ_FAILED = 8    /* the system failed to read a file; another try may succeed */
} petzval_status;

/* The message of this thread's last failed call; "" if none failed. Valid until this thread's next failing
 * call. */
PETZVAL_C_API const char* petzval_error_text(void);
/* The name of a status, such as "invalid_argument"; "unknown" for other numbers. Always valid. */
PETZVAL_C_API const char* petzval_status_name(petzval_status status);
/* The version of the loaded library, such as "0.1.0". Always valid. */
PETZVAL_C_API const char* petzval_version(void);

/* JSON text that the caller closes. Infinity is written as 1e999, and unknown values are null. */
typedef struct petzval_text petzval_text;
PETZVAL_C_API const char* petzval_text_json(const petzval_text* text); /* valid until the text is closed */
PETZVAL_C_API void petzval_text_close(petzval_text* text);

/* --- Sessions: what outlives a frame
 * ------------------------------------------------------------------------ */

typedef struct petzval_session petzval_session;

/* Threads that a host lends. Any thread that makes a frame calls both functions, as long as the session
 * lives; results never depend on the threads. */
typedef struct petzval_workers {
    size_t size;
    void* host;
    /* Number of bodies of one run that may run at the same time, including the calling thread's: at least 1,
     * and constant. */
    int (*width)(void* host);
    /* Calls body(context, i) once for each i in 0…count-1, on any threads, in any order, and returns when all
     * have returned. Bodies do not wait for other bodies. */
    void (*run)(void* host, int count, void (*body)(void* context, int index), void* context);
} petzval_workers;

typedef struct petzval_session_settings {
    size_t size;
    int threads;                    /* at most 1024; 0: all that this process may use */
    uint64_t max_memory_bytes;      /* limit of all memory, with data kept between frames; 0: none */
    const char* kernel_folder;      /* stores slow kernels between runs; null: none */
    const petzval_workers* workers; /* replace `threads`; copied; null: petzval's threads */
    /* The device that draws: "cpu", "gpu", "gpu:1", "auto" (SessionSettings::device); null: the CPU. A
     * missing or unusable device is refused when the session is opened. */
    const char* device;
} petzval_session_settings;

/* settings may be null: all threads, no limits. Errors: unsupported. */
PETZVAL_C_API petzval_status petzval_session_open(const petzval_session_settings* settings,
                                                  petzval_session** session);
PETZVAL_C_API void petzval_session_close(petzval_session* session); /* requires: no call uses it */

typedef struct petzval_usage {
    size_t size;
    uint64_t kept_bytes; /* kernels, traced rays and stars kept between frames */
    int lenses;          /* lenses kept, each with its camera */
} petzval_usage;

/* usage->size limits the members that are written. */
PETZVAL_C_API petzval_status petzval_session_usage(const petzval_session* session, petzval_usage* usage);
/* Frees kernels, rays and stars, least recently used first, until at most this many bytes are kept. */
PETZVAL_C_API petzval_status petzval_session_trim(petzval_session* session, uint64_t bytes);

/* --- Names
 * ---------------------------------------------------------------------------------------------------- */

/* The name of an engine; index 0 is the first, and null follows the last. Always valid. */
PETZVAL_C_API const char* petzval_engine_name(int index);
/* The name of a built-in lens, by index in the same way. */
PETZVAL_C_API const char* petzval_lens_name(int index);
/* The name of a preset, by index in the same way, among those that existed at the first call: the user's,
 * then the built-in ones. Also null, with petzval_error_text(), if memory runs out while they are listed; a
 * later call tries again. */
PETZVAL_C_API const char* petzval_preset_name(int index);
/* The name of a device, by index in the same way, among those that existed at the first call: "cpu", "gpu:0",
 * …. The first call starts drivers. */
PETZVAL_C_API const char* petzval_device_name(int index);

/* --- Looks: all that an artist chooses
 * ------------------------------------------------------------------------ */

typedef struct petzval_look petzval_look;

PETZVAL_C_API petzval_status petzval_look_new(petzval_look** look); /* a look with the defaults */
/* A look as `petzval defocus --save-look` writes it; its key "preset" names a look to start from. `json`
 * may also be a link of the lens lab, or the part after its #. Errors: invalid_file. */
PETZVAL_C_API petzval_status petzval_look_from_json(const char* json, petzval_look** look);
/* A preset by name: the user's own, NAME.json in $PETZVAL_PRESETS or ~/.config/petzval/presets, otherwise a
 * built-in one. Errors: invalid_argument that lists the names; invalid_file for a broken file. */
PETZVAL_C_API petzval_status petzval_look_from_preset(const char* name, petzval_look** look);
/* Sets one field, as in the JSON: petzval_look_set(look, "engine", "gather"), (look, "lens.blades", "5"). The
 * value is JSON; a name needs no quotes. If the value is refused, the look is unchanged. */
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

/* One surface or volume in one pixel: colour premultiplied by its own coverage a, from depth to depth_back
 * (equal for a surface) in metres, or radii if the shot gives radii. This struct and petzval_light never
 * grow. */
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

/* Another picture of the same view and size as the shot's colour, blurred by the same weights. For engine
 * "scatter". */
typedef struct petzval_layer {
    size_t size;
    const petzval_pixels* colour; /* scene-linear, premultiplied; its alpha is not read */
    /* 0: light; layers that sum to the shot's colour sum to it when blurred. 1: a matte, blurred as the
     * coverage of surfaces is. */
    int is_matte;
    /* The lamp of this light: "daylight", "sodium", "mercury", "neon", "led"; null: the lens's own. */
    const char* spectrum;
    const petzval_pixels* out; /* receives the result, in the size of the frame; null: dropped */
} petzval_layer;

/* What the values of a renderer's depth mean: read by the rules of `petzval defocus`
 * (docs/reference/files.md), also for missing, negative and quantised depth. */
typedef struct petzval_depth_meaning {
    size_t size;
    const char* kind;    /* as --depth-kind, such as "ray"; null: "planar" */
    double unit_m;       /* metres per unit of depth; 0: 1 */
    const double* range; /* two numbers, as --depth-range; null: none */
} petzval_depth_meaning;

/* The rendered input. It is only read. */
typedef struct petzval_shot {
    size_t size;
    const petzval_pixels* colour; /* scene-linear, premultiplied */
    const petzval_plane* depth_m; /* planar metres, +infinity for a miss; null if radii_px is given */
    /* Signed radii of the circle of confusion, + behind focus; null if depth_m is given. */
    const petzval_plane* radii_px;
    const petzval_camera* camera; /* may be null with radii_px and an ideal lens */
    petzval_rect display_window;  /* the frame; both windows empty: the picture is the frame */
    petzval_rect data_window;     /* the place of the picture */
    double pixel_aspect;          /* width / height of a pixel; 0: 1 */
    /* All samples of a deep picture, of the picture's size; colour and depth are its front view. Null: none.
     */
    const petzval_deep* deep;
    const petzval_deep* behind;  /* surfaces behind the visible ones, of the picture's size; null: none */
    const petzval_deep* holdout; /* a matte that is not blurred and dims light behind it; null: none */
    const petzval_light* lights; /* lights for the engine "sprites" */
    uint64_t light_count;
    /* Mixes the blurred picture (1) with the original (0); of the picture's size. Null: 1 everywhere. */
    const petzval_plane* mask;
    const petzval_layer* const* layers; /* more pictures to blur; layer_count pointers */
    uint64_t layer_count;
    /* Meaning of depth_m where it is not planar metres; with kind "coc-px" it holds radii. Null: planar
     * metres. deep, behind and holdout are in metres or radii in any case. */
    const petzval_depth_meaning* depth_meaning;
} petzval_shot;

/* --- A frame
 * ------------------------------------------------------------------------------------------------- */

typedef struct petzval_control {
    size_t size;
    void* host;
    /* Reports the fraction done, 0…1, which never falls; one call at a time, from any thread. A returned 0
     * cancels. May be null. */
    int (*progress)(void* host, double done);
    /* Called often, by any thread at any time: 1 cancels. May be null. */
    int (*cancelled)(void* host);
    /* The part of the frame to be made, in pixels like the windows; empty: the whole data window. Its bits
     * are the same as in the whole frame. */
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
/* Margin in pixels around a region that affects its result: 175, plus four times the largest radius or the
 * farthest reach of the lens's light. A host that has these pixels gets the same region. Errors:
 * invalid_file, unsupported. */
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

/* Lenses: opened once, used by any number of frames; their facts, sections and discs without a picture.
 * Part of petzval_c.h, whose rules hold here. Needs no session. */
#ifndef PETZVAL_LENS_C_H
#define PETZVAL_LENS_C_H

#include <petzval/petzval_c.h>

/* This is C: NOLINTBEGIN(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

typedef struct petzval_lens petzval_lens;

/* Opens a built-in lens by its name, or a lens file by its path. The file is read now and never again.
 * Errors: invalid_file. */
PETZVAL_C_API petzval_status petzval_lens_open(const char* name_or_file, petzval_lens** lens);
/* Opens the content of a lens file, in any format that petzval reads. Messages and reports call the lens
 * `name`; null: "lens". Errors: invalid_file. */
PETZVAL_C_API petzval_status petzval_lens_from_memory(const void* bytes, size_t byte_count, const char* name,
                                                      petzval_lens** lens);
/* Opens the same lens with a look's options: all fields of the look's "lens" except the name (blades, cat's
 * eye, added aberrations, light, …). No file is read. Errors: unsupported. */
PETZVAL_C_API petzval_status petzval_lens_with(const petzval_lens* lens, const petzval_look* look,
                                               petzval_lens** changed);
PETZVAL_C_API void petzval_lens_close(petzval_lens* lens);
/* Returns the name with which the lens was opened. It is valid until the lens is closed. */
PETZVAL_C_API const char* petzval_lens_title(const petzval_lens* lens);

/* Frames with this look use this lens and open no file: lens.name becomes its name; all other fields are
 * unchanged. Setting another lens.name removes the lens again. The lens may be closed at once. */
PETZVAL_C_API petzval_status petzval_look_set_lens(petzval_look* look, const petzval_lens* lens);

/* The camera and the picture size that express a lens in pixels. */
typedef struct petzval_lens_mount {
    size_t size;
    /* Null, or numbers that are 0: the lens's own camera, focused at infinity. */
    const petzval_camera* camera;
    int width, height;   /* picture size; both 0: 1920 x 1080 */
    double pixel_aspect; /* width / height of a pixel; 0: 1 */
} petzval_lens_mount;

/* Lists every built-in lens: an array of {"name", "title", "class", "model", "year", …}. */
PETZVAL_C_API petzval_status petzval_lens_list(petzval_text** lenses);
/* Writes first-order numbers, Seidel sums, and aberrations on the axis and over the field, as `petzval lens
 * show --json` does. */
PETZVAL_C_API petzval_status petzval_lens_facts(const petzval_lens* lens, petzval_text** facts);
/* Writes only the curves among the facts: "longitudinal_aberration_mm" and "field". */
PETZVAL_C_API petzval_status petzval_lens_curves(const petzval_lens* lens, petzval_text** curves);
/* Writes the lens cut open, with the rays of one point of light. The point lies at depth_m (metres, +infinity
 * allowed) and at field_x, field_y in -1…1 of the half diagonal, x right, y up. Member "glass" holds
 * outlines; member "rays" holds paths, each with the place where it lands in the disc. The grid over the
 * pupil is rays_across wide, 3…101. The mount may be null. */
PETZVAL_C_API petzval_status petzval_lens_section(const petzval_lens* lens, const petzval_lens_mount* mount,
                                                  double depth_m, double field_x, double field_y,
                                                  int rays_across, petzval_text** section);

/* One disc: the image of a point of light, with all wavelengths of the lens's light summed to scene-linear r,
 * g, b, each of which sums to 1. */
typedef struct petzval_disc {
    size_t size;
    double coc_radius_px;    /* signed, + behind focus */
    double field_x, field_y; /* -1…1 of the half diagonal, x right, y up */
    int raw;                 /* 1: keeps colours outside the gamut, as negative values */
} petzval_disc;

typedef struct petzval_disc_report {
    size_t size;
    int needed_px;     /* side of the smallest square that holds the whole disc; odd */
    double lost_share; /* fraction of the green light outside a picture that is smaller than this */
} petzval_disc_report;

/* Finds the side of a square that certainly contains the disc, at least its needed_px, without making the
 * disc. */
PETZVAL_C_API petzval_status petzval_lens_disc_size(const petzval_lens* lens, const petzval_lens_mount* mount,
                                                    const petzval_disc* disc, int* size_px);
/* Writes the disc into `out`, a square of an odd number of pixels; the source is in the middle one. a is the
 * weight of alpha. mount and report may be null. */
PETZVAL_C_API petzval_status petzval_lens_disc(const petzval_lens* lens, const petzval_lens_mount* mount,
                                               const petzval_disc* disc, const petzval_pixels* out,
                                               petzval_disc_report* report);

/* All discs of a lens on its axis as one picture: each column is the profile of a disc from its middle
 * outwards, round aperture; row v lies v / rows_per_px pixels from the middle. */
typedef struct petzval_texture {
    size_t size;
    int columns;           /* 2…16384; 0: 512 */
    double largest_coc_px; /* the first column has this radius in front of focus, the last behind; 0: 64 */
    int even;              /* 0: radii grow with the square of the distance from the middle column */
    int rows_per_px;       /* rows in a pixel of the disc, 1…16; 0: 4 */
    int raw;               /* 1: keeps colours outside the gamut */
    int view;              /* 1: each column divided by its brightest channel, to be looked at */
    int threads;           /* 0: all that this process may use */
} petzval_texture;

/* Finds a number of rows that certainly contain the texture, without making the texture. */
PETZVAL_C_API petzval_status petzval_lens_texture_rows(const petzval_lens* lens,
                                                       const petzval_lens_mount* mount,
                                                       const petzval_texture* texture, int* rows);
/* Writes the texture into `out`, `columns` wide and at least as high as the texture; rows below it are 0.
 * coc_radius_px (one value per column), mount and used_rows may be null. */
PETZVAL_C_API petzval_status petzval_lens_texture(const petzval_lens* lens, const petzval_lens_mount* mount,
                                                  const petzval_texture* texture, const petzval_pixels* out,
                                                  double* coc_radius_px, int* used_rows);

/* Discs of a lens by place in the frame and by radius, as one texture for shaders.
 * docs/reference/lens-atlas.md describes the texels and their header. */
typedef struct petzval_atlas {
    size_t size;
    double largest_coc_px; /* signed radii from minus this to plus this; 0: 64 */
    int zones;             /* rings of the frame from its middle to its corners, 1…64; 0: 5 */
} petzval_atlas;

/* Finds the size of the texels, without making them. The atlas may be null. */
PETZVAL_C_API petzval_status petzval_lens_atlas_bytes(const petzval_atlas* atlas, size_t* bytes);
/* Writes the texels, the content of atlas.bin, into byte_count bytes (at least petzval_lens_atlas_bytes()),
 * and their header, the content of atlas.json. A pupil that is not round needs 1 zone, and pixels must be
 * square. mount and atlas may be null. */
PETZVAL_C_API petzval_status petzval_lens_atlas(const petzval_lens* lens, const petzval_lens_mount* mount,
                                                const petzval_atlas* atlas, void* texels, size_t byte_count,
                                                petzval_text** header);

/* Finds the size of a lens buffer, without making it: 1.4 to 2.3 MB, or 45 times as much if discs change over
 * the frame. quality: "draft", "standard" or "final"; null: "standard". The mount may be null. */
PETZVAL_C_API petzval_status petzval_lens_buffer_bytes(const petzval_lens* lens,
                                                       const petzval_lens_mount* mount, const char* quality,
                                                       size_t* bytes);
/* Writes the lens as the programs of the shader kit read it, the content of lens.bin
 * (docs/explain/shader-kit.md), into byte_count bytes, at least petzval_lens_buffer_bytes(). Pixels must be
 * square. mount and quality may be null. */
PETZVAL_C_API petzval_status petzval_lens_buffer(const petzval_lens* lens, const petzval_lens_mount* mount,
                                                 const char* quality, void* buffer, size_t byte_count);
/* Checks that these bytes, such as those of a file, are a whole lens buffer for the programs of this version:
 * PETZVAL_OK, or PETZVAL_INVALID_FILE. */
PETZVAL_C_API petzval_status petzval_check_lens_buffer(const void* buffer, size_t byte_count);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#endif

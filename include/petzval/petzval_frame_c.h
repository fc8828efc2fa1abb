/* Stages and codes: a frame stage by stage or as display codes, and how far two pictures are apart. Part of
 * petzval_c.h, whose rules hold here. */
#ifndef PETZVAL_FRAME_C_H
#define PETZVAL_FRAME_C_H

#include <petzval/petzval_c.h>

/* This is C: NOLINTBEGIN(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

/* One stage of a frame: "blur", "falloff" (light lost towards the corners) or "glare", in the order of
 * physics; or "light": falloff and glare in one call. The shot's colour is the result of the stage before.
 * All stages in turn give the bits of petzval_defocus() for looks without expand_highlights and shots without
 * mask. The stages after the blur need an empty region, and leave out the shot's layers and mask: the
 * report's warnings name these. A stage that the look does not use copies the picture. Errors: invalid_file,
 * unsupported, cancelled. */
PETZVAL_C_API petzval_status petzval_defocus_stage(petzval_session* session, const char* stage,
                                                   const petzval_shot* shot, const petzval_look* look,
                                                   const petzval_control* control, const petzval_pixels* out,
                                                   petzval_report** report);

/* A frame as codes of a display: r, g, b interleaved, rows top to bottom. */
typedef struct petzval_codes {
    size_t size;
    void* data; /* uint8_t where bits is 8, uint16_t where it is 16 */
    ptrdiff_t row_stride;
    int width, height; /* of the window */
    int bits;          /* 8 or 16; 0: 8 */
    double exposure_stops;
    double contrast;      /* 0: 1 */
    const char* tone;     /* "none", "reinhard", "filmic"; null: "filmic" */
    const char* transfer; /* "srgb", "gamma22", "gamma20", "linear"; null: "srgb" */
    int no_dither;
    /* The window of the codes, in pixels like the shot's windows; black where nothing was made. Empty: the
     * display window. */
    petzval_rect window;
} petzval_codes;

/* petzval_defocus() and development of its light. A GPU that draws the frame develops it too. Errors:
 * invalid_file, unsupported, cancelled. */
PETZVAL_C_API petzval_status petzval_defocus_codes(petzval_session* session, const petzval_shot* shot,
                                                   const petzval_look* look, const petzval_control* control,
                                                   const petzval_codes* codes, petzval_report** report);

/* How far `test` is from `reference`: "psnr_lin", "psnr_srgb", "psnr_log" in dB (1e999 for equal pictures),
 * "ssim_lin", "ssim_srgb", "max_error", "max_error_at", "energy_ratio". mask: pixels above 0.5 count; may be
 * null. exposure: a factor before clipping; 0: 1. */
PETZVAL_C_API petzval_status petzval_compare(const petzval_pixels* reference, const petzval_pixels* test,
                                             const petzval_plane* mask, double exposure, petzval_text** text);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#endif

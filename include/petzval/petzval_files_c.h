/* Files: shots read from EXR, PNG, JPEG and TIFF, results written with everything else that the input held,
 * built-in scenes and their truth. These functions are in libpetzval-files.so, so that hosts with their own
 * file formats link none of ours; its shots are given to petzval_defocus() of libpetzval.so. The rules of
 * petzval_c.h hold here. */
#ifndef PETZVAL_FILES_C_H
#define PETZVAL_FILES_C_H

#include <petzval/petzval_c.h>

/* This is C: NOLINTBEGIN(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

/* The error of this thread's last failing call of this library; "" if none failed. Lives until the next.
 * */
PETZVAL_C_API const char* petzval_files_error_text(void);

typedef struct petzval_shot_source {
    size_t size;
    const char* path; /* EXR, PNG, JPEG or TIFF */
    /* Names as --layer, --view-name, --depth, --depth-channel and --depth-kind of the command line take them;
     * null: detected. */
    const char* layer;
    const char* view_name;
    const char* depth_file;
    const char* depth_channel;
    const char* depth_kind;
    double depth_unit_m; /* metres per unit of depth; 0: 1 */
    const char* behind;  /* files of hidden layers, a holdout, a mask and lights; null: none */
    const char* holdout;
    const char* mask;
    const char* lights;
    const char* const* layers; /* layer_count names of colour layers that are blurred as well, or "all" */
    uint64_t layer_count;
    const petzval_camera* camera; /* numbers other than 0 override those of the file; may be null */
    int threads;                  /* 0: all */
    uint64_t max_memory_bytes;    /* of the pixels; 0: no limit */
} petzval_shot_source;

/* A shot in memory of this library. */
typedef struct petzval_shot_file petzval_shot_file;

/* Errors: invalid_file, unsupported. */
PETZVAL_C_API petzval_status petzval_files_read_shot(const petzval_shot_source* source,
                                                     petzval_shot_file** file);
/* A file by its headers, pixels unread: petzval_files_json() has its parts, channels, windows, views, camera
 * numbers with their origin, and warnings; petzval_files_shot() has no pictures. Errors: invalid_file. */
PETZVAL_C_API petzval_status petzval_files_inspect(const char* path, petzval_shot_file** file);
/* A built-in scene (as `petzval scene list` names them) of width x height pixels and its hidden
 * layers. truth_samples: lens samples per pixel for the truth; 0: no truth. Errors: unsupported. */
PETZVAL_C_API petzval_status petzval_files_make_scene(const char* name, int width, int height, uint64_t seed,
                                                      int truth_samples, petzval_shot_file** file);
/* The shot, for petzval_defocus(). Its layers have no `out`: a host gives separate layers that point at the
 * same colour. Lives as long as the file. */
PETZVAL_C_API const petzval_shot* petzval_files_shot(const petzval_shot_file* file);
/* Truth of a scene; null where there is none. Lives as long as the file. */
PETZVAL_C_API const petzval_pixels* petzval_files_truth(const petzval_shot_file* file);
/* {"detected", "warnings", "layers", "views", "has_alpha", "display_referred"}. Lives as long as the file. */
PETZVAL_C_API const char* petzval_files_json(const petzval_shot_file* file);
/* Writes an EXR: `colour` and the layers' pictures (layer_count of them, in the shot's order; 0: as read)
 * instead of those of the input, everything else as the input has it. The file is complete or untouched.
 * Errors: invalid_file, output_failed. */
PETZVAL_C_API petzval_status petzval_files_write_like(const petzval_shot_file* file,
                                                      const petzval_pixels* colour,
                                                      const petzval_pixels* const* layers,
                                                      uint64_t layer_count, const char* path);
PETZVAL_C_API void petzval_files_close(petzval_shot_file* file);

#ifdef __cplusplus
}
#endif

#include <petzval/petzval_run_c.h> /* runs over the frames of a shot */

/* NOLINTEND(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#endif

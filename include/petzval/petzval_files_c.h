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

/* The message of this thread's last failed call to this library; "" if none failed. Valid until the next
 * failing call. */
PETZVAL_C_API const char* petzval_files_error_text(void);

typedef struct petzval_shot_source {
    size_t size;
    const char* path;          /* EXR, PNG, JPEG or TIFF */
    const char* layer;         /* as --layer of the command line; null: detected */
    const char* view_name;     /* as --view-name; null: detected */
    const char* depth_file;    /* as --depth; null: the file at `path` */
    const char* depth_channel; /* as --depth-channel; null: detected */
    const char* depth_kind;    /* as --depth-kind; null: detected */
    double depth_unit_m;       /* metres per unit of depth; 0: 1 */
    const char* behind;        /* file of a clean plate or of hidden layers, as --plate; null: none */
    const char* holdout;       /* file, as --holdout; null: none */
    const char* mask;          /* file, as --mask; null: none */
    const char* lights;        /* file, as --points; null: none */
    const char* const* layers; /* layer_count names of layers to blur as well, or "all" */
    uint64_t layer_count;
    const petzval_camera* camera; /* numbers other than 0 override those of the file; may be null */
    int threads;                  /* 0: all that this process may use */
    uint64_t max_memory_bytes;    /* limit of the pixels; 0: none */
    const double* depth_range;    /* two numbers, as --depth-range; null: none */
} petzval_shot_source;

/* A shot in memory of this library. */
typedef struct petzval_shot_file petzval_shot_file;

/* Errors: invalid_file, unsupported. */
PETZVAL_C_API petzval_status petzval_files_read_shot(const petzval_shot_source* source,
                                                     petzval_shot_file** file);
/* Reads the headers of a file only: petzval_files_json() has its parts, channels, windows, views, camera
 * numbers with their origin, and warnings; petzval_files_shot() has no pictures. Errors: invalid_file. */
PETZVAL_C_API petzval_status petzval_files_inspect(const char* path, petzval_shot_file** file);
/* A built-in scene (as `petzval scene list` names them) of width x height pixels and its hidden
 * layers. truth_samples: lens samples per pixel for the truth; 0: no truth. Errors: unsupported. */
PETZVAL_C_API petzval_status petzval_files_make_scene(const char* name, int width, int height, uint64_t seed,
                                                      int truth_samples, petzval_shot_file** file);
/* The shot, for petzval_defocus(). Its layers have no `out`: to receive them, pass copies of the layers with
 * `out` set. Valid until the file is closed. */
PETZVAL_C_API const petzval_shot* petzval_files_shot(const petzval_shot_file* file);
/* The truth of a scene, or null. Valid until the file is closed. */
PETZVAL_C_API const petzval_pixels* petzval_files_truth(const petzval_shot_file* file);
/* {"detected", "warnings", "layers", "views", "has_alpha", "display_referred"}. Lives as long as the file. */
PETZVAL_C_API const char* petzval_files_json(const petzval_shot_file* file);
/* Writes an EXR: `colour` and the layers' pictures (layer_count of them, in the shot's order; 0: as read)
 * replace those of the input; everything else is the input's. The name of `path` must end in .exr. The file
 * is complete or untouched. Errors: invalid_file, output_failed. */
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

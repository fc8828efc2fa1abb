/* Runs: a shot of many frames from files to files, with the rules of `petzval defocus`: patterns, existing
 * and missing files, tracks, neighbouring frames, retries, records. These functions are in
 * libpetzval-files.so. */
#ifndef PETZVAL_RUN_C_H
#define PETZVAL_RUN_C_H

#include <petzval/petzval_c.h>

/* This is C: NOLINTBEGIN(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

typedef struct petzval_files_run petzval_files_run;

typedef struct petzval_run_host {
    size_t size;
    void* host;
    /* Reports a frame that is done: state is "made", "kept", "black" or "failed"; why is the reason for
     * "kept" and the error of "failed"; record is one line of JSON. A returned 0 stops the run. The thread
     * that runs calls it. */
    int (*frame_done)(void* host, int frame, const char* state, const char* why, const char* record);
    /* The run is cancelled once this is not 0; any thread may set it. May be null. */
    const volatile int* stop;
} petzval_run_host;

/* Opens a run with its own session. settings: null for the defaults; `workers` is not used. json: the keys of
 * ShotRunSettings: {"input": "beauty.####.exr", "output": "out.####.exr", "frames": "1001-1100", "look": {…},
 * "camera": {"f_number": 2}, "track": FILE, "layers": ["all"], "existing": "replace" | "keep" | "update",
 * "missing": "fail" | "skip" | "black", "retries": 1, …}. Errors: unsupported. */
PETZVAL_C_API petzval_status petzval_files_run_open(const petzval_session_settings* settings,
                                                    const char* json, const petzval_run_host* host,
                                                    petzval_files_run** run);
/* Checks everything that can be refused before the work. petzval_files_run_all() calls it if the host did
 * not. Errors: invalid_file. */
PETZVAL_C_API petzval_status petzval_files_run_plan(petzval_files_run* run);
/* Lends the numbers of the frames to make until the run is closed. They are known after the plan. */
PETZVAL_C_API petzval_status petzval_files_run_frames(const petzval_files_run* run, const int** frames,
                                                      uint64_t* count);
/* Makes all frames; a failed frame does not stop the run. Errors: invalid_file, output_failed, unsupported,
 * cancelled. */
PETZVAL_C_API petzval_status petzval_files_run_all(petzval_files_run* run);
/* Lends the numbers of the frames that failed until the run is closed. */
PETZVAL_C_API petzval_status petzval_files_run_failed(const petzval_files_run* run, const int** frames,
                                                      uint64_t* count);
PETZVAL_C_API void petzval_files_run_close(petzval_files_run* run);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using,modernize-deprecated-headers,readability-identifier-naming) */
#endif

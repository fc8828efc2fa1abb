// The writers of job files, one for each farm system, and their common parts.
#pragma once

#include "petzval/farm/jobs.h"
#include "petzval/reports/words.h"

#include <string>
#include <vector>

namespace petzval::farm {

std::string run_script(const FarmShot& shot);  // run.sh
std::string shot_json(const FarmShot& shot);   // shot.json

Result<FarmFile> list_file(const FarmShot& shot);
Result<FarmFile> slurm_file(const FarmShot& shot);
Result<FarmFile> flamenco_file(const FarmShot& shot);
Result<FarmFile> openjd_file(const FarmShot& shot);
Result<FarmFile> opencue_file(const FarmShot& shot);

// Frame lists of all chunks, as in the command line: "1001-1010", "1001-1019x2".
std::vector<std::string> chunks(const FarmShot& shot, int size);
bool is_without_gaps(const std::vector<int>& frames);
std::size_t memory_mib(const FarmShot& shot);  // rounded up

}  // namespace petzval::farm
